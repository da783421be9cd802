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

/// The ids that begin with `prefix`, of the checks that failed.
std::set<std::string> failed(const Qualification& made) {
  std::set<std::string> ids;
  for (const Check& check : made.checks) {
    if (!check.passed) ids.insert(check.id);
  }
  return ids;
}

/// The references with `to` in the place of the first `from` of a file.
References references_with(const std::string& file, std::string_view from, std::string_view to) {
  References references;
  std::string& text = references.files.at(file);
  REQUIRE(text.find(from) != std::string::npos);
  text.replace(text.find(from), from.size(), to);
  return references;
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

}  // namespace

TEST_CASE("this program computes what was published, each figure within its limit") {
  const Qualification made = qualified();
  CHECK(failed(made).empty());
  CHECK(made.passed);
  CHECK(made.tables_revision.starts_with("1-"));
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

TEST_CASE("twenty wrong constants are planted one at a time, and each is found where it is") {
  struct Plant {
    std::string where;  ///< the check that has to fail
    std::function<Qualification()> with;
  };
  const auto in_tables = [](std::int64_t over_mm, const Changes& changes) {
    return [=] { return qualified({}, tables_with(over_mm, changes)); };
  };
  const auto in_reference = [](const char* file, const char* from, const char* to) {
    return [=] { return qualified(references_with(file, from, to)); };
  };
  const std::vector<Plant> plants{
      // Of the product's own tables: cells that keep all the rules of a table, and cells that do
      // not.
      {"iso286.H", in_tables(18, {{"IT9", 1000}})},
      {"iso286.h", in_tables(400, {{"IT12", -10'000}})},
      {"iso286.JS", in_tables(30, {{"IT01", 100}})},
      {"iso286.zc", in_tables(450, {{"ei_zc", 10'000}, {"ES_ZC_gt_IT7", -10'000}})},
      {"iso286.T", in_tables(24, {{"ei_t", 1000}, {"ES_T_gt_IT7", -1000}})},
      {"iso286.cd", in_tables(3, {{"es_cd", -1000}, {"EI_CD", 1000}})},
      {"iso286.rules", in_tables(120, {{"ei_k_IT4_to_IT7", 1000}})},
      {"iso286.rules", in_tables(80, {{"delta_IT7", 1000}})},
      // Of the data that the figures are computed from, as if the computation was wrong.
      {"nist.Lew.s", in_reference("nist/Lew.txt", "-213", "-213.00000001")},
      {"nist.NumAcc4.s", in_reference("nist/NumAcc4.txt", "10000000.3", "10000000.30000001")},
      {"msa.anova.ev", in_reference("data.txt", "0.47 -0.80 0.02", "0.47 -0.81 0.02")},
      {"msa.linearity.slope", in_reference("data.txt", "2.70 2.50 2.40", "2.70 2.51 2.40")},
      {"bosch.cgk", in_reference("data.txt", "== bosch.type1\n6.0", "== bosch.type1\n6.1")},
      {"gum.h1.freedom", in_reference("data.txt", "16.6 2", "16.6 3")},
      {"gum.h2.resistance.u", in_reference("data.txt", "V 4.999 0.0032", "V 4.999 0.0034")},
      {"circle.4.r", in_reference("data.txt", "== circle.4\n3", "== circle.4\n4")},
      {"8255.hole.good.Q153", in_reference("data.txt", "good 25.013", "good 25.01301")},
      // Of the published figures.
      {"nist.SiRstv.f", in_reference("expected.txt", "1.18046237440255", "1.18046237440355")},
      {"jcgm106.t", in_reference("expected.txt", "0.913331179054", "0.913331179064")},
      {"8210.QL42", in_reference("expected.txt", "8210.QL42 0.35", "8210.QL42 0.34")},
  };
  REQUIRE(plants.size() == 20);
  for (const Plant& plant : plants) {
    CAPTURE(plant.where);
    const Qualification made = plant.with();
    CHECK_FALSE(made.passed);
    CHECK(failed(made).count(plant.where) == 1);
  }
}

TEST_CASE("a wrong cell of a table is named with its class and size") {
  const Qualification made = qualified({}, tables_with(18, {{"IT9", 1000}}));
  const auto wrong = std::find_if(made.checks.begin(), made.checks.end(),
                                  [](const Check& c) { return c.id == "iso286.H9.18.000001"; });
  REQUIRE(wrong != made.checks.end());
  CHECK(wrong->expected == "52");
  CHECK(wrong->got == 53);
  CHECK_FALSE(wrong->passed);
}

TEST_CASE("a figure that is not computed fails, and is absent in JSON") {
  const Qualification made =
      qualified(references_with("expected.txt", "gum.h1.combined", "gum.h1.nothing"));
  CHECK(failed(made) == std::set<std::string>{"gum.h1.nothing"});
  CHECK(files_of(made, nullptr).at("qualification.json").find(R"("got":null)") !=
        std::string::npos);
}

TEST_CASE("the report is signed by the key it is given, and is of the same bytes without one") {
  const Qualification made = qualified();
  const auto key = tlog::SigningKey::make("press-7");
  const auto files = files_of(made, &key);
  CHECK(files_of(made, nullptr).size() == 2);
  const auto note = tlog::open_note(files.at("qualification.note"), {&key.verifier(), 1});
  REQUIRE(note.has_value());
  for (const char* name : {"qualification.json", "qualification.pdf"}) {
    CHECK(note->text.find(std::string(name) + " SHA-256 " + to_hex(sha256(files.at(name)))) !=
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
