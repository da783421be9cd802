#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "golden_case.hpp"
#include "nc/iso/parser.hpp"
#include "nc/program/program_cache.hpp"

namespace fitgauge::interpreter::golden {
namespace {

namespace fs = std::filesystem;

std::set<fs::path> entries(const fs::path& folder) {
  return {fs::directory_iterator(folder), fs::directory_iterator()};
}

TEST_CASE("each folder runs as expected") {
  std::size_t cases = 0;
  for (const fs::path& folder : entries(kFolder)) {
    if (!fs::exists(folder / "main.h")) continue;
    ++cases;
    CAPTURE(folder.filename().string());
    const std::string outcome = Case(folder).run("main.h");
    if (std::getenv("FITGAUGE_GOLDEN_WRITE") != nullptr) {
      std::ofstream(folder / "expected.txt", std::ios::binary) << outcome;
    }
    CHECK(outcome == content_of(folder / "expected.txt"));
  }
  CHECK(cases > 0);
}

/// The lines of twins differ: a cycle in sub-lines is one block of DIN/ISO.
std::string without_lines(const std::string& text) {
  static const std::regex kLine("line [0-9]+");
  return std::regex_replace(text, kLine, "line -");
}

TEST_CASE("each DIN/ISO twin runs as its Klartext program") {
  std::size_t cases = 0;
  for (const fs::path& folder : entries(kFolder)) {
    if (!fs::exists(folder / "main.i")) continue;
    ++cases;
    CAPTURE(folder.filename().string());
    Case twin(folder);
    twin.add("main.h", content_of(folder / "main.i"));
    for (const auto& found : twin.diagnostics("main.h")) {
      CAPTURE(klartext::render(found));
      CHECK(found.severity != klartext::Severity::Error);
      CHECK(found.code != klartext::DiagnosticCode::ModalStateAssumed);
    }
    CHECK(without_lines(twin.run("main.h")) == without_lines(content_of(folder / "expected.txt")));
  }
  CHECK(cases >= 50);
}

/// A program in the other dialect.
std::string converted(const std::string& text, const std::string& name) {
  const auto parsed = iso::parse_program(text, name);
  const bool is_iso = iso::is_iso(text, name);
  const auto conversion =
      is_iso ? iso::to_klartext(parsed.program, ".I") : iso::to_iso(parsed.program, ".H");
  for (const auto& found : conversion.findings) {
    CAPTURE(klartext::render(found));
    CHECK(found.severity != klartext::Severity::Error);
  }
  return conversion.text;
}

TEST_CASE("each program and its conversion run the same, and it converts back to itself") {
  std::size_t cases = 0;
  for (const fs::path& folder : entries(kFolder)) {
    for (const std::string name : {"main.h", "main.i"}) {
      if (!fs::exists(folder / name)) continue;
      ++cases;
      CAPTURE(folder.filename().string());
      const std::string other = name == "main.h" ? "main.i" : "main.h";
      const std::string text = converted(content_of(folder / name), name);
      CAPTURE(text);
      Case twin(folder);
      twin.add("main.h", text);
      for (const auto& found : twin.diagnostics("main.h")) {
        CAPTURE(klartext::render(found));
        CHECK(found.severity != klartext::Severity::Error);
        CHECK(found.code != klartext::DiagnosticCode::ModalStateAssumed);
      }
      CHECK(without_lines(twin.run("main.h")) ==
            without_lines(content_of(folder / "expected.txt")));
      const std::string back = converted(text, other);
      CHECK(converted(converted(back, name), other) == back);
    }
  }
  CHECK(cases >= 100);
}

TEST_CASE("each bad program ends as its first line says") {
  std::size_t cases = 0;
  for (const fs::path& file : entries(kFolder / "bad")) {
    if (file.extension() != ".h" && file.extension() != ".i") continue;
    ++cases;
    const std::string name = file.filename().string();
    CAPTURE(name);
    const std::string text = content_of(file);
    const std::string first = text.substr(0, text.find('\n'));
    Case bad(name, text);
    const auto diagnostics = bad.diagnostics(name);
    if (first.starts_with("; run: ")) {
      CHECK_FALSE(has_errors(diagnostics));
      bad.run(name);
      CHECK("; run: " + bad.outcome() == first);
      continue;
    }
    REQUIRE(has_errors(diagnostics));
    const auto error = std::find_if(diagnostics.begin(), diagnostics.end(), [](const auto& found) {
      return found.severity == klartext::Severity::Error;
    });
    CHECK(fmt::format("; diagnostic: {} line {}", id(error->code), error->range.begin.line) ==
          first);
  }
  CHECK(cases > 0);
}

}  // namespace
}  // namespace fitgauge::interpreter::golden
