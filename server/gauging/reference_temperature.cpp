#include "gauging/reference_temperature.hpp"

#include <algorithm>
#include <array>

namespace fitgauge::gauging {
namespace {

__extension__ using Wide = __int128;

constexpr std::int64_t kReference = 20'000'000;

constexpr std::array kMaterials = {
    Material{"steel", 11'500'000, "ISO 3650:1998: gauge blocks of steel"},
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

std::span<const Material> materials() { return kMaterials; }

std::optional<std::int64_t> expansion_of(std::string_view material) {
  const auto found = std::find_if(kMaterials.begin(), kMaterials.end(),
                                  [&](const Material& m) { return m.name == material; });
  return found == kMaterials.end() ? std::nullopt : std::optional(found->expansion);
}

}  // namespace fitgauge::gauging
