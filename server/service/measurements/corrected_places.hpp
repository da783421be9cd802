#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fitgauge::app {

/// A value that belongs elsewhere than where it was read: before the one read as number `to`, which
/// is at most `from`. Both count from 0, in the order of reading.
struct MovedValue {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// Finds the places of corrections among values that are read in storage order: a correction
/// belongs where the value stood that it replaces, which of a correction's correction is the first.
class CorrectedPlaces {
 public:
  /// Corrections and what they correct, in any order; all of them before the first value.
  void add(std::int64_t id, std::int64_t correction_of);
  void finish_adding();

  /// The id of the next value, larger than that of the one before.
  void pass(std::int64_t id);

  /// In the order of their places.
  std::vector<MovedValue> moves() const;

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
