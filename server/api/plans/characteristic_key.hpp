#pragma once

#include "record/measurement.hpp"

namespace fitgauge::api {

/// Identifies one characteristic of one part.
struct CharacteristicKey {
  std::string part{};  ///< empty: the value stands alone, under its id
  std::string name{};

  friend auto operator<=>(const CharacteristicKey&, const CharacteristicKey&) = default;
};

/// Returns the key of a value. Without part or characteristic the key is the value's id.
inline CharacteristicKey key_of(const app::Measurement& m) {
  if (!m.part_id || !m.characteristic) return {.name = app::measurement_id_text(m.id, m.origin)};
  return {.part = std::string(*m.part_id), .name = std::string(*m.characteristic)};
}

/// Fields of a value that decide if it counts for its characteristic.
struct Candidate {
  CharacteristicKey key{};
  bool is_judged = false;
  Timestamp measured_at{};
  std::optional<bool> go_passes{};  ///< absent: no GO gauge was used, or no limits
  bool counts = false;              ///< after choose()

  /// Returns the rank: values with a verdict rank above values without one, then later ones.
  auto standing() const { return std::pair(is_judged, measured_at); }
};

inline Candidate candidate_of(const app::Measurement& m) {
  Candidate one{.key = key_of(m), .is_judged = m.is_judged(), .measured_at = m.measured_at};
  if (m.go_gauge && m.is_judged()) one.go_passes = !m.has_failed_envelope();
  return one;
}

/// Sets `counts` of the highest value of each characteristic, and of a failure of the GO gauge: a
/// later reading without this gauge does not show that it enters.
/// @param values in storage order, each with a candidate; of two equal ranks the later one counts
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
