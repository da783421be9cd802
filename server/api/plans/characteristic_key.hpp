#pragma once

#include <compare>
#include <string>

#include "record/measurement.hpp"

namespace fitgauge::api {

/// Two values with one key are of one characteristic of one part: the value measured last counts.
struct CharacteristicKey {
  std::string part{};  ///< empty: the value stands alone
  std::string name{};
  // Of a value without a name, its size tells it from others:
  Length nominal{};
  Length upper{};
  Length lower{};

  friend auto operator<=>(const CharacteristicKey&, const CharacteristicKey&) = default;
};

inline CharacteristicKey key_of(const app::Measurement& m) {
  if (!m.part_id) return {.name = app::measurement_id_text(m.id, m.origin)};
  CharacteristicKey key{.part = std::string(*m.part_id)};
  if (m.characteristic) {
    key.name = *m.characteristic;
  } else {
    key.nominal = m.nominal_size;
    key.upper = m.deviations.upper;
    key.lower = m.deviations.lower;
  }
  return key;
}

}  // namespace fitgauge::api
