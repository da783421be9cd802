#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "record/measurement.hpp"

namespace fitgauge::app {

/// Appends the record of a measurement: JSON in the form of RFC 8785 (members sorted, one spelling
/// of each number and text), so that the record as it is answered is also what the log holds of it.
/// Fields that were not given are left out. Numbers are exact decimals: the finest step, 0.001 µm,
/// is coarser than the doubles around the longest length, so RFC 8785 spells them alike.
void append_record(std::string& out, const Measurement& measurement);

/// Appends records, one after the other. Those of a request mostly have the same times and limits:
/// these are copied from the record before. Each measurement stays where it is until the next is
/// written.
class RecordWriter {
 public:
  explicit RecordWriter(std::string& out) : out_(out) {}

  void append(const Measurement& measurement);

 private:
  static constexpr std::size_t kMostMembers = 80;
  /// Where a part of the record before stands.
  struct Place {
    std::size_t at = 0;
    std::size_t size = 0;
  };
  std::string& out_;
  const Measurement* before_ = nullptr;
  std::array<Place, kMostMembers> parts_;  ///< of the members that records share
};

}  // namespace fitgauge::app
