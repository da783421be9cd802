#pragma once

#include <doctest/doctest.h>

#include "nc/machine/simulated_machine.hpp"
#include "nc/program/program_cache.hpp"
#include "nc/run/interpreter.hpp"
#include "support/tracing_machine.hpp"

namespace fitgauge::interpreter {

using Lines = std::vector<std::string>;

/// 2026-11-20T08:05:09Z.
class FixedClock final : public Clock {
 public:
  Timestamp now() const override { return parse_rfc3339("2026-11-20T08:05:09Z").value(); }
};

/// A control with a disk and a simulated machine, on which the tests run programs.
class Control {
 public:
  Control() { setup.machine.tools[0].row.cutting_length = 50; }

  /// Adds `TNC:\nc_prog\main.h` of these lines between BEGIN PGM and END PGM.
  void program(std::string_view body, std::string_view name = "main.h", bool is_inch = false) {
    const char* unit = is_inch ? "INCH" : "MM";
    std::string text = "BEGIN PGM X ";
    text += std::string(unit) + "\n" + std::string(body) + "\nEND PGM X " + unit + "\n";
    file(name, text);
  }
  void file(std::string_view name, std::string bytes) {
    disk.write("TNC:\\nc_prog\\" + std::string(name), std::move(bytes));
  }

  std::vector<klartext::Diagnostic> diagnostics() {
    Allowance unlimited;
    return check(main_path(), disk, programs, unlimited).value();
  }

  /// The message of the first finding of the check, or nothing.
  std::string first_finding(std::string_view body) {
    program(body);
    const auto found = diagnostics();
    return found.empty() ? std::string() : found[0].message;
  }

  RunResult run(std::stop_token stop = {}) {
    const auto file = programs.get(*disk.find(main_path()));
    if (file->program == nullptr) {
      std::string all;
      for (const auto& found : file->diagnostics) all += klartext::render(found) + "\n";
      FAIL(all);
    }
    traced.clear();
    allowance.emplace(options.limits.time, options.limits.memory_bytes, std::move(stop));
    if (spent_at) allowance->spend_at_look(spent_at->first, spent_at->second);
    machine = std::make_unique<machine::TracingMachine>(
        setup,
        machine::TraceOptions{
            .keep = [this](const machine::TracedMove& move) { traced.push_back(move); },
            .longest = 1000,
            .lines = true},
        &*allowance);
    return interpreter::run(file->program, {*machine, disk, programs, clock, observer, &*allowance},
                            options);
  }
  /// Runs one body and returns the result.
  RunResult run(std::string_view body) {
    program(body);
    return run();
  }

  /// Adds the cutter 5 of length 100 to the tools.
  void add_cutter(double radius = 4) {
    machine::ToolSetup& cutter = setup.machine.tools.emplace_back();
    cutter.row = {.number = 5, .name = "MILL", .l = 100, .r = radius};
    cutter.row.teeth = 2;
  }
  /// The lines of the last run that begin with one of these words, without the texts to leave out.
  Lines traced_lines(const Lines& words, const Lines& left_out) const {
    Lines kept;
    for (std::string line : machine->lines()) {
      if (std::ranges::none_of(words, [&](auto& word) { return line.starts_with(word); })) continue;
      for (const std::string& text : left_out) {
        for (auto at = line.find(text); at != text.npos; at = line.find(text)) {
          line.erase(at, text.size());
        }
      }
      kept.push_back(std::move(line));
    }
    return kept;
  }

  static ControlPath main_path() { return ControlPath::parse("TNC:\\nc_prog\\main.h").value(); }

  MemoryDisk disk;
  ProgramCache programs;
  FixedClock clock;
  RunObserver observer;
  RunOptions options;
  machine::Setup setup;
  std::optional<Allowance> allowance;
  std::optional<std::pair<std::uint64_t, Allowance::Spent>> spent_at;  ///< the look, and how
  std::unique_ptr<machine::TracingMachine> machine;
  std::vector<machine::TracedMove> traced;  ///< of the last run
};

/// The value of a parameter at the end of a run, as text: `2.5`, `GOOD`, or `undefined`.
inline std::string value(const RunResult& result, std::string_view parameter) {
  const klartext::QRef sought = parse_parameter_name(parameter).value();
  for (const auto& [found, content] : result.parameters) {
    if (!(found == sought)) continue;
    if (const auto* text = std::get_if<std::string>(&content)) return *text;
    std::string number = std::to_string(std::get<double>(content));
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    return number;
  }
  return "undefined";
}

/// Status and last message: `failed line 2: text`.
inline std::string outcome(const RunResult& result) {
  std::string text(word(result.status));
  if (result.status == RunStatus::Completed || result.messages.empty()) return text;
  const RunMessage& last = result.messages.back();
  return text + " line " + std::to_string(last.line) + ": " + last.text;
}

/// Checks parameters at the end of a run: `Q1=2.5, QS1=GOOD, Q3=undefined`.
inline void check_values(const RunResult& result, std::string_view expected) {
  CAPTURE(expected);
  for (std::size_t at = 0; at < expected.size();) {
    const std::string_view each = expected.substr(at, expected.find(", ", at) - at);
    at += each.size() + 2;
    const std::string_view name = each.substr(0, each.find('='));
    CHECK(std::string(name) + "=" + value(result, name) == each);
  }
}

/// Checks that a run completes, and parameters at its end.
inline void check_completes(const RunResult& result, std::string_view expected) {
  CHECK(outcome(result) == "completed");
  check_values(result, expected);
}

inline double number_of(const RunResult& result, std::string_view parameter) {
  const klartext::QRef sought = parse_parameter_name(parameter).value();
  for (const auto& [found, content] : result.parameters) {
    if (found == sought) return std::get<double>(content);
  }
  FAIL(std::string(parameter) << " is undefined");
  return 0;
}

}  // namespace fitgauge::interpreter
