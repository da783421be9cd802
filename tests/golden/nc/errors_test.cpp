#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "golden_setup.hpp"
#include "nc/machine/simulated_machine.hpp"
#include "nc/probing/cycle_descriptor.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/program/program_cache.hpp"
#include "support/files.hpp"

/// The errors of each cycle, as errors.txt says how to come by them.
namespace fitgauge::interpreter::golden {
namespace {

namespace fs = std::filesystem;
using probing::CycleDescriptor;

const fs::path kCases = fs::path(FITGAUGE_SOURCE_DIR) / "tests/golden/nc";
using Lines = std::vector<std::string>;

/// The trimmed parts of a text.
Lines split_text(const std::string& text, char separator) {
  Lines parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.emplace_back(trim(part));
  return parts;
}

/// A line of errors.txt.
struct ErrorRow {
  std::set<int> cycles;
  int error = 0;
  Lines before;
  std::string values;

  bool is_reachable() const { return before.empty() || !before.front().starts_with("never:"); }
};

std::set<int> cycles_in(const std::string& list) {
  std::set<int> numbers;
  for (const std::string& range : split_text(list, ',')) {
    const auto ends = split_text(range, '-');
    for (const probing::TouchProbeCycle* cycle : probing::cycles()) {
      const int number = cycle->descriptor.number;
      if (number >= std::stoi(ends.front()) && number <= std::stoi(ends.back())) {
        numbers.insert(number);
      }
    }
  }
  return numbers;
}

std::vector<ErrorRow> error_rows() {
  std::vector<ErrorRow> rows;
  for (const std::string& line : split_text(content_of(kCases / "errors.txt"), '\n')) {
    if (line.empty() || line.front() == '#') continue;
    Lines fields = split_text(line, '|');
    fields.resize(4);
    rows.push_back(
        {cycles_in(fields[0]), std::stoi(fields[1]), split_text(fields[2], ';'), fields[3]});
    std::erase(rows.back().before, "");
  }
  return rows;
}

fs::path folder_of(int cycle) {
  if (cycle < 5) return kCases / "cycle-0-to-4";
  if (cycle < 34) return kCases / "cycle-30-to-33";
  return kCases / (cycle == 247 ? "datum" : fmt::format("cycle-{}", cycle));
}

/// The program of a cycle's golden folder up to its first block of the cycle.
class FirstBlock {
 public:
  explicit FirstBlock(int cycle) {
    setup_ = content_of(folder_of(cycle) / "setup.txt");
    const std::string family = cycle == 247 ? "CYCL DEF" : "TCH PROBE";
    const std::string head = fmt::format("{} {}", family, cycle);
    bool is_other = false;
    for (std::string line : split_text(content_of(folder_of(cycle) / "main.h"), '\n')) {
      line.erase(0, line.find_first_not_of("0123456789 "));
      const bool goes_on = line.ends_with('~');
      if (!block_.empty()) {
        if (!line.starts_with(head + '.') && !block_.back().ends_with('~')) break;
        block_.push_back(line);
      } else if (line.starts_with(head + ' ') || line.starts_with(head + ".0")) {
        block_.push_back(line);
      } else if (line.starts_with("TCH PROBE") || is_other) {
        is_other = goes_on;
      } else if (!line.starts_with("Q16") && line.find("LBL") == std::string::npos &&
                 line != "M30") {  // without results, calls and the end
        program_.push_back(line);
      }
    }
    REQUIRE_FALSE(block_.empty());
  }

  void add_before(const Lines& before) {
    for (const std::string& item : before) {
      if (item.front() == '@') {
        setup_ += '\n' + item.substr(1);
      } else if (item.front() == '-') {
        std::erase_if(program_,
                      [&](const std::string& line) { return line.starts_with(item.substr(1)); });
      } else {
        program_.push_back(item);
      }
    }
  }

  /// `Q247=0 QS400="a bit"`; numbers go through a parameter, or the block would not be linked.
  void set_values(const std::string& values) {
    if (values.starts_with('=')) {
      block_ = split_text(values.substr(1), ';');
      return;
    }
    for (std::size_t at = values.find('Q'); at != std::string::npos;) {
      const std::size_t next = values.find(" Q", at);
      const std::string assignment =
          values.substr(at, next == std::string::npos ? next : next - at);
      set_value(assignment.substr(0, assignment.find('=')),
                assignment.substr(assignment.find('=') + 1));
      at = next == std::string::npos ? next : next + 1;
    }
  }
  void set_value(const std::string& name, std::string value) {
    const std::string number = name.substr(name.find_first_of("0123456789"));
    std::erase_if(block_, [&](const std::string& line) {
      return line.starts_with('Q' + number + '=') || line.starts_with("QS" + number + '=');
    });
    if (value.empty()) return;
    if (value.front() != '"' && !value.starts_with("QS")) {
      const std::string parameter = fmt::format("Q{}", 1800 + program_.size());
      program_.push_back(fmt::format("{} = {}", parameter, value));
      value = parameter;
    }
    block_.push_back(fmt::format("{}={}", name, value));
  }

  /// The number of the error that ends the run; -1 where there is none.
  int error() const {
    MemoryDisk disk;
    ProgramCache programs;
    const ControlPath path = ControlPath::parse("TNC:\\main.h").value();
    disk.write(path, text());
    CaseSetup setup = read_setup(setup_);
    const auto file = programs.get(*disk.find(path));
    if (file->program == nullptr) {
      FAIL_CHECK(klartext::render(file->diagnostics.front()), "\n", text());
      return -1;
    }
    machine::SimulatedMachine machine(setup.machine);
    const SystemClock clock;
    RunObserver observer;
    const RunResult result =
        interpreter::run(file->program, {machine, disk, programs, clock, observer}, setup.options);
    INFO(text());
    if (result.status == RunStatus::Completed) return -1;
    REQUIRE_FALSE(result.messages.empty());
    return result.messages.back().number;
  }

  std::string text() const {
    std::string text;
    for (const std::string& line : program_) text += line + '\n';
    for (std::size_t k = 0; k < block_.size(); ++k) {
      std::string line(trim(block_[k].substr(0, block_[k].find('~'))));
      const bool goes_on = k + 1 < block_.size() && block_[k + 1].starts_with('Q');
      text += line + (goes_on ? " ~\n" : "\n");
    }
    const std::string begin = program_.front();
    return text + "END PGM" + begin.substr(begin.find(' ', 6)) + '\n';
  }

 private:
  std::string setup_;
  Lines program_;
  Lines block_;
};

/// A value that each cycle with such a parameter refuses.
std::map<int, std::string> bad_values(const CycleDescriptor& cycle) {
  std::map<int, std::string> values;
  for (const probing::CycleParameter& parameter : cycle.parameters) {
    if (parameter.is_text() || cycle.dotted) continue;
    const auto assign = [&](double value) { return fmt::format("{}={}", name(parameter), value); };
    if (parameter.range.max < 1e9) values.emplace(1004, assign(parameter.range.max + 1));
    if (parameter.kind == probing::ValueKind::Whole) {
      values.emplace(1011, assign(parameter.range.min + 0.5));
    }
  }
  return values;
}

}  // namespace

TEST_CASE("each cycle ends with each of its errors") {
  std::map<int, std::set<int>> shown;
  for (const ErrorRow& row : error_rows()) {
    for (const int cycle : row.cycles) {
      CAPTURE(cycle);
      CAPTURE(row.error);
      CHECK(shown[cycle].insert(row.error).second);
      if (!row.is_reachable()) continue;
      FirstBlock program(cycle);
      program.add_before(row.before);
      program.set_values(row.values);
      CHECK_MESSAGE(program.error() == row.error, program.text());
    }
  }
  for (const probing::TouchProbeCycle* cycle : probing::cycles()) {
    const CycleDescriptor& descriptor = cycle->descriptor;
    std::set<int>& errors = shown[descriptor.number];
    for (const auto& [error, values] : bad_values(descriptor)) {
      if (!errors.insert(error).second) continue;
      FirstBlock program(descriptor.number);
      program.set_values(values);
      CHECK_MESSAGE(program.error() == error, program.text());
    }
    CAPTURE(descriptor.number);
    for (const int error : errors_of(descriptor)) {
      CAPTURE(error);
      CHECK(errors.contains(error));
    }
    CHECK(errors.size() == errors_of(descriptor).size());
  }
}

TEST_CASE("in a state that many cycles refuse, none ends with an error it does not name") {
  const std::map<int, std::string> states{
      {1001, "-TOOL CALL"},
      {1092, "TOOL CALL 0 Z"},
      {1093, "@tool 7 80 8 MILL; TOOL CALL 7 Z"},
      {1008, "CYCL DEF 8.0 MIRROR IMAGE; CYCL DEF 8.1 X"},
      {1007, "CYCL DEF 11.0 SCALING; CYCL DEF 11.1 SCL0.5"},
      {1108, "CYCL DEF 26.0 AXIS-SPEC. SCALING; CYCL DEF 26.1 X1.1 Y1 CCX+0 CCY+0"},
      {1075, "@rotary B -90 90; PLANE SPATIAL SPA+0 SPB+10 SPC+0 STAY"},
      {1014, "@nothing"}};
  for (const probing::TouchProbeCycle* cycle : probing::cycles()) {
    const std::set<int> named = errors_of(cycle->descriptor);
    CAPTURE(cycle->descriptor.number);
    for (const auto& [error, before] : states) {
      CAPTURE(error);
      FirstBlock program(cycle->descriptor.number);
      program.add_before(split_text(before, ';'));
      const int found = program.error();
      // Faults of the machine (0) have no number; a state that is refused is named.
      CHECK((found <= 0 || named.contains(found)));
      if (found == error) CHECK(named.contains(error));
    }
  }
}

TEST_CASE("each cycle with a status shows each of its values") {
  // Good, rework and reject as the programs note Q180 to Q182; Q183 of 444; Q199 of tools.
  const std::map<int, std::set<std::string>> values{
      {180, {"100", "10", "1"}}, {183, {"-1", "0", "1", "2"}}, {199, {"0", "1", "2"}}};
  for (const probing::TouchProbeCycle* cycle : probing::cycles()) {
    const CycleDescriptor& descriptor = cycle->descriptor;
    CAPTURE(descriptor.number);
    for (const probing::CycleOutput& result : descriptor.results) {
      if (!values.contains(result.q)) continue;
      std::set<std::string> missing = values.at(result.q);
      for (const std::string& line :
           split_text(content_of(folder_of(descriptor.number) / "expected.txt"), '\n')) {
        if (line.starts_with("Q16")) missing.erase(line.substr(line.find('=') + 2));
      }
      CHECK(missing.empty());
    }
  }
}

}  // namespace fitgauge::interpreter::golden
