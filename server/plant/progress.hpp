#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plant/connection_state.hpp"
#include "service/documents/document_service.hpp"

namespace fitgauge::connections {

/// How far an outgoing connection has come. Kept in the database beside what it follows.
struct Progress {
  std::int64_t position = 0;  ///< the last measurement that is dealt with
  std::int64_t planned = 0;   ///< what goes out together next ends there; up to `position`: nothing
  std::optional<std::int64_t> event{};  ///< the last stored event that is dealt with
  std::uint64_t refused = 0;
  std::vector<DeadLetter> dead_letters{};  ///< the newest first

  /// Keeps the newest of them.
  void refuse(DeadLetter letter);
};

/// None where the connection has not begun. Waits. @errors those of storage.
Result<std::optional<Progress>> load_progress(app::DocumentService& documents,
                                              const std::string& name);
Result<void> save_progress(app::DocumentService& documents, const std::string& name,
                           const Progress& progress);
/// The number of a new session with the other side: 0 at first, one more each time, 0 after 255;
/// kept before it is given. Waits. @errors those of storage.
Result<std::uint8_t> next_session(app::DocumentService& documents, const std::string& name);
/// Forgets both, also where there is none.
Result<void> forget_progress(app::DocumentService& documents, const std::string& name);

}  // namespace fitgauge::connections
