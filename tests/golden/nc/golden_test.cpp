#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "golden_setup.hpp"
#include "nc/iso/parser.hpp"
#include "nc/iso/printer.hpp"
#include "nc/machine/simulated_machine.hpp"
#include "nc/machine/tracing_machine.hpp"
#include "nc/program/check.hpp"
#include "tables/tabfile/iso286_projection.hpp"
#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::interpreter::golden {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(FITGAUGE_SOURCE_DIR) / "tests/golden/nc";

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class GoldenClock final : public Clock {
 public:
  Timestamp now() const override { return parse_rfc3339("2026-11-20T08:05:09Z").value(); }
};

std::string number_text(double value) {
  // Rounded to a nanometre: what differs beyond is rounding of the arithmetic.
  std::string text = fmt::format("{:.6f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string describe(const std::optional<probing::Form>& form) {
  if (!form) return {};
  std::string out = form->assessable ? "form assessable" : "form not assessable";
  if (form->residual_mm) out += fmt::format(", residual {}", number_text(*form->residual_mm));
  return fmt::format("{}: {}\n", out, form->reason);
}

std::string describe(const RunResult& result, const machine::TracingMachine& machine, bool trace) {
  std::string out = fmt::format("status {}\n", word(result.status));
  for (const RunMessage& message : result.messages) {
    out += fmt::format("message {} {} line {}: {}\n", word(message.kind), message.number,
                       message.line, message.text);
  }
  for (const std::string& line : result.screen) out += fmt::format("screen {}\n", line);
  for (const auto& [parameter, value] : result.parameters) {
    const auto* number = std::get_if<double>(&value);
    out += fmt::format("{} = {}\n", name(parameter),
                       number != nullptr ? number_text(*number) : std::get<std::string>(value));
  }
  for (const Measurement& measurement : result.measurements) {
    out += fmt::format("measured cycle {} line {}\n", measurement.record.cycle, measurement.line);
    out += describe(measurement.record.form);
  }
  if (result.verdict) out += fmt::format("verdict {}\n", gauging::word(*result.verdict));
  for (const WrittenFile& file : result.files) {
    out += fmt::format("file {}\n{}", file.path.text(), file.bytes);
  }
  if (trace) {
    for (const std::string& line : machine.lines()) out += fmt::format("trace {}\n", line);
  }
  return out;
}

ProjectingDisk::Projection projection(const iso286::ToleranceTables& tables,
                                      iso286::Feature feature, std::string name) {
  const auto table = std::make_shared<const tabfile::TabTable>(tabfile::project(tables, feature));
  return {std::move(name), std::make_shared<const std::string>(tabfile::write_tab(*table)), "iso",
          table};
}

/// A folder of control files and what it takes to run its main program.
class Case {
 public:
  explicit Case(const fs::path& folder) {
    if (fs::exists(folder / "setup.txt")) setup_ = read_setup(read_file(folder / "setup.txt"));
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name != "setup.txt" && name != "expected.txt") add(name, read_file(entry.path()));
    }
  }
  Case(const std::string& name, std::string program) { add(name, std::move(program)); }

  /// Another text in the place of a file.
  void replace(const std::string& name, std::string bytes) { add(name, std::move(bytes)); }

  std::vector<klartext::Diagnostic> diagnostics(const std::string& name) {
    Allowance unlimited;
    return check(path(name), disk_, programs_, unlimited).value();
  }

  std::string run(const std::string& name) {
    std::vector<ProjectingDisk::Projection> projections;
    if (setup_.live_tables) {
      static const auto kTables =
          iso286::ToleranceTables::make(iso286::compiled_in_tables(), {}).value();
      projections.push_back(projection(kTables, iso286::Feature::Hole, "82553_hole.tab"));
      projections.push_back(projection(kTables, iso286::Feature::Shaft, "82553_shaft.tab"));
    }
    const ProjectingDisk disk(disk_, std::move(projections));
    const auto file = programs_.get(*disk.find(path(name)));
    if (file->program == nullptr) return "refused: " + klartext::render(file->diagnostics.front());
    machine::SimulatedMachine machine(setup_.machine);
    machine::TracingMachine tracing(machine, {.keep = {}, .longest = 10'000, .lines = true});
    const GoldenClock clock;
    RunObserver observer;
    const RunResult result = interpreter::run(
        file->program, {tracing, disk, programs_, clock, observer}, setup_.options);
    last_ = result.messages.empty() ? RunMessage{} : result.messages.back();
    status_ = result.status;
    return describe(result, tracing, setup_.trace);
  }

  /// `failed line 3: division by zero`.
  std::string outcome() const {
    return fmt::format("{} line {}: {}", word(status_), last_.line, last_.text);
  }

 private:
  static ControlPath path(const std::string& name) {
    return ControlPath::parse("TNC:\\nc_prog\\" + name).value();
  }
  void add(const std::string& name, std::string bytes) {
    disk_.write(path(name), std::move(bytes));
  }

  CaseSetup setup_;
  MemoryDisk disk_;
  ProgramCache programs_;
  RunMessage last_;
  RunStatus status_{};
};

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
    CHECK(outcome == read_file(folder / "expected.txt"));
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
    twin.replace("main.h", read_file(folder / "main.i"));
    for (const auto& found : twin.diagnostics("main.h")) {
      CAPTURE(klartext::render(found));
      CHECK(found.severity != klartext::Severity::Error);
      CHECK(found.code != klartext::DiagnosticCode::ModalStateAssumed);
    }
    CHECK(without_lines(twin.run("main.h")) == without_lines(read_file(folder / "expected.txt")));
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
      const std::string text = converted(read_file(folder / name), name);
      CAPTURE(text);
      Case twin(folder);
      twin.replace("main.h", text);
      for (const auto& found : twin.diagnostics("main.h")) {
        CAPTURE(klartext::render(found));
        CHECK(found.severity != klartext::Severity::Error);
        CHECK(found.code != klartext::DiagnosticCode::ModalStateAssumed);
      }
      CHECK(without_lines(twin.run("main.h")) == without_lines(read_file(folder / "expected.txt")));
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
    const std::string text = read_file(file);
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
