#include "record/gauge_book.hpp"

#include <cmath>
#include <cstdint>

namespace fitgauge::api {

std::optional<Timestamp> parse_due(std::string_view text) {
  const auto time = parse_rfc3339(text);
  if (time) return *time;
  const auto end = parse_rfc3339(std::string(text) + "T23:59:59.999999999Z");
  return end ? std::optional(*end) : std::nullopt;
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
