#pragma once

#include "proof/frontier.hpp"
#include "record/measurement.hpp"

namespace fitgauge::app {

/// Makes the leaves of the log: SHA-256(0x00 || the record as its POST answers it). The records are
/// written once, for the leaves and for the answer. Not thread-safe.
class LeafMaker {
 public:
  /// @param measurements with their ids. @returns a leaf for each, valid until the next call.
  std::span<const tlog::Hash> operator()(std::span<const Measurement> measurements);
  tlog::Hash operator()(const Measurement& measurement) {
    return (*this)({&measurement, 1}).front();
  }
  /// The records of the last call, with commas between them; valid until the next.
  std::string_view records() const { return records_; }
  /// Leaves of some of its measurements.
  std::string_view records(std::size_t first, std::size_t count) const {
    return records().substr(begins_[first], begins_[first + count] - 1 - begins_[first]);
  }

 private:
  std::string records_;
  std::vector<std::size_t> begins_;  ///< of each record, and of the next one
  std::vector<tlog::Hash> leaves_;
  tlog::TreeHasher hasher_;
};

/// Returns why a record of another folder cannot be stored; empty: it can. This version must read
/// all of it and write the same text again.
/// @param text the record of `measurement`.
std::string_view finding_in(const Measurement& measurement, std::string_view text);

}  // namespace fitgauge::app
