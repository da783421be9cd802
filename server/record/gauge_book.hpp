#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/clock.hpp"
#include "base/length.hpp"

namespace fitgauge::api {

/// What a gauge in use says of the measurements that name it, from a calibration to the next.
struct GaugePeriod {
  Timestamp from{std::numeric_limits<std::int64_t>::min()};
  std::string budget{};  ///< its name; empty: none
  /// Of the budget, whose figures are in µm, rounded up to the nanometre; none where there is no
  /// such budget any more.
  std::optional<Length> standard_uncertainty{};
  std::optional<std::int64_t> degrees_of_freedom{};  ///< of the budget, in millionths
  std::string calibration_due{};                     ///< as it was given; empty: not at all
  std::optional<Timestamp> due{};                    ///< the same; a date lasts to its end in UTC
  bool is_blocked = false;

  bool is_overdue(Timestamp at) const { return due && *due < at; }
};

struct GaugeInUse {
  /// By time. The first is what the gauge itself says; it has no beginning.
  std::vector<GaugePeriod> periods{1};

  /// The period that a time lies in.
  const GaugePeriod& at(Timestamp time) const;
};

/// The gauges in use, by name.
using GaugeBook = std::map<std::string, GaugeInUse, std::less<>>;

/// When a calibration begins or is due: a date from its beginning or to its end in UTC, or an
/// RFC 3339 time. None for other texts.
std::optional<Timestamp> parse_from(std::string_view text);
std::optional<Timestamp> parse_due(std::string_view text);

/// A standard uncertainty in µm as measurements have it: rounded up to the nanometre. None where it
/// is no length.
std::optional<Length> rounded_up(double micrometres);

}  // namespace fitgauge::api
