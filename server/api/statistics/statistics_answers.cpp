#include "api/statistics/statistics_answers.hpp"

#include "base/length.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kPointRoom = 32;  ///< for any double, and the comma before it

/// Writes a point of a measured value, a decimal of nanometres. Up to 15 digits that decimal is the
/// shortest text that reads back as the same double, and is found faster. @returns the end of its
/// text
char* write_point(char* to, double point) {
  constexpr double kNanometresOfOne = 1e6;
  constexpr double kMost = 1e15;
  constexpr int kDecimalPlaces = 6;
  const double nanometres = std::nearbyint(point * kNanometresOfOne);
  if (std::abs(nanometres) < kMost && nanometres / kNanometresOfOne == point) {
    return write_decimal(to, static_cast<std::int64_t>(nanometres), kDecimalPlaces);
  }
  if (!std::isfinite(point)) return std::copy_n("null", 4, to);
  return std::to_chars(to, to + kPointRoom, point).ptr;
}

}  // namespace

std::span<const Applicable> chart_members() {
  static constexpr std::array<Applicable, 3> kMembers = {{
      {"lambda", "ewma"},
      {"reference_value", "cusum"},
      {"decision_interval", "cusum"},
  }};
  return kMembers;
}

/// Some hundred points at a time.
void Points::write(JsonWriter& json, const std::vector<double>& points) const {
  json.begin_array();
  std::array<char, 8192> piece{};
  char* at = piece.data();
  for (const double point : points) {
    if (at != piece.data()) *at++ = ',';
    at = write_point(at, point);
    if (piece.data() + piece.size() - at >= static_cast<std::ptrdiff_t>(kPointRoom)) continue;
    json.raw({piece.data(), at});
    at = piece.data();
  }
  if (at != piece.data()) json.raw({piece.data(), at});
  json.end_array();
}

}  // namespace fitgauge::api
