#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/length.hpp"
#include "metrology/gauging/verdict.hpp"
#include "tables/iso286/feature.hpp"

namespace fitgauge::probing {

/// Limits of a measured value; both belong to the good values.
struct Limits {
  Length upper;
  Length lower;

  friend bool operator==(const Limits&, const Limits&) = default;
};

/// One size, coordinate or position a cycle has measured.
struct MeasuredSize {
  std::string_view characteristic{};  ///< "diameter", "centre main axis": constant text
  iso286::Feature feature = iso286::Feature::Hole;
  bool is_position = false;  ///< of a centre: without feature of size, out of tolerance is reject
  Length nominal{};
  Length measured{};
  std::optional<Limits> limits{};             ///< nothing when the block switches the check off
  std::optional<gauging::Verdict> verdict{};  ///< nothing where the cycle does not judge
};

/// What the number of points lets one say about the form of a circular feature.
struct Form {
  bool assessable = false;
  std::string reason{};                 ///< which deviations stay invisible
  std::optional<double> residual_mm{};  ///< largest distance of a point from the fitted circle
  double diameter_factor = 1;  ///< standard deviation of the diameter over that of one touch
};

/// The outcome of a measuring cycle, kept with the run.
struct MeasuringRecord {
  std::uint16_t cycle = 0;
  std::vector<MeasuredSize> sizes{};          ///< sizes, then positions; none for 0 and 1
  std::optional<gauging::Verdict> verdict{};  ///< of the whole cycle; nothing without status
  std::optional<Form> form{};                 ///< of circular features
};

}  // namespace fitgauge::probing
