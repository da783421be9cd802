#pragma once

#include "cli/context.hpp"

namespace fitgauge::cli {

// `fitgauge setups …`, `budgets …`, `gauges …`, `studies …` and `runs …`: documents and runs in the
// service.

/// Documents that are stored under a name.
struct StoredKind {
  std::string_view command;  ///< `setups`
  std::string_view what;     ///< for its help: `a setup`
  std::string_view help;
  std::string_view path;    ///< of the list; each is below it
  std::string_view member;  ///< of the list's answer
};
inline constexpr std::array<StoredKind, 4> kStoredKinds = {{
    {"setups", "a setup", "Setups of runs: machine, tools and workpiece", "/v1/setups", "setups"},
    {"budgets", "an uncertainty budget", "Uncertainty budgets", "/v1/uncertainties",
     "uncertainties"},
    {"gauges", "a gauge in use", "Gauges in use: uncertainty and calibration", "/v1/gauges-in-use",
     "gauges"},
    {"studies", "a gauge study", "Gauge studies and their results", "/v1/studies", "studies"},
}};

/// `setups ls`
Outcome<ExitCode> run_stored_ls(const Context& context, const StoredKind& kind);

/// `setups put NAME FILE`, `-` being standard input.
Outcome<ExitCode> run_stored_put(const Context& context, const StoredKind& kind,
                                 const std::string& name, const std::string& file);

/// `setups get NAME [FILE]`: to standard output, or into a file.
Outcome<ExitCode> run_stored_get(const Context& context, const StoredKind& kind,
                                 const std::string& name, const std::string& file);

/// `setups rm NAME`
Outcome<ExitCode> run_stored_rm(const Context& context, const StoredKind& kind,
                                const std::string& name);

struct RunsQuery {
  std::string status{};
  std::string program{};
  std::uint64_t limit = 100;
  std::string after{};
};

/// `runs ls`: the newest first.
Outcome<ExitCode> run_runs_ls(const Context& context, const RunsQuery& query);

/// `runs show ID`: screen, messages and files of one run.
Outcome<ExitCode> run_runs_show(const Context& context, const std::string& id);

/// `runs get ID NAME [FILE]`: a file the run has written.
Outcome<ExitCode> run_runs_get(const Context& context, const std::string& id,
                               const std::string& name, const std::string& file);

/// `runs cancel ID`
Outcome<ExitCode> run_runs_cancel(const Context& context, const std::string& id);

}  // namespace fitgauge::cli
