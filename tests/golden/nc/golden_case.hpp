#pragma once

#include <filesystem>

#include "golden_setup.hpp"
#include "nc/klartext/diagnostic.hpp"
#include "nc/program/control_disk.hpp"
#include "nc/program/program_cache.hpp"
#include "support/files.hpp"
#include "support/tracing_machine.hpp"

namespace fitgauge::interpreter::golden {

inline const std::filesystem::path kFolder =
    std::filesystem::path(FITGAUGE_SOURCE_DIR) / "tests/golden/nc";

/// A run, every command to its machine, a line each, and the touched points in machine coordinates.
struct Ran {
  RunResult result;
  std::vector<std::string> commands;
  std::vector<machine::Vec3> touched;
};

/// A folder of control files and what it takes to run its main program.
class Case {
 public:
  explicit Case(const std::filesystem::path& folder);
  Case(const std::string& name, std::string program) { add(name, std::move(program)); }
  /// On a setup of these lines.
  Case(const std::filesystem::path& folder, const std::string& setup);

  /// A file of the folder, or another text in its place.
  void add(const std::string& name, std::string bytes) {
    disk_.write(path(name), std::move(bytes));
  }

  std::vector<klartext::Diagnostic> diagnostics(const std::string& name);
  /// Nothing for a program that is refused.
  std::optional<Ran> execute(const std::string& name, RunObserver& observer);
  /// The text of expected.txt.
  std::string run(const std::string& name);

  /// Commands to the machine until now, in the run that is under way.
  std::size_t commands() const { return tracing_ == nullptr ? 0 : tracing_->lines().size(); }

  /// Of the last run: `failed line 3: division by zero`.
  const std::string& outcome() const { return outcome_; }
  CaseSetup& setup() { return setup_; }

  static ControlPath path(const std::string& name) {
    return ControlPath::parse("TNC:\\nc_prog\\" + name).value();
  }

 private:
  /// With the tables that the service makes, if the setup asks for them.
  ProjectingDisk disk() const;

  CaseSetup setup_;
  MemoryDisk disk_;
  ProgramCache programs_;
  std::string outcome_;
  const machine::TracingMachine* tracing_ = nullptr;
};

}  // namespace fitgauge::interpreter::golden
