#pragma once

#include <compare>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "record/measurement.hpp"

namespace fitgauge::api {

/// Two values with one key are of one characteristic of one part.
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

/// A value as far as it says which values of its characteristic count.
struct Candidate {
  CharacteristicKey key{};
  bool is_judged = false;
  Timestamp measured_at{};
  std::optional<bool> go_passes{};  ///< absent: no GO gauge was used, or no limits
  bool counts = false;              ///< after choose()

  /// A value with a verdict stands before one without, then the one measured last.
  auto standing() const { return std::pair(is_judged, measured_at); }
};

inline Candidate candidate_of(const app::Measurement& m) {
  Candidate one{.key = key_of(m), .is_judged = m.is_judged(), .measured_at = m.measured_at};
  if (m.go_gauge && m.is_judged()) one.go_passes = !m.has_failed_envelope();
  return one;
}

/// Marks the value of each characteristic that stands first, and with it a failure of the GO gauge:
/// a later reading without this gauge does not show that it enters.
/// @param values in storage order, each with a candidate; of two that stand equal the later counts
template <class Value>
void choose(std::vector<Value>& values) {
  std::map<std::pair<CharacteristicKey, bool>, Candidate*> first;
  const auto offer = [&first](Candidate& one, bool by_go_gauge) {
    Candidate*& held = first.try_emplace({one.key, by_go_gauge}, &one).first->second;
    if (held->standing() <= one.standing()) held = &one;
  };
  for (Value& value : values) {
    offer(value.candidate, false);
    if (value.candidate.go_passes) offer(value.candidate, true);
  }
  for (const auto& [key, one] : first) one->counts |= !key.second || !*one->go_passes;
}

}  // namespace fitgauge::api
