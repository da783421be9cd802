#pragma once

#include <string>
#include <vector>

#include "daemon/config.hpp"

namespace fitgauge::daemon {

// The commands beside a running service, or without one. Each prints its result and gives the exit
// code; an error is printed by the caller.

/// `fitgauged backup FILE`
Result<int> run_backup(const Config& config, const std::string& file);
/// `fitgauged verify`: 1 when there are findings. @param checkpoints files that were kept
/// elsewhere.
Result<int> run_verify(const Config& config, const std::vector<std::string>& checkpoints);
/// `fitgauged log-key`: the log gets a new key, which signs from the next start on.
Result<int> run_log_key(const Config& config);
/// `fitgauged key create|revoke|list`
Result<int> run_key_create(const Config& config, const std::string& name, const std::string& role);
Result<int> run_key_revoke(const Config& config, const std::string& name);
Result<int> run_key_list(const Config& config);

}  // namespace fitgauge::daemon
