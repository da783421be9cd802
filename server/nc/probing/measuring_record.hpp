#pragma once

#include "metrology/gauging/gauge.hpp"

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
  std::optional<Length> uncertainty{};        ///< standard uncertainty, if it decides
  std::optional<gauging::Verdict> verdict{};  ///< nothing without limits

  /// Its uncertainty makes a guard band.
  gauging::DecisionRule rule() const;
};

/// The judgement of form that the number of points of a circular feature allows.
struct Form {
  bool assessable = false;
  std::string reason{};                 ///< deviations that stay invisible
  std::optional<double> residual_mm{};  ///< largest distance of a point from the fitted circle
  double diameter_factor = 1;  ///< standard deviation of the diameter divided by that of one touch
  std::size_t points = 0;
  double start_angle_deg = 0;                    ///< of the first point, from the main axis
  std::optional<double> touch_uncertainty_um{};  ///< standard uncertainty, if the setup states it
  /// Range of the points' distances from the centre: a lower bound of the roundness. None for three
  /// points, which always are on a circle.
  std::optional<Length> deviation{};
};

/// The quantity that a cycle measures.
constexpr gauging::Quantity quantity_of(int cycle, bool is_position) {
  using gauging::Quantity;
  if (is_position || cycle == 427) return Quantity::Position;
  if (cycle == 444) return Quantity::Deviation;
  const bool is_width = (cycle >= 408 && cycle <= 411) || (cycle >= 423 && cycle <= 426) ||
                        cycle == 1404 || cycle == 1434;
  return is_width ? Quantity::Width : Quantity::Diameter;
}

/// The outcome of a measuring cycle, stored with the run.
struct MeasuringRecord {
  std::uint16_t cycle = 0;
  std::vector<MeasuredSize> sizes{};          ///< sizes, then positions; none for 0 and 1
  bool has_status = false;                    ///< its verdict is the run's until the next one
  std::optional<gauging::Verdict> verdict{};  ///< of the whole cycle; nothing without limits
  std::optional<Form> form{};                 ///< of circular features
};

/// Judges the diameter with its uncertainty, if the setup states the uncertainty of a touch. The
/// worst verdict becomes the verdict of the cycle. The control knows no uncertainty: its parameters
/// and its log do not change.
void judge_by_uncertainty(MeasuringRecord& record);

}  // namespace fitgauge::probing
