#include "record/gauge_book.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fitgauge::api {
namespace {

std::optional<Timestamp> parse_date(std::string_view text, std::string_view time_of_day) {
  if (const auto time = parse_rfc3339(text)) return *time;
  const auto time = parse_rfc3339(std::string(text).append(time_of_day));
  return time ? std::optional(*time) : std::nullopt;
}

}  // namespace

const GaugePeriod& GaugeInUse::at(Timestamp time) const {
  const auto next = std::upper_bound(
      periods.begin() + 1, periods.end(), time,
      [](Timestamp wanted, const GaugePeriod& period) { return wanted < period.from; });
  return *(next - 1);
}

std::optional<Timestamp> parse_from(std::string_view text) {
  return parse_date(text, "T00:00:00Z");
}
std::optional<Timestamp> parse_due(std::string_view text) {
  return parse_date(text, "T23:59:59.999999999Z");
}

std::optional<Length> rounded_up(double micrometres) {
  constexpr double kNanometres = 1e3;
  constexpr double kNoise = 1e6;  // binary fractions of decimals are not rounded up
  constexpr double kMost = 1e9;
  const double nanometres = std::ceil(std::round(micrometres * kNanometres * kNoise) / kNoise);
  if (!(nanometres >= 0 && nanometres <= kMost)) return std::nullopt;
  return Length::nanometres(static_cast<std::int64_t>(nanometres));
}

}  // namespace fitgauge::api
