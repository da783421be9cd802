#pragma once

#include <compare>
#include <string>

#include "record/measurement.hpp"

namespace fitgauge::api {

/// Two values with one key are of one characteristic of one part: one of them counts.
struct CharacteristicKey {
  std::string part{};  ///< empty: the value stands alone, under its id
  std::string name{};

  friend auto operator<=>(const CharacteristicKey&, const CharacteristicKey&) = default;
};

/// A value that names no characteristic stands alone: three bores of one size are three.
inline CharacteristicKey key_of(const app::Measurement& m) {
  if (!m.part_id || !m.characteristic) {
    return {.name = app::measurement_id_text(m.id, m.origin)};
  }
  return {.part = std::string(*m.part_id), .name = std::string(*m.characteristic)};
}

/// Orders the values of a characteristic: judged values are greater, then newer ones.
struct Standing {
  bool is_judged = false;
  Timestamp measured_at{};

  friend auto operator<=>(const Standing&, const Standing&) = default;
};

inline Standing standing_of(const app::Measurement& m) { return {m.is_judged(), m.measured_at}; }

}  // namespace fitgauge::api
