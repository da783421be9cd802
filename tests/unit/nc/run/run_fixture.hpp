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

inline double number_of(const RunResult& result, std::string_view parameter) {
  const klartext::QRef sought = parse_parameter_name(parameter).value();
  for (const auto& [found, content] : result.parameters) {
    if (found == sought) return std::get<double>(content);
  }
  FAIL(std::string(parameter) << " is undefined");
  return 0;
}

/// Status and last message: `failed line 2: text`.
inline std::string outcome(const RunResult& result) {
  std::string text(word(result.status));
  if (result.status == RunStatus::Completed || result.messages.empty()) return text;
  const RunMessage& last = result.messages.back();
  return text + " line " + std::to_string(last.line) + ": " + last.text;
}

}  // namespace fitgauge::interpreter
