#pragma once

#include <string>
#include <string_view>

namespace fitgauge::store {

/// What the database can do at the moment.
enum class HealthState {
  Ok,             ///< checked, reads and writes work
  Checking,       ///< reads and writes work; a large file is still being checked
  WritesFailing,  ///< the last commit failed (disk full, read-only, I/O error); retried every
                  ///< second
  Damaged,        ///< the check or a read found damage; writes are refused for good
};

/// `ok`, `checking`, `writes_failing`, `damaged`.
constexpr std::string_view word(HealthState state) {
  switch (state) {
    case HealthState::Ok: return "ok";
    case HealthState::Checking: return "checking";
    case HealthState::WritesFailing: return "writes_failing";
    case HealthState::Damaged: return "damaged";
  }
  return "";
}

struct Health {
  HealthState state = HealthState::Ok;
  std::string reason{};  ///< what is wrong, one sentence; empty when Ok
};

}  // namespace fitgauge::store
