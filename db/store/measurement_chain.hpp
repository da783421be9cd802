#pragma once

#include <cstdint>
#include <span>

#include "store/measurement_hash.hpp"

namespace fitgauge::store {

/// The chain the stored measurements form, continued from its end: each row has the next id and the
/// hash over the row before and itself (MeasurementHasher). Not thread-safe.
class MeasurementChain {
 public:
  /// The newest measurement; zeros when there is none.
  struct End {
    std::int64_t id = 0;
    Digest hash{};
  };
  explicit MeasurementChain(const End& end) : end_(end) {}

  /// Gives rows their ids and hashes, in the order in which they are to be appended.
  void link(std::span<MeasurementRow> rows);

  const End& end() const { return end_; }

 private:
  End end_;
  MeasurementHasher hasher_;
};

}  // namespace fitgauge::store
