#include "api/resources.hpp"

#include "api/limits/limits_codec.hpp"
#include "record/verdict_codec.hpp"

namespace fitgauge::api {
namespace {

using VerdictRule = gauging::DecisionRule::Kind;

/// Parameters that change nothing without another one, which the reason names.
struct Unused {
  std::string_view name;
  std::string_view reason;
};
std::vector<Unused> unused_of(const Request& request, VerdictRule rule) {
  std::vector<Unused> unused;
  const auto without = [&](bool is_there, std::string_view reason,
                           std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
      if (!is_there && request.has(name)) unused.push_back({name, reason});
    }
  };
  const bool of_iso286 = !standards::is_designation(*request.text("designation"));
  const bool part_expands =
      request.has("part_material") || request.has("part_expansion_um_per_m_k");
  const bool scale_expands =
      request.has("scale_material") || request.has("scale_expansion_um_per_m_k");
  without(part_expands, "without part_material or part_expansion_um_per_m_k",
          {"temperature_c", "temperature_uncertainty_c", "part_expansion_uncertainty_um_per_m_k"});
  without(scale_expands, "without scale_material or scale_expansion_um_per_m_k",
          {"scale_temperature_c", "scale_temperature_uncertainty_c",
           "scale_expansion_uncertainty_um_per_m_k"});
  without(rule == VerdictRule::GuardBand, "without rule=guard_band", {"coverage_factor"});
  without(rule == VerdictRule::Conformance, "without rule=conformance", {"probability"});
  without(request.has("uncertainty_um"), "without uncertainty_um", {"degrees_of_freedom"});
  without(of_iso286, "here: it belongs to the tables of ISO 286", {"revision"});
  without(!of_iso286, "here: the class of ISO 286 gives it", {"feature"});
  return unused;
}

bool has(const std::vector<Unused>& unused, std::string_view name) {
  return std::ranges::any_of(unused, [&](auto& each) { return each.name == name; });
}

/// @errors QueryInvalid
Result<std::optional<ThermalCorrection>> correction_of(const Request& request,
                                                       const std::vector<Unused>& unused) {
  app::MeasurementFields fields;
  for (const app::MeasurementField& field : app::kThermalFields) {
    if (has(unused, field.name)) continue;
    if (field.text != nullptr) {
      fields.*field.text = request.text(field.name);
    } else {
      fields.*field.number = request.integer(field.name);
    }
  }
  auto made = make_correction(fields);
  if (!made) return Error{ErrorCode::QueryInvalid, made.error().message, made.error().where};
  return made;
}

/// The limits of a designation of any standard.
struct Limits {
  LimitsAnswer answer{};
  gauging::Limits of;
  std::string etag;
  gauging::Quantity quantity = gauging::Quantity::Diameter;
  bool has_envelope = false;
};

Result<Limits> limits_of(const Request& request, const iso286::ToleranceTables& tables) {
  const std::string_view text = *request.text("designation");
  if (standards::is_designation(text)) {
    auto limits = TRY(standards::limits_of(text));
    if (const auto feature = request.text("feature"); feature && limits.feature_is_open)
      limits.feature = *iso286::feature_from_word(*feature);
    const gauging::Quantity quantity = app::quantity_of(limits);
    const bool is_distance = quantity == gauging::Quantity::Distance;
    return Limits{.answer = limits_answer(limits),
                  .of = {limits.upper_limit(), limits.lower_limit()},
                  .etag = etag_of(*limits.standard),
                  .quantity = is_distance && request.text("feature") ? gauging::Quantity::Diameter
                                                                     : quantity};
  }
  const auto designation = TRY(iso286::parse_designation(text));
  const auto limits = TRY(tables.limits_of_size(designation.nominal_size, designation.class_name));
  return Limits{.answer = limits_answer(limits, tables),
                .of = {limits.upper_limit(), limits.lower_limit()},
                .etag = etag_of(tables),
                .has_envelope = designation.has_envelope};
}

Result<Response> verdict(const Request& request, const iso286::ToleranceTables& tables) {
  const auto limits = TRY(limits_of(request, tables));
  if (const auto feature = request.text("feature");
      feature && *feature != word(limits.answer.feature)) {
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("{} belongs to a {}: remove feature", *request.text("designation"),
                             word(limits.answer.feature)),
                 "feature"};
  }
  MeasuredSize measured{.reading = *request.length("measured_mm")};
  TRY(check_measured(measured.reading));
  const auto kind = *gauging::rule_from_word(request.text("rule").value_or("simple"));
  const std::vector<Unused> unused = unused_of(request, kind);
  const auto correction = TRY(correction_of(request, unused));
  if (correction) {
    measured.corrected = (*correction)(measured.reading);
    measured.added_uncertainty = correction->added_uncertainty(*measured.corrected);
  }
  const std::optional<Length> given = request.length("uncertainty_um");
  if (given) TRY(check_uncertainty(*given));
  if (given && kind == VerdictRule::Simple) {
    return Error{ErrorCode::QueryUnused,
                 "rule simple does not use uncertainty_um: give rule=guard_band or "
                 "rule=conformance, or remove it",
                 "uncertainty_um"};
  }
  const auto used = [&](std::string_view name) {
    return has(unused, name) ? std::nullopt : request.integer(name);
  };
  const RuleWords words{.kind = kind,
                        .standard_uncertainty = given,
                        .coverage_millionths = used("coverage_factor"),
                        .probability_millionths = used("probability"),
                        .degrees_of_freedom = request.integer("degrees_of_freedom"),
                        .added_uncertainty = measured.added_uncertainty};
  const auto rule = TRY(make_rule(words));
  TRY(check_acceptance(rule, limits.of));

  const bool is_inside = request.text("inside_corner") == "true";
  if (is_inside && limits.quantity != gauging::Quantity::Radius &&
      limits.quantity != gauging::Quantity::Chamfer) {
    return Error{ErrorCode::QueryInvalid, "inside_corner is for radii and chamfers only",
                 "inside_corner"};
  }
  const auto result = gauging::gauge({limits.quantity, limits.answer.feature, is_inside},
                                     limits.of.upper, limits.of.lower, measured.decisive(), rule);
  std::vector<Warning> warnings;
  for (const auto& [name, reason] : unused)
    warnings.push_back({"query.unused", fmt::format("{} changes nothing {}", name, reason)});
  warn_of_no_acceptance(rule, limits.of.upper - limits.of.lower, warnings);
  return tagged_json(
      json_object([&](JsonWriter& json) {
        BodyWriter write(json);
        members(write, limits.answer);
        write_verdict_members(json, limits.answer.nominal, measured, result);
        write_rule_members(json, rule, words, limits.of, measured.decisive());
        if (limits.has_envelope)
          json.member("envelope", app::kEnvelopeRequired).member("envelope_result", "not_verified");
        write_warnings(json, warnings);
      }),
      limits.etag);
}

Parameter parameter_of(const app::MeasurementField& field) {
  Parameter parameter = query(std::string(field.name), std::string(field.meaning));
  if (field.number != nullptr) {
    parameter.type = http::Decimal{
        .scale = field.scale, .min = field.accepted.least, .max = field.accepted.most};
    return parameter;
  }
  http::Words words;
  for (const gauging::Material& known : gauging::materials()) words.words.emplace_back(known.name);
  parameter.type = std::move(words);
  return parameter;
}

}  // namespace

void add_verdicts_routes(Routes& add) {
  add("GET /v1/verdicts/{designation} getVerdict open 404 422",
      of_revision(
          add.services.tables,
          [&tables = add.services.tables](const Request& request) -> Result<Response> {
            return verdict(request, *TRY(tables.tables()));
          },
          verdict),
      {.summary = "Verdict on a measured value",
       .description =
           "good, rework (hole too small, shaft too large) or reject (hole too large, shaft too "
           "small); limits are inclusive. Nothing is stored.",
       .parameters =
           {path_parameter("designation", "25H7, M10-6H, 25 ISO 2768-m"),
            query("feature", http::Words{{"hole", "shaft"}},
                  "Feature of a general tolerance (default: a distance, with "
                  "rejects on both sides)"),
            query("inside_corner", http::Words{{"true", "false"}},
                  "true: the radius or chamfer is that of an inside corner"),
            {.name = "measured_mm",
             .type = http::LengthIn{.round_to_nearest = true},
             .required = true,
             .description = "Measured value, 0 < m <= 100000000; rounded to 1 nm"},
            query("rule", http::Words{{"simple", "guard_band", "conformance"}},
                  "Decision rule (ISO 14253-1) (default: simple)"),
            query("uncertainty_um", http::LengthIn{.unit = http::LengthUnit::Micrometre},
                  "u; required by guard_band and conformance"),
            query("coverage_factor", http::Decimal{.scale = 6, .min = 1, .max = 100'000'000},
                  "k of guard_band (default: t(0.9545, degrees_of_freedom), 2 without them)"),
            query("degrees_of_freedom",
                  http::Decimal{.scale = 6,
                                .min = app::kDegreesOfFreedom.least,
                                .max = app::kDegreesOfFreedom.most},
                  "Degrees of freedom of uncertainty_um (default: infinite)"),
            query("probability", http::Decimal{.scale = 6, .min = 500'000, .max = 999'999},
                  "Probability of conformance, at least 0.5 (default: 0.95)"),
            revision_parameter()},
       .outcomes = {{.meaning = "The verdict", .schema = "Verdict"}}});
  for (const app::MeasurementField& field : app::kThermalFields)
    add.all.back().parameters.push_back(parameter_of(field));
}

}  // namespace fitgauge::api
