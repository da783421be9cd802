#pragma once

#include <string>

#include "cli/context.hpp"

namespace fitgauge::cli {

// `fitgauge setups …` and `fitgauge runs …`: what lies in the service beside the control's files.

/// `setups ls`
Outcome<ExitCode> run_setups_ls(const Context& context);

/// `setups put NAME FILE`, `-` being standard input.
Outcome<ExitCode> run_setups_put(const Context& context, const std::string& name,
                                 const std::string& file);

/// `setups get NAME [FILE]`: to standard output, or into a file.
Outcome<ExitCode> run_setups_get(const Context& context, const std::string& name,
                                 const std::string& file);

/// `setups rm NAME`
Outcome<ExitCode> run_setups_rm(const Context& context, const std::string& name);

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
