#include "service/qualification/qualification.hpp"

#include <sstream>

#include "base/json/json_writer.hpp"
#include "formats/certificate/certificate.hpp"
#include "proof/note.hpp"
#include "service/measurements/measurement_storage.hpp"

namespace fitgauge::app::qualification {
namespace {

constexpr long double kNone = std::numeric_limits<long double>::quiet_NaN();

/// A figure that was not computed has not passed.
void add_expected(const References& references, const Figures& figures, std::vector<Check>& to) {
  std::string source;
  for (const Words& row : references.rows("expected.txt")) {
    const auto rest = [&row](auto from) {
      return fmt::format("{}", fmt::join(row.begin() + from, row.end(), " "));
    };
    if (row[0] == "=") {
      source = rest(1);
    } else {
      const auto found = figures.values.find(row[0]);
      const long double got = found == figures.values.end() ? kNone : found->second;
      to.push_back({row[0], source, rest(3), row[1], row[2], got});
    }
  }
}

std::string to_json(const Qualification& made) {
  return api::json_object([&](api::JsonWriter& json) {
           json.member("version", made.version).member("at", format_rfc3339(made.at));
           json.member("tables_revision", made.tables_revision).member("passed", made.passed);
           json.key("checks").begin_array();
           for (const Check& c : made.checks) {
             json.begin_object().member("id", c.id).member("source", c.source);
             json.member("quantity", c.quantity)
                 .key("expected")
                 .raw(c.expected)
                 .key("got")
                 .figure(c.got);
             json.member("digits", c.digits).key("limit").raw(c.limit).member("passed", c.passed);
             json.end_object();
           }
           json.end_array();
         }) +
         '\n';
}

std::string to_pdf(const Qualification& made, const std::vector<std::string>& proof) {
  using certificate::Line;
  static constexpr certificate::Column kColumns[] = {
      {"Check", 0.16F, &Line::part},     {"Source", 0.18F, &Line::characteristic},
      {"Quantity", 0.22F, &Line::size},  {"Expected", 0.14F, &Line::limits},
      {"Got", 0.14F, &Line::measured},   {"Digits", 0.05F, &Line::deviation},
      {"Result", 0.06F, &Line::verdict}, {"Limit", 0.05F, &Line::rule}};
  certificate::Certificate pdf{.title = "Operational qualification",
                               .proof = proof,
                               .signatures = {"Executed by, date", "Reviewed by, date"},
                               .columns = kColumns};
  for (const Check& c : made.checks) {
    pdf.lines.push_back({c.id, c.source, c.quantity, c.expected, fmt::format("{:.15Lg}", c.got),
                         fmt::format("{:.1f}", c.digits), c.passed ? "passed" : "FAILED", c.limit});
    if (!c.passed) pdf.lines.back().weight = certificate::Weight::Marked;
  }
  pdf.facts = {
      fmt::format("fitgauged {}, {}, tolerance tables {}", made.version, format_rfc3339(made.at),
                  made.tables_revision),
      fmt::format("{} checks: {}. A figure passes if it differs by no more than its limit.",
                  made.checks.size(), made.passed ? "all passed" : "FAILED")};
  return certificate::to_pdf(pdf, certificate::Paper::A4);
}

}  // namespace

std::vector<Words> References::rows(const std::string& file) const {
  std::vector<Words> rows;
  std::istringstream in(files.at(file));
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    rows.emplace_back();
    for (std::string word; words >> word;) rows.back().push_back(word);
  }
  return rows;
}

std::vector<Words> References::set(const std::string& name) const {
  std::vector<Words> set;
  bool is_in = false;
  for (Words& row : rows("data.txt")) {
    if (row[0] == "==") {
      is_in = row[1] == name;
    } else if (is_in) {
      set.push_back(std::move(row));
    }
  }
  return set;
}

void Figures::add(const std::string& prefix, const std::string& names,
                  std::initializer_list<long double> figures) {
  std::istringstream words(names);
  for (const long double figure : figures) {
    std::string name;
    words >> name;
    values[prefix + name] = figure;
  }
}

void Check::compare() {
  const long double wanted = expected == "null" ? kNone : std::stold(expected);
  const long double error = std::abs(got - wanted);
  const bool is_same = error == 0 || (std::isnan(got) && std::isnan(wanted));
  passed = is_same || error <= std::stold(limit);
  const auto right = static_cast<double>(-std::log10(error / (wanted == 0 ? 1 : std::abs(wanted))));
  digits = is_same             ? 15
           : std::isnan(error) ? 0
                               : std::round(10 * std::clamp(right, 0.0, 15.0)) / 10;
}

Qualification qualify(std::string version, Timestamp at, const References& references,
                      const iso286::TableData& data) {
  const std::string revision = "1-" + store::shown_digits(store::digest_of(data));
  Qualification made{std::move(version), at, revision, false, {}};
  const auto tables = iso286::ToleranceTables::make(data, {revision});
  const std::size_t findings = tables ? 0 : tables.error().details.size();
  made.checks.push_back({"iso286.rules", "ISO 286-1:2010", "contradictions of the tables", "0", "0",
                         static_cast<long double>(findings)});
  if (tables) check_iso286(references, *tables, made.checks);
  Figures figures;
  add_statistics(references, figures);
  add_uncertainties(references, figures);
  add_fits(references, figures);
  if (tables) add_programs(references, *tables, figures);
  add_expected(references, figures, made.checks);
  made.passed = true;
  for (Check& check : made.checks) {
    check.compare();
    made.passed = made.passed && check.passed;
  }
  return made;
}

std::map<std::string, std::string> files_of(const Qualification& made,
                                            const tlog::SigningKey* key) {
  constexpr const char* kJson = "qualification.json";
  constexpr const char* kPdf = "qualification.pdf";
  const auto line = [](const char* file, std::string_view text) {
    return fmt::format("{} SHA-256 {}", file, to_hex(sha256(text)));
  };
  std::map<std::string, std::string> files{{kJson, to_json(made)}};
  std::vector<std::string> proof{line(kJson, files[kJson])};
  if (key != nullptr) {
    proof.push_back("qualification.note signs both files with the key " + key->verifier().text());
  }
  files[kPdf] = to_pdf(made, proof);
  if (key != nullptr) {
    files["qualification.note"] = tlog::sign_note(
        fmt::format("fitgauge qualification\n{}\n{}\n", proof[0], line(kPdf, files[kPdf])),
        {&key, 1});
  }
  return files;
}

}  // namespace fitgauge::app::qualification
