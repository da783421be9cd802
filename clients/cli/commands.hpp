#pragma once

#include "cli/context.hpp"

namespace CLI {
class App;
}

namespace fitgauge::cli {

/// The request of a command line.
using Action = std::function<Outcome<ExitCode>(const Context&)>;

/// Registers every command with its options. Parsing stores the action of the chosen command in
/// `chosen`, which must outlive `app`.
void add_commands(CLI::App& app, Action& chosen);

/// completion/fitgauge.bash, from the build.
extern const std::string_view kBashCompletion;

}  // namespace fitgauge::cli
