#include "service/measurements/corrected_places.hpp"

namespace fitgauge::app {

void CorrectedPlaces::add(std::int64_t id, std::int64_t correction_of) {
  corrections_.push_back({id, correction_of});
}

void CorrectedPlaces::finish_adding() {
  std::sort(corrections_.begin(), corrections_.end(),
            [](const Correction& a, const Correction& b) { return a.id < b.id; });
  // A corrected record was stored earlier, so that its chain is followed already.
  for (auto correction = corrections_.begin(); correction != corrections_.end(); ++correction) {
    const auto earlier =
        std::lower_bound(corrections_.begin(), correction, correction->replaced,
                         [](const Correction& of, std::int64_t id) { return of.id < id; });
    if (earlier != correction && earlier->id == correction->replaced) {
      correction->replaced = earlier->replaced;
    }
    places_.push_back({.replaced = correction->replaced});
  }
  std::sort(places_.begin(), places_.end(),
            [](const Place& a, const Place& b) { return a.replaced < b.replaced; });
}

void CorrectedPlaces::pass(std::int64_t id) {
  for (; next_place_ < places_.size() && places_[next_place_].replaced < id; ++next_place_) {
    places_[next_place_].index = passed_;
  }
  while (next_correction_ < corrections_.size() && corrections_[next_correction_].id < id) {
    ++next_correction_;
  }
  if (next_correction_ < corrections_.size() && corrections_[next_correction_].id == id) {
    seen_.push_back({passed_, corrections_[next_correction_].replaced});
  }
  ++passed_;
}

std::vector<MovedValue> CorrectedPlaces::moves() const {
  std::vector<Seen> ordered = seen_;
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Seen& a, const Seen& b) { return a.replaced < b.replaced; });
  std::vector<MovedValue> moves;
  moves.reserve(ordered.size());
  for (const Seen& value : ordered) {
    const auto place =
        std::lower_bound(places_.begin(), places_.end(), value.replaced,
                         [](const Place& of, std::int64_t id) { return of.replaced < id; });
    moves.push_back({.from = value.index, .to = place->index});
  }
  return moves;
}

}  // namespace fitgauge::app
