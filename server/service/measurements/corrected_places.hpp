#pragma once

namespace fitgauge::app {

/// A move of the value that was read as number `from`: to the place before the value that was read
/// as number `to`. Both count from 0, and `to` is at most `from`.
struct MovedValue {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// Finds the places of corrections among values in storage order: a correction belongs to the place
/// of the value that it replaces, of the first value in a chain of corrections.
class CorrectedPlaces {
 public:
  /// Adds a correction and its target, in any order; all of them before the first value.
  void add(std::int64_t id, std::int64_t correction_of) {
    corrections_.push_back({id, correction_of});
  }
  void finish_adding() {
    std::ranges::sort(corrections_, {}, &Correction::id);
    // A corrected record was stored earlier, so that its chain is followed already.
    for (auto correction = corrections_.begin(); correction != corrections_.end(); ++correction) {
      const auto earlier = std::ranges::lower_bound(corrections_.begin(), correction,
                                                    correction->replaced, {}, &Correction::id);
      if (earlier != correction && earlier->id == correction->replaced) {
        correction->replaced = earlier->replaced;
      }
      places_.push_back({.replaced = correction->replaced});
    }
    std::ranges::sort(places_, {}, &Place::replaced);
  }

  /// Adds the id of the next value, which must be larger than the previous id.
  void pass(std::int64_t id) {
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

  /// Returns the moved values in the order of their places.
  std::vector<MovedValue> moves() const {
    std::vector<Seen> ordered = seen_;
    std::ranges::stable_sort(ordered, {}, &Seen::replaced);
    std::vector<MovedValue> moves;
    moves.reserve(ordered.size());
    for (const Seen& value : ordered) {
      const auto place = std::ranges::lower_bound(places_, value.replaced, {}, &Place::replaced);
      moves.push_back({.from = value.index, .to = place->index});
    }
    return moves;
  }

 private:
  struct Correction {
    std::int64_t id = 0;
    std::int64_t replaced = 0;  ///< the first row of its chain
  };
  struct Place {
    std::int64_t replaced = 0;
    std::size_t index = 0;
  };
  struct Seen {
    std::size_t index = 0;
    std::int64_t replaced = 0;
  };

  std::vector<Correction> corrections_;  // by id
  std::vector<Place> places_;            // by what is replaced
  std::vector<Seen> seen_;               // corrections among the values
  std::size_t next_correction_ = 0;
  std::size_t next_place_ = 0;
  std::size_t passed_ = 0;
};

}  // namespace fitgauge::app
