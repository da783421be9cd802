#include "api/limits/limits_codec.hpp"
#include "api/statistics/computation.hpp"
#include "api/wire/formulas.hpp"
#include "metrology/statistics/fit_analysis.hpp"
#include "metrology/statistics/limit_gauge.hpp"

namespace fitgauge::api {
namespace {

using iso286::ToleranceTables;

Result<Response> limits_response(iso286::NominalSize size, std::string_view class_name,
                                 const ToleranceTables& tables) {
  const auto limits = TRY(tables.limits_of_size(size, class_name));
  return tagged_json(body_json(limits_answer(limits, tables)), etag_of(tables));
}

Result<Response> limits_response(const Result<standards::DesignatedLimits>& limits) {
  if (!limits) return limits.error();
  return tagged_json(body_json(limits_answer(*limits)), etag_of(*limits->standard));
}

Result<Response> limits_of_designation(const Request& request, const ToleranceTables& tables) {
  const std::string_view text = *request.text("designation");
  if (standards::is_designation(text)) return limits_response(standards::limits_of(text));
  const auto designation = TRY(iso286::parse_designation(*request.text("designation")));
  return limits_response(designation.nominal_size, designation.class_name, tables);
}

Result<Response> limits_of_query(const Request& request, const ToleranceTables& tables) {
  if (const auto name = *request.text("tolerance_class"); standards::is_class(name))
    return limits_response(standards::limits_of(*request.length("nominal_mm"), name));
  const auto size = TRY(iso286::NominalSize::make(*request.length("nominal_mm")));
  return limits_response(size, *request.text("tolerance_class"), tables);
}

struct NewSizes {
  Length upper{};
  Length lower{};
};
void members(auto& v, const NewSizes& sizes) {
  v.member("upper_mm", sizes.upper, Millimetres{}, "Limit of a new gauge");
  v.member("lower_mm", sizes.lower, Millimetres{}, "Limit of a new gauge");
}

struct GoGauge {
  NewSizes sizes{};
  Length wear_limit{};
};
void members(auto& v, const GoGauge& gauge) {
  members(v, gauge.sizes);
  v.member("wear_limit_mm", gauge.wear_limit, Millimetres{}, "Limit of a worn gauge");
}

struct LimitGaugeAnswer {
  std::string designation{};
  iso286::Feature feature{};
  Length upper_limit{};
  Length lower_limit{};
  GoGauge go{};
  NewSizes no_go{};
};
void members(auto& v, const LimitGaugeAnswer& answer) {
  constexpr std::string_view kNote =
      "the tables of the later editions, ISO 1938-1:2015 and 2026, are not public";
  constexpr OneOf<2> kKinds{"plug", "ring or snap"};
  v.member("designation", answer.designation);
  formula_members(v, kKinds.of(answer.feature));
  v.member("scheme", metrology::kLimitGaugeScheme, "The standard of the values");
  v.member("note", kNote, "Note on other editions");
  v.member("kind", answer.feature, kKinds);
  v.member("upper_limit_mm", answer.upper_limit, Millimetres{}, "Limit of the workpiece");
  v.member("lower_limit_mm", answer.lower_limit, Millimetres{}, "Limit of the workpiece");
  v.member("go", answer.go);
  v.member("no_go", answer.no_go);
}

Result<Response> gauge(const Request& request, const iso286::ToleranceTables& tables) {
  const auto designation = TRY(iso286::parse_designation(*request.text("designation")));
  const auto limits = TRY(tables.limits_of_size(designation.nominal_size, designation.class_name));
  const auto made = TRY(metrology::limit_gauge(limits, designation.class_name));
  const LimitGaugeAnswer answer{
      .designation = designation_text(designation.nominal_size.length(), designation.class_name),
      .feature = limits.feature,
      .upper_limit = limits.upper_limit(),
      .lower_limit = limits.lower_limit(),
      .go = {{made.go.upper, made.go.lower}, made.go_wear_limit},
      .no_go = {made.no_go.upper, made.no_go.lower}};
  return tagged_json(body_json(answer), etag_of(tables));
}

// The forms of sizes, moduli and roughness.
constexpr double kLargest = 1e9;
constexpr Number kAboveZero{0, kLargest, Number::Ends::OpenBelow,
                            "must be above 0 and at most 1e9"};
constexpr Number kFromZero{0, kLargest, Number::Ends::Closed, "must be 0 to 1e9"};

void material_members(auto& v, metrology::PressedPart& part) {
  v.optional("youngs_modulus_mpa", part.youngs_modulus_mpa, kAboveZero);
  v.optional("poisson_ratio", part.poisson_ratio, Number{0, 0.5});
  v.optional("rz_um", part.rz_um, kFromZero, "Roughness, pressed flat in part");
}

struct HubOrder {
  metrology::PressedPart part{};
};
void members(auto& v, HubOrder& hub) {
  v.member("outer_diameter_mm", hub.part.other_diameter_mm, kAboveZero);
  material_members(v, hub.part);
}

struct ShaftOrder {
  metrology::PressedPart part{};
};
void members(auto& v, ShaftOrder& shaft) {
  v.optional("inner_diameter_mm", shaft.part.other_diameter_mm, kFromZero, "0: solid");
  material_members(v, shaft.part);
}

struct PressFitOrder {
  metrology::PressFit fit{};
  HubOrder hub{};
  ShaftOrder shaft{};
  double least = 0;
  double most = 0;
};
void members(auto& v, PressFitOrder& order) {
  v.member("joint_diameter_mm", order.fit.joint_diameter_mm, kAboveZero);
  v.member("length_mm", order.fit.length_mm, kAboveZero);
  v.optional("friction", order.fit.friction, kAboveZero, "Friction coefficient along the joint");
  v.member("hub", order.hub);
  v.member("shaft", order.shaft);
  v.optional("min_interference_um", order.least, kFromZero);
  v.member("max_interference_um", order.most, kFromZero);
  v.check([&order](FieldReader& fields) {
    if (order.least <= order.most) return;
    fields.report(ErrorCode::FieldInvalid, "min_interference_um",
                  "min_interference_um is above max_interference_um");
  });
}

struct Pressed {
  double interference = 0;
  metrology::Pressure made{};
};
void members(auto& v, const Pressed& pressed) {
  v.member("interference_um", pressed.interference, Finite{});
  v.member("effective_interference_um", pressed.made.effective_um, Finite{},
           "Interference minus the loss by roughness");
  v.member("pressure_mpa", pressed.made.pressure_mpa, Finite{}, "Pressure in the joint");
  v.member("hub_stress_mpa", pressed.made.hub_stress_mpa, Finite{},
           "Equivalent stress in the bore (von Mises)");
  v.member("shaft_stress_mpa", pressed.made.shaft_stress_mpa, Finite{},
           "Equivalent stress in the shaft");
  v.member("axial_force_n", pressed.made.axial_force_n, Finite{}, "Load at which the joint slips");
  v.member("torque_nm", pressed.made.torque_nm, Finite{}, "Load at which the joint slips");
}

struct PressFitAnswer {
  Pressed least{};
  Pressed most{};
};
void members(auto& v, const PressFitAnswer& answer) {
  v.member("method", std::string_view("Lame, DIN 7190-1:2017, elastic, plane stress"));
  formula_members(v, "press_fit");
  v.member("at_min_interference", answer.least);
  v.member("at_max_interference", answer.most);
}

Result<std::string> press_fit(const JsonValue& body) {
  auto order = TRY(read_whole<PressFitOrder>(body));
  order.fit.hub = order.hub.part;
  order.fit.shaft = order.shaft.part;
  const auto least = metrology::press(order.fit, order.least);
  const auto most = metrology::press(order.fit, order.most);
  if (!least || !most) return at_member("hub", least ? most.error() : least.error());
  return body_json(PressFitAnswer{{order.least, *least}, {order.most, *most}});
}

}  // namespace

void add_limits_routes(Routes& add) {
  add("GET /v1/limits/{designation} getLimits open 404 422",
      ResponseCache::of_revision(add.cache, limits_of_designation),
      {.summary = "Limits of size of a designation",
       .description = "Deviations and limits of a nominal size and tolerance class (ISO 286-1), of "
                      "the pitch diameter of a thread (ISO 965-1), of a general tolerance "
                      "(ISO 2768-1).",
       .parameters = {path_parameter("designation",
                                     "25H7, 25 H7, Ø25H7; M10-6H, M10x1.25-6g; 25 ISO 2768-m, "
                                     "R2 ISO 2768-m; a comma may mark decimals"),
                      revision_parameter()},
       .outcomes = {{.meaning = "Limits", .schema = "Limits"}}});
  add("GET /v1/limits findLimits open 404 422",
      ResponseCache::of_revision(add.cache, limits_of_query),
      {.summary = "Limits of size of a nominal size and a tolerance class",
       .parameters = {{.name = "nominal_mm",
                       .type = http::LengthIn{.too_long = ErrorCode::SizeOutOfRange},
                       .required = true,
                       .description = "Nominal size, 0 < D <= 3150"},
                      {.name = "tolerance_class",
                       .required = true,
                       .description = "H7, g6, ISO 2768-m or a custom tolerance class"},
                      revision_parameter()},
       .outcomes = {{.meaning = "Limits", .schema = "Limits"}}});
}

void add_gauges_routes(Routes& add) {
  add("GET /v1/gauges/{designation} getLimitGauge open 404 422",
      ResponseCache::cached(add.cache, gauge),
      {.summary = "GO and NO-GO sizes of the limit gauges of a designation",
       .description = "New and worn, by ISO/R 1938:1971: holes of IT6 to IT16, shafts of IT5 to "
                      "IT16, up to 500 mm.",
       .parameters = {path_parameter("designation", "Size and class: 25H7")},
       .outcomes = {{.meaning = "The gauges", .schema = "LimitGauge"}}});
}

void add_press_fits_routes(Routes& add) {
  add_computation(add, {"/v1/press-fits computePressFit", press_fit, "PressFitOrder", "PressFit",
                        "Pressure, stress and slip of a press fit"});
}

void add_gauges_schemas(Schemas& schemas) {
  schemas.push_back(answer_schema<LimitGaugeAnswer>("LimitGauge"));
  schemas.push_back(order_schema<PressFitOrder>("PressFitOrder"));
  schemas.push_back(answer_schema<PressFitAnswer>("PressFit"));
}

}  // namespace fitgauge::api
