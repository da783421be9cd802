#include "api/limits/thermal_codec.hpp"

#include <fmt/format.h>

namespace fitgauge::api {
namespace {

/// The coefficient of a body, which is given by its number or by its material.
Result<std::optional<std::int64_t>> expansion(std::string_view body,
                                              const std::optional<std::int64_t>& number,
                                              const std::optional<std::string_view>& material) {
  if (!material) return number;
  const std::string field = fmt::format("{}_material", body);
  if (number) {
    return Error{ErrorCode::FieldConflict,
                 fmt::format("give {}_expansion_um_per_m_k or {}, not both", body, field), field};
  }
  if (const auto found = gauging::expansion_of(*material)) return std::optional(*found);
  std::string names;
  for (const gauging::Material& known : gauging::materials()) {
    names += names.empty() ? "" : ", ";
    names += known.name;
  }
  return Error{
      ErrorCode::FieldInvalid,
      fmt::format("{} is one of {}; for another give {}_expansion_um_per_m_k", field, names, body),
      field};
}

}  // namespace

Result<std::optional<ThermalCorrection>> make_correction(const ThermalWords& words) {
  const auto part = expansion("part", words.part_expansion, words.part_material);
  if (!part) return part.error();
  const auto scale = expansion("scale", words.scale_expansion, words.scale_material);
  if (!scale) return scale.error();
  if (!*part && !*scale) return std::optional<ThermalCorrection>();
  if (*part && !words.temperature) {
    return Error{ErrorCode::FieldMissing,
                 "temperature_c, of the part, is required beside its expansion", "temperature_c"};
  }
  ThermalCorrection correction;
  correction.part.expansion = part->value_or(0);
  correction.part.temperature = words.temperature.value_or(correction.part.temperature);
  correction.scale.expansion = scale->value_or(0);
  correction.scale.temperature = words.scale_temperature.value_or(correction.scale.temperature);
  return std::optional(correction);
}

}  // namespace fitgauge::api
