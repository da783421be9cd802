#include "record/thermal_codec.hpp"

#include <fmt/format.h>

namespace fitgauge::api {
namespace {

/// What is said of a body beside its temperature.
struct BodyWords {
  std::string_view name;  ///< part or scale
  const std::optional<std::int64_t>& expansion;
  const std::optional<std::string_view>& material;
  const std::optional<std::int64_t>& temperature_uncertainty;
  const std::optional<std::int64_t>& expansion_uncertainty;
};

/// The coefficient of a body, which is given by its number or by its material, with the
/// uncertainties; none where it does not expand. A material has that of its source.
Result<std::optional<gauging::ThermalBody>> read_body(const BodyWords& words) {
  const bool expands = words.expansion || words.material;
  if (!expands && !words.temperature_uncertainty && !words.expansion_uncertainty) {
    return std::optional<gauging::ThermalBody>();
  }
  const std::string field = fmt::format("{}_material", words.name);
  const std::string number = fmt::format("{}_expansion_um_per_m_k", words.name);
  if (words.expansion && words.material) {
    return Error{ErrorCode::FieldConflict, fmt::format("give {} or {}, not both", number, field),
                 field};
  }
  if (!expands) {
    return Error{ErrorCode::FieldMissing,
                 fmt::format("an uncertainty of the {} is of its correction to 20 degrees, which "
                             "needs {} or {}",
                             words.name, number, field),
                 number};
  }
  gauging::ThermalBody body;
  if (words.material) {
    const gauging::Material* material = gauging::find_material(*words.material);
    if (material == nullptr) {
      std::string names;
      for (const gauging::Material& known : gauging::materials()) {
        names += names.empty() ? "" : ", ";
        names += known.name;
      }
      return Error{ErrorCode::FieldInvalid,
                   fmt::format("{} is one of {}; for another give {}", field, names, number),
                   field};
    }
    body.expansion = material->expansion;
    body.expansion_uncertainty = material->uncertainty;
  }
  body.expansion = words.expansion.value_or(body.expansion);
  body.temperature_uncertainty = words.temperature_uncertainty.value_or(0);
  body.expansion_uncertainty = words.expansion_uncertainty.value_or(body.expansion_uncertainty);
  return std::optional(body);
}

}  // namespace

Result<std::optional<ThermalCorrection>> make_correction(const app::MeasurementFields& fields) {
  auto part = read_body({.name = "part",
                         .expansion = fields.part_expansion,
                         .material = fields.part_material,
                         .temperature_uncertainty = fields.temperature_uncertainty,
                         .expansion_uncertainty = fields.part_expansion_uncertainty});
  if (!part) return part.error();
  auto scale = read_body({.name = "scale",
                          .expansion = fields.scale_expansion,
                          .material = fields.scale_material,
                          .temperature_uncertainty = fields.scale_temperature_uncertainty,
                          .expansion_uncertainty = fields.scale_expansion_uncertainty});
  if (!scale) return scale.error();
  if (!*part && !*scale) return std::optional<ThermalCorrection>();
  if (*part && !fields.temperature) {
    return Error{ErrorCode::FieldMissing,
                 "temperature_c, of the part, is required beside its expansion", "temperature_c"};
  }
  ThermalCorrection correction;
  correction.part = part->value_or(gauging::ThermalBody());
  correction.part.temperature = fields.temperature.value_or(correction.part.temperature);
  correction.scale = scale->value_or(gauging::ThermalBody());
  correction.scale.temperature = fields.scale_temperature.value_or(correction.scale.temperature);
  correction.has_uncertainties =
      fields.temperature_uncertainty || fields.part_expansion_uncertainty ||
      fields.scale_temperature_uncertainty || fields.scale_expansion_uncertainty;
  return std::optional(correction);
}

}  // namespace fitgauge::api
