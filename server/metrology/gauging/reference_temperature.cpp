#include "metrology/gauging/reference_temperature.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "metrology/gauging/decimal_digits.hpp"

namespace fitgauge::gauging {
namespace {

__extension__ using Wide = __int128;

constexpr std::int64_t kReference = 20'000'000;

constexpr std::array kMaterials = {
    // ±1.0, rectangular.
    Material{"steel", 11'500'000, "ISO 3650:1998, 6.2.2: gauge blocks of steel", 577'350},
    Material{"stainless_steel", 16'000'000, "EN 10088-1:2014, 1.4301, 20 to 100 °C"},
    Material{"aluminium", 23'000'000, "EN 1999-1-1:2007"},
    Material{"steel_scale", 10'000'000, "HEIDENHAIN, steel scale tapes (METALLUR, AURODUR)"},
    Material{"glass_scale", 8'000'000, "HEIDENHAIN, glass scales (DIADUR)"},
};

/// 1 + α(t - 20), times 10^18.
Wide stretch(const ThermalBody& body) {
  constexpr Wide kOne = 1'000'000'000'000'000'000;
  return kOne + Wide{body.expansion} * (body.temperature - kReference);
}

}  // namespace

Length size_at_20_degrees(Length reading, const ThermalBody& part, const ThermalBody& scale) {
  // At most 10^14 nm times 1.1 * 10^19: far from the end of 128 bits.
  const Wide stretched = Wide{reading.count()} * stretch(scale);
  const Wide by = stretch(part);
  const Wide half = stretched < 0 ? -by / 2 : by / 2;
  return Length::nanometres(static_cast<std::int64_t>((stretched + half) / by));
}

std::int64_t added_uncertainty(Length corrected, const ThermalBody& part,
                               const ThermalBody& scale) {
  constexpr double kMillionth = 1e-6;
  constexpr double kPicometres = 1e3;  // in a nanometre
  const auto relative = [](const ThermalBody& body) {
    const double above = static_cast<double>(body.temperature - kReference) * kMillionth;
    const double expansion = static_cast<double>(body.expansion) * kMillionth * kMillionth;
    const double by_temperature =
        expansion * static_cast<double>(body.temperature_uncertainty) * kMillionth;
    const double by_expansion =
        above * static_cast<double>(body.expansion_uncertainty) * kMillionth * kMillionth;
    return std::hypot(by_temperature, by_expansion) / (1 + expansion * above);
  };
  const double size = static_cast<double>(corrected.count()) * kPicometres;
  return to_15_digits(std::abs(size) * std::hypot(relative(part), relative(scale)));
}

Length combined_uncertainty(Length u, std::int64_t added_pm) {
  constexpr std::int64_t kPicometres = 1000;
  if (added_pm == 0 || u > kLongest) return u;
  const Wide given = Wide{u.count()} * kPicometres;
  const Wide added = std::clamp<std::int64_t>(added_pm, 0, kLongest.count() * kPicometres);
  const Wide square = given * given + added * added;
  const auto reaches = [square](Wide nanometres) {
    return nanometres * kPicometres * nanometres * kPicometres >= square;
  };
  auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(square)) / kPicometres);
  while (!reaches(root)) ++root;
  while (reaches(root - 1)) --root;
  return Length::nanometres(root);
}

std::span<const Material> materials() { return kMaterials; }

const Material* find_material(std::string_view name) {
  const auto found = std::find_if(kMaterials.begin(), kMaterials.end(),
                                  [&](const Material& m) { return m.name == name; });
  return found == kMaterials.end() ? nullptr : &*found;
}

}  // namespace fitgauge::gauging
