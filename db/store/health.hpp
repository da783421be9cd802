#pragma once

#include <string>

namespace fitgauge::store {

/// What the database can do at the moment.
enum class HealthState {
  Ok,             ///< checked, reads and writes work
  Checking,       ///< reads and writes work; a large file is still being checked
  WritesFailing,  ///< the last commit failed (disk full, read-only, I/O error); retried every
                  ///< second
  Damaged,        ///< the check or a read found damage; writes are refused for good
};

struct Health {
  HealthState state = HealthState::Ok;
  std::string reason{};  ///< what is wrong, one sentence; empty when Ok
};

}  // namespace fitgauge::store
