#include <sstream>

#include "nc/klartext/parser.hpp"
#include "run_fixture.hpp"
#include "support/files.hpp"

/// docs/reference/language.md says what runs: each line of its tables is tried.
namespace fitgauge::interpreter {
namespace {

constexpr const char* kPage = FITGAUGE_SOURCE_DIR "/docs/reference/language.md";

/// A line of a table: its example and what it says of it.
struct Construct {
  std::string example;
  std::string says;
};

std::vector<Construct> constructs() {
  std::vector<Construct> found;
  std::istringstream lines(content_of(kPage));
  for (std::string line; std::getline(lines, line);) {
    const auto begin = line.find("| `");
    const auto end = line.rfind("` | ");
    if (!line.starts_with("| ") || begin == std::string::npos || end == std::string::npos) continue;
    Construct row{line.substr(begin + 3, end - begin - 3), line.substr(end + 4)};
    row.says.erase(row.says.find(' '));
    for (auto at = row.example.find("\\|"); at != std::string::npos; at = row.example.find("\\|")) {
      row.example.erase(at, 1);
    }
    if (const auto at = row.example.find("~ "); at != std::string::npos) row.example[at + 1] = '\n';
    found.push_back(std::move(row));
  }
  return found;
}

TEST_CASE("each construct of the language page is what the page says") {
  const auto all = constructs();
  CHECK(all.size() > 70);
  for (const Construct& row : all) {
    CAPTURE(row.example);
    Control control;
    control.program(row.example + "\nLBL 1\nLBL \"NAME1\"\nTOOL CALL 0 Z");
    if (row.example.starts_with("LBL")) control.program(row.example);
    const auto findings = control.diagnostics();
    const bool warned = !findings.empty();
    if (row.says == "refused") {
      CHECK(has_errors(findings));
    } else {
      CHECK_FALSE(has_errors(findings));
      CHECK(warned == (row.says == "stops"));
      const bool known = row.says == "runs" || row.says == "note" || row.says == "stops";
      CHECK(known);
    }
  }
}

TEST_CASE("the language page names each word that a block begins with") {
  const std::string text = content_of(kPage);
  for (const std::string_view word : klartext::block_keywords()) {
    CAPTURE(word);
    const auto found = std::search(text.begin(), text.end(), word.begin(), word.end());
    CHECK(found != text.end());
  }
}

}  // namespace
}  // namespace fitgauge::interpreter
