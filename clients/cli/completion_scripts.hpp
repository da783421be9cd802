#pragma once

#include <string>

namespace CLI {
class App;
}

namespace fitgauge::cli {

// Completion scripts made from the commands themselves, with their help. That of bash is written
// by hand (completion/fitgauge.bash).

std::string fish_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);

}  // namespace fitgauge::cli
