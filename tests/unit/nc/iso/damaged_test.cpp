#include <doctest/doctest.h>

#include <random>

#include "nc/iso/parser.hpp"
#include "nc/klartext/parser.hpp"
#include "support/files.hpp"
#include "support/same_program.hpp"

namespace fitgauge::iso {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> twins() {
  std::vector<std::string> found;
  for (const auto& folder :
       fs::directory_iterator(fs::path(FITGAUGE_SOURCE_DIR) / "tests/golden/nc")) {
    const fs::path twin = folder.path() / "main.i";
    if (fs::exists(twin)) found.push_back(content_of(twin));
  }
  return found;
}

/// Every finding has its place; without errors, the program printed as Klartext reads back as the
/// same.
/// @returns whether it has no errors.
bool check_read(const std::string& text) {
  const auto parsed = parse_program(text, "t.i");
  for (const auto& found : parsed.diagnostics) {
    CHECK(found.range.begin.line >= 1);
    CHECK_FALSE(found.range.end < found.range.begin);
    CHECK_FALSE(klartext::render(found).empty());
  }
  for (const klartext::Block& block : parsed.program.blocks()) {
    REQUIRE(std::size_t{block.written.first} + block.written.count <=
            parsed.program.source().size());
  }
  if (parsed.has_errors()) return false;
  const auto again = klartext::parse_program(klartext::print_program(parsed.program), "t.h");
  CAPTURE(text);
  CHECK(again.program == parsed.program);
  return true;
}

TEST_CASE("Each twin prints as Klartext that reads back as the same") {
  const auto texts = twins();
  CHECK(texts.size() >= 50);
  for (const std::string& text : texts) CHECK(check_read(text));
}

TEST_CASE("Damaged programs are read or refused, never half") {
  constexpr std::string_view kPieces[] = {
      "*", "~", "\n", ";", "\"", "%",  "G",   "G91 ", "G26 R5 ", "P01 ",         "L1,2", "Q1 = ",
      " ", "/", "N",  ",", "-",  "X+", "QS1", "\xFF", "D09 ",    "CYCL DEF 7.0", "G421 "};
  std::mt19937 random(1);
  const auto below = [&random](std::size_t n) { return random() % n; };
  std::size_t good = 0;
  for (const std::string& twin : twins()) {
    for (int i = 0; i < 40; ++i) {
      std::string text = twin;
      for (std::size_t k = below(4) + 1; k > 0; --k) {
        const std::size_t at = below(text.size());
        switch (below(3)) {
          case 0: text.insert(at, kPieces[below(std::size(kPieces))]); break;
          case 1: text.erase(at, below(6) + 1); break;
          default: text.insert(at, text.substr(below(text.size()), below(30)));
        }
      }
      if (check_read(text)) ++good;
    }
  }
  CHECK(good > 100);
}

}  // namespace
}  // namespace fitgauge::iso
