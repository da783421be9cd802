#include "service/qualification/qualification.hpp"

#include <doctest/doctest.h>

#include "base/digest.hpp"
#include "base/json/json_value.hpp"
#include "proof/note.hpp"

namespace fitgauge::app::qualification {
namespace {

const Timestamp kAt = parse_rfc3339("2026-11-26T12:00:00Z").value();

Qualification qualified(const References& references = {},
                        const iso286::TableData& tables = iso286::compiled_in_tables()) {
  return qualify("1.2.3", kAt, references, tables);
}

/// With nothing planted.
const Qualification& sound() {
  static const Qualification made = qualified();
  return made;
}

std::set<std::string> failed(const std::vector<Check>& checks) {
  std::set<std::string> ids;
  for (const Check& check : checks) {
    if (!check.passed) ids.insert(check.id);
  }
  return ids;
}

/// Puts `to` in the place of the first `from` of a file.
void replace(References& references, const std::string& file, std::string_view from,
             std::string_view to) {
  std::string& text = references.files.at(file);
  REQUIRE(text.find(from) != std::string::npos);
  text.replace(text.find(from), from.size(), to);
}

/// Cells to change: column and how much, in nm.
using Changes = std::vector<std::pair<std::string_view, std::int64_t>>;

/// The tables with other values in cells of the step over `over_mm`.
iso286::TableData tables_with(std::int64_t over_mm, const Changes& changes) {
  iso286::TableData data = iso286::compiled_in_tables();
  for (const auto& [column, nm] : changes) {
    const auto cell =
        std::find_if(data.cells.begin(), data.cells.end(), [&](const iso286::TableCell& c) {
          return c.column == column && c.range.over.count() == over_mm * 1'000'000;
        });
    REQUIRE(cell != data.cells.end());
    REQUIRE(cell->value.has_value());
    cell->value = *cell->value + Length::nanometres(nm);
  }
  return data;
}

Result<iso286::ToleranceTables> made(const iso286::TableData& data) {
  return iso286::ToleranceTables::make(data, {"1-0"});
}

/// What the comparison with the standard says of tables that keep the rules.
std::vector<Check> checks_of(const iso286::TableData& data) {
  std::vector<Check> checks;
  check_iso286({}, made(data).value(), checks);
  for (Check& check : checks) check.compare();
  return checks;
}

}  // namespace

TEST_CASE("this program computes what was published, each figure within its limit") {
  const Qualification& made = sound();
  CHECK(failed(made.checks).empty());
  CHECK(made.passed);
  CHECK(made.tables_revision == "1-f0a85b3a");
  std::set<std::string> ids;
  for (const Check& check : made.checks) {
    CAPTURE(check.id);
    CHECK(ids.insert(check.id).second);
    CHECK_FALSE(check.source.empty());
    CHECK_FALSE(check.quantity.empty());
    CHECK(std::isfinite(std::stod(check.expected)));
    CHECK(std::abs(static_cast<double>(check.got) - std::stod(check.expected)) <=
          std::stod(check.limit) * (1 + 1e-9) + 1e-15);
    CHECK(check.digits > 0);
  }
  const auto count = [&](std::string_view prefix) {
    return std::count_if(ids.begin(), ids.end(),
                         [&](const std::string& id) { return id.starts_with(prefix); });
  };
  CHECK(count("iso286.") == 57);  // 28 letters of holes and of shafts, and the rules
  CHECK(count("nist.") == 9 * 3 + 11 * 9);
  CHECK(count("plane.") == 8 * 4);
  CHECK(count("cylinder.") == 8 * 7);
  for (const char* kind :
       {"msa.", "iso22514.", "bosch.", "gum.h1.", "gum.h2.", "gum.h3.", "gum.h5.", "jcgm101.",
        "jcgm106.", "circle.", "sphere.", "8255.", "8210.", "444."}) {
    CAPTURE(kind);
    CHECK(count(kind) >= 3);
  }
}

TEST_CASE("wrong cells of a table are planted one at a time, and each is found where it is") {
  struct Plant {
    std::string where;  ///< the check that has to fail
    std::int64_t over_mm;
    Changes changes;
  };
  const Plant plants[] = {
      {"iso286.H", 18, {{"IT9", 1000}}},
      {"iso286.h", 400, {{"IT12", -10'000}}},
      {"iso286.JS", 30, {{"IT01", 100}}},
      {"iso286.zc", 450, {{"ei_zc", 10'000}, {"ES_ZC_gt_IT7", -10'000}}},
      {"iso286.T", 24, {{"ei_t", 1000}, {"ES_T_gt_IT7", -1000}}},
      {"iso286.cd", 3, {{"es_cd", -1000}, {"EI_CD", 1000}}},
  };
  for (const Plant& plant : plants) {
    CAPTURE(plant.where);
    CHECK(failed(checks_of(tables_with(plant.over_mm, plant.changes))).contains(plant.where));
  }
}

TEST_CASE("cells that do not keep the rules of a table are found") {
  CHECK_FALSE(made(tables_with(120, {{"ei_k_IT4_to_IT7", 1000}})).has_value());
  const Qualification with = qualified({}, tables_with(80, {{"delta_IT7", 1000}}));
  CHECK_FALSE(with.passed);
  CHECK(failed(with.checks).contains("iso286.rules"));
}

TEST_CASE("wrong constants and cells are found where they are, and nowhere else") {
  struct Plant {
    const char* file;
    const char* from;
    const char* to;
    std::set<std::string> where;  ///< all that depends on it; on no other plant
  };
  const Plant plants[] = {
      // Of the data that the figures are computed from, as if the computation was wrong.
      {"nist/Lew.txt", "-213", "-213.00000001", {"nist.Lew.mean", "nist.Lew.r1", "nist.Lew.s"}},
      {"nist/NumAcc4.txt",
       "10000000.3",
       "10000000.30000001",
       {"nist.NumAcc4.r1", "nist.NumAcc4.s"}},
      {"data.txt",
       "0.47 -0.80 0.02",
       "0.47 -0.81 0.02",
       {"msa.anova.av", "msa.anova.ev", "msa.anova.grr", "msa.anova.operators", "msa.anova.parts",
        "msa.anova.pv", "msa.average_range.av", "msa.average_range.ev", "msa.average_range.grr",
        "msa.average_range.percent"}},
      {"data.txt",
       "2.70 2.50 2.40",
       "2.70 2.51 2.40",
       {"msa.linearity.intercept", "msa.linearity.slope"}},
      {"data.txt",
       "== bosch.type1\n6.0",
       "== bosch.type1\n6.1",
       {"bosch.cg", "bosch.cgk", "bosch.t"}},
      {"data.txt",
       "16.6 2",
       "16.6 3",
       {"gum.h1.expanded", "gum.h1.factor", "gum.h1.freedom", "gum.h1.welch"}},
      {"data.txt", "V 4.999 0.0032", "V 4.999 0.0034", {"gum.h2.resistance.u"}},
      {"data.txt", "== circle.4\n3", "== circle.4\n4", {"circle.4.r", "circle.4.x", "circle.4.y"}},
      {"data.txt", "good 25.013", "good 25.01301", {"8255.hole.good.Q153"}},
      // Of the published figures.
      {"expected.txt", "1.18046237440255", "1.18046237440355", {"nist.SiRstv.f"}},
      {"expected.txt", "0.913331179054", "0.913331179064", {"jcgm106.t"}},
      {"expected.txt", "8210.QL42 0.35", "8210.QL42 0.34", {"8210.QL42"}},
  };
  References references;
  std::set<std::string> planted;
  for (const Plant& plant : plants) {
    replace(references, plant.file, plant.from, plant.to);
    planted.insert(plant.where.begin(), plant.where.end());
  }
  const auto cells = tables_with(3, {{"es_cd", -1000}, {"EI_CD", 1000}});
  const Qualification with = qualified(references, cells);
  CHECK_FALSE(with.passed);
  std::set<std::string> found = failed(with.checks);
  CHECK(found.contains("iso286.cd"));
  std::erase_if(found, [](const std::string& id) { return id.starts_with("iso286."); });
  CHECK(found == planted);
}

TEST_CASE("a wrong cell of a table is named with its class and size") {
  const std::vector<Check> checks = checks_of(tables_with(18, {{"IT9", 1000}}));
  const auto wrong = std::find_if(checks.begin(), checks.end(),
                                  [](const Check& c) { return c.id == "iso286.H9.18.000001"; });
  REQUIRE(wrong != checks.end());
  CHECK(wrong->expected == "52");
  CHECK(wrong->got == 53);
  CHECK_FALSE(wrong->passed);
}

TEST_CASE("a figure that is not computed fails, and is absent in JSON") {
  References references;
  replace(references, "expected.txt", "gum.h1.combined", "gum.h1.nothing");
  const Qualification with = qualified(references);
  CHECK_FALSE(with.passed);
  CHECK(failed(with.checks) == std::set<std::string>{"gum.h1.nothing"});
  CHECK(files_of(with, nullptr).at("qualification.json").find(R"("got":null)") !=
        std::string::npos);
}

TEST_CASE("the report is signed by the key it is given, and is of the same bytes without one") {
  const Qualification& made = sound();
  const auto key = tlog::SigningKey::make("press-7");
  const auto files = files_of(made, &key);
  CHECK(files_of(made, nullptr).size() == 2);
  const auto note = tlog::open_note(files.at("qualification.note"), {&key.verifier(), 1}).value();
  for (const char* name : {"qualification.json", "qualification.pdf"}) {
    CHECK(note.text.find(std::string(name) + " SHA-256 " + to_hex(sha256(files.at(name)))) !=
          std::string::npos);
  }
  CHECK(files.at("qualification.pdf").starts_with("%PDF-1."));
}

TEST_CASE("the rule of SmLs gives NIST's own files") {
  const References references;
  for (const int number : {1, 4, 7}) {
    CHECK(references.rows("nist/SmLs0" + std::to_string(number) + ".txt") ==
          simon_and_lesage(number));
  }
}

TEST_CASE("a sum in doubles does not reach the certified digits of SmLs09") {
  // The negative control of `digits`: the textbook formula in doubles is far from F = 2001.
  double sum = 0;
  double squares = 0;
  const auto rows = simon_and_lesage(9);
  for (const Words& row : rows) {
    const double x = std::stod(row[1]);
    sum += x;
    squares += x * x;
  }
  const double total = squares - sum * sum / static_cast<double>(rows.size());
  Check check;
  check.expected = "340.08";
  check.limit = "1e-12";
  check.got = total;
  check.compare();
  CHECK_FALSE(check.passed);
  CHECK(check.digits < 3);
}

}  // namespace fitgauge::app::qualification
