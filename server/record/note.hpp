#pragma once

#include <optional>
#include <string>

#include "base/clock.hpp"

namespace fitgauge::app {

/// What somebody found out about a measurement or did because of it: at least one of cause, measure
/// and text. It stands beside the record and is never changed.
struct Note {
  std::string id{};           ///< `n3-5f0c9a3e77d21b40`; empty before it is stored
  std::string measurement{};  ///< the id of the record
  std::optional<std::string> cause{};
  std::optional<std::string> measure{};
  std::optional<std::string> text{};
  std::optional<std::string> operator_id{};
  std::optional<std::string> caller{};
  Timestamp received_at{};
};

}  // namespace fitgauge::app
