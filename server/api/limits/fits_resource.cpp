#include "api/limits/limits_codec.hpp"
#include "api/measurements/measurements.hpp"
#include "api/resources.hpp"
#include "api/statistics/value_selection.hpp"
#include "api/wire/formulas.hpp"
#include "metrology/statistics/fit_analysis.hpp"
#include "service/jobs.hpp"

namespace fitgauge::api {
namespace {

constexpr std::string_view kHole = "hole";
constexpr std::string_view kShaft = "shaft";

/// The values of one side of a fit, with their figures.
struct MeasuredSide {
  SelectedValues selected{};
  metrology::Capability capability{};

  metrology::MeasuredSizes sizes() const { return {capability.mean, capability.overall}; }
};

void members(auto& v, const MeasuredSide& side) {
  v.member("selection", side.selected, "Measurements of the figure");
  v.member("mean", side.capability.mean, Finite{}, "Value in mm");
  v.member("standard_deviation_overall", side.capability.overall, Finite{}, "Value in mm");
  v.member("stable", side.capability.stable, "true if no rule is broken");
}

struct StoredClearance {
  MeasuredSide hole{};
  MeasuredSide shaft{};
  metrology::MeasuredClearance clearance{};
};
void members(auto& v, const StoredClearance& stored) {
  constexpr long double kMicrometres = 1000;
  const metrology::MeasuredClearance& clearance = stored.clearance;
  v.member("probability_of_interference", clearance.probability_of_interference, Finite{},
           "Independent and normal, as measured");
  v.member("mean_clearance_um", kMicrometres * clearance.mean, Finite{});
  v.member("standard_deviation_um", kMicrometres * clearance.standard_deviation, Finite{},
           "Figure of the clearance");
  v.member("stable", stored.hole.capability.stable && stored.shaft.capability.stable,
           "Both distributions are stable; if not, future parts may differ");
  v.member("hole", stored.hole);
  v.member("shaft", stored.shaft);
}

Error of_side(std::string_view side, Error error) {
  error.message = fmt::format("the stored values of the {}: {}", side, error.message);
  return error;
}

/// @errors QueryInvalid if this side has no filter
Result<app::MeasurementQuery> side_query(const Services& services, const Request& request,
                                         std::string_view side) {
  const std::string prefix = fmt::format("{}_", side);
  const bool is_selected =
      std::ranges::any_of(measurement_filter_parameters(prefix),
                          [&](const Parameter& filter) { return request.has(filter.name); });
  if (!is_selected) {
    const std::string wanted = prefix + "characteristic";
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("a clearance needs stored holes and shafts: select the {0}s too, for "
                             "example by {0}_characteristic or {0}_designation",
                             side),
                 wanted};
  }
  return measurement_query(services, request, prefix);
}

Result<MeasuredSide> read_side(const Services& services, const app::MeasurementQuery& query,
                               const iso286::LimitsOfSize& limits, bool ignores_subgroups) {
  ValueSelection selection;
  TRY(selection.read(services.measurements, query));
  auto selected = TRY(std::move(selection).selected(ignores_subgroups));
  if (selected.lower_limit != limits.lower_limit() ||
      selected.upper_limit != limits.upper_limit()) {
    const auto mm = [](const std::optional<Length>& limit) {
      return limit ? format_mm(*limit) : std::string("none");
    };
    return Error::of(ErrorCode::LimitsMixed,
                     "they have the limits {} and {} mm, the fit has {} and {} mm",
                     mm(selected.lower_limit), mm(selected.upper_limit),
                     format_mm(limits.lower_limit()), format_mm(limits.upper_limit()));
  }
  constexpr long double kConfidence = 0.95L;
  auto capability = TRY(metrology::assess_capability(selected.data, selected.limits, kConfidence));
  selected.data = {};
  return MeasuredSide{std::move(selected), std::move(capability)};
}

/// Filters of the stored values of a fit: the filters of a list twice, `hole_…` and `shaft_…`.
std::vector<Parameter> fit_filter_parameters() {
  std::vector<Parameter> parameters;
  for (const std::string_view side : {kHole, kShaft}) {
    auto filters = measurement_filter_parameters(fmt::format("{}_", side));
    for (Parameter& filter : filters) {
      filter.description = fmt::format("Stored {}s: {}", side, filter.description);
      parameters.push_back(std::move(filter));
    }
  }
  parameters.push_back(subgroups_parameter());
  return parameters;
}

/// Writes the member `stored` of a fit.
using WriteStored = std::function<void(JsonWriter&)>;

/// Reads the values that the filters of a request select, for the probability of interference from
/// their location and spread.
/// @param done receives the writer of the result; QueryInvalid if holes or shafts are not selected;
/// LimitsMixed if their limits are not the fit's; errors of a capability by side
void read_fit_of_values(const Services& services, const Request& request, const iso286::Fit& fit,
                        std::function<void(Result<WriteStored>)> done) {
  auto holes = side_query(services, request, kHole);
  if (!holes) return done(holes.error());
  auto shafts = side_query(services, request, kShaft);
  if (!shafts) return done(shafts.error());
  services.jobs.figures.run(
      [&services, fit, holes = *std::move(holes), shafts = *std::move(shafts),
       ignores = ignores_subgroups(request)]() -> Result<WriteStored> {
        auto hole = read_side(services, holes, fit.hole, ignores);
        if (!hole) return of_side(kHole, hole.error());
        auto shaft = read_side(services, shafts, fit.shaft, ignores);
        if (!shaft) return of_side(kShaft, shaft.error());
        const auto clearance = metrology::clearance_of(hole->sizes(), shaft->sizes());
        return WriteStored(
            [stored = StoredClearance{*std::move(hole), *std::move(shaft), clearance}](
                JsonWriter& json) { write_body(json.key("stored"), stored); });
      },
      done);
}

using iso286::ToleranceTables;

/// Probability of interference of sizes in the middle of their tolerances, in addition to the worst
/// case.
/// @param stored writes the same for stored values; none: not requested
void write_statistical(JsonWriter& json, const iso286::Fit& fit, const WriteStored& stored) {
  const metrology::FitProbabilities found = metrology::probability_of_interference(fit);
  json.key("statistical").begin_object();
  json.key("normal").begin_object();
  json.member("probability_of_interference", found.normal).end_object();
  json.key("uniform").begin_object();
  json.member("probability_of_interference", found.uniform).end_object();
  if (stored) stored(json);
  json.end_object();
}

void write_side(JsonWriter& json, std::string_view name, const iso286::LimitsOfSize& limits,
                std::string_view class_name, const ToleranceTables& tables) {
  if (!standards::is_bearing_class(class_name))
    return write_body(json.key(name), limits_answer(limits, tables));
  const Length nominal = limits.nominal_size.length();
  write_body(json.key(name),
             limits_answer(standards::bearing_limits(nominal, class_name, limits.feature).value()));
}

void write_fit_members(JsonWriter& json, const iso286::Fit& fit,
                       const iso286::FitDesignation& designation, const ToleranceTables& tables,
                       const WriteStored& stored = {}) {
  const auto& [size, hole_class, shaft_class, has_envelope] = designation;
  json.member("designation", designation_text(size.length(), hole_class) + "/" + shaft_class);
  write_side(json, "hole", fit.hole, hole_class, tables);
  write_side(json, "shaft", fit.shaft, shaft_class, tables);
  json.member("type", word(fit.kind()))
      .member_um("max_clearance_um", fit.max_clearance())
      .member_um("min_clearance_um", fit.min_clearance())
      .member("assumes_envelope", !has_envelope);
  write_formula(json, "fit");
  write_statistical(json, fit, stored);
}

/// The limits of a class of the tables, or of a bearing.
Result<iso286::LimitsOfSize> find_side(iso286::NominalSize size, std::string_view class_name,
                                       iso286::Feature feature, const ToleranceTables& tables) {
  if (!standards::is_bearing_class(class_name)) return tables.limits_of_size(size, class_name);
  const auto limits = TRY(standards::bearing_limits(size.length(), class_name, feature));
  return iso286::LimitsOfSize{size, {}, feature, {}, limits.deviations, *limits.size_range};
}

Result<iso286::Fit> find_fit(const iso286::FitDesignation& designation,
                             const ToleranceTables& tables) {
  const auto& [size, hole_class, shaft_class, has_envelope] = designation;
  const auto hole = TRY(find_side(size, hole_class, iso286::Feature::Hole, tables));
  const auto shaft = TRY(find_side(size, shaft_class, iso286::Feature::Shaft, tables));
  return iso286::Fit{hole, shaft};
}

/// Reads `25 H7/g6`; of a bearing `25 ISO 492-P6/k6` (bore) or `52 H7/ISO 492-P6` (outer ring).
Result<iso286::FitDesignation> read_fit(std::string_view hole, std::string_view shaft) {
  hole = trim(hole);
  shaft = trim(shaft);
  const std::size_t at = standards::find_bearing_class(hole);
  const bool is_bore = at != std::string_view::npos;
  const bool is_ring = standards::is_bearing_class(shaft);
  // The bearing's side is read with a class of ISO 286 in its place.
  auto fit = iso286::parse_fit_designation(
      is_bore ? std::string(hole.substr(0, at)) + "H7" : std::string(hole), is_ring ? "h6" : shaft);
  if ((is_bore && is_ring) ||
      (!fit && (is_bore || is_ring) && fit.error().code == ErrorCode::FitMalformed)) {
    return Error::of(ErrorCode::FitMalformed,
                     "unknown fit of a bearing '{}/{}': write 25 ISO 492-P6/k6 (shaft) or "
                     "52 H7/ISO 492-P6 (housing)",
                     first_characters(hole, 40), first_characters(shaft, 40));
  }
  if (!fit && is_bore && fit.error().code == ErrorCode::DesignationMalformed) {
    return Error::of(ErrorCode::DesignationMalformed,
                     "'{}' is not a bore of a bearing such as 25 ISO 492-P6",
                     first_characters(hole, 40));
  }
  if (fit && is_bore) fit->hole_class = standards::bearing_class(hole.substr(at));
  if (fit && is_ring) fit->shaft_class = standards::bearing_class(shaft);
  return fit;
}

std::string fit_json(const iso286::FitDesignation& designation, const iso286::Fit& fit,
                     const ToleranceTables& tables, const WriteStored& stored = {}) {
  return json_object(
      [&](JsonWriter& json) { write_fit_members(json, fit, designation, tables, stored); });
}

Result<iso286::FitDesignation> of_two_segments(const Request& request) {
  return read_fit(*request.text("hole"), *request.text("shaft"));
}

Result<iso286::FitDesignation> of_one_segment(const Request& request) {
  const std::string_view text = *request.text("fit");
  const std::size_t stroke = text.find('/');
  if (stroke == std::string_view::npos) return iso286::parse_fit_designation(text);
  return read_fit(text.substr(0, stroke), text.substr(stroke + 1));
}

/// The fit of a designation: from the tables and cached, or with the stored values of a query.
template <class Designation>
http::EitherHandler answer_fit(const Routes& add, Designation designation_of) {
  auto from_tables = ResponseCache::of_revision(
      add.cache,
      [designation_of](const Request& request, const ToleranceTables& tables) -> Result<Response> {
        const auto designation = TRY(designation_of(request));
        const auto fit = TRY(find_fit(designation, tables));
        return tagged_json(fit_json(designation, fit, tables), etag_of(tables));
      });
  const auto has_query = [](const Request& request) { return !request.query().empty(); };
  return {has_query, std::move(from_tables.now),
          [&services = add.services, designation_of, from_revision = from_tables.later](
              const Request& request, Responder responder) {
            if (asks_for_revision_alone(request))
              return from_revision(request, std::move(responder));
            const auto shared = share(std::move(responder));
            tables_of(
                services.tables, request,
                [&services, &request, designation_of,
                 shared](const Result<app::TableCatalog::Tables>& tables) {
                  if (!tables) return shared->fail(tables.error());
                  const auto designation = TRY_OR_FAIL(*shared, designation_of(request));
                  const auto fit = TRY_OR_FAIL(*shared, find_fit(designation, **tables));
                  read_fit_of_values(
                      services, request, fit,
                      [shared, tables = *tables, designation, fit](Result<WriteStored> stored) {
                        if (!stored) return shared->fail(stored.error());
                        shared->answer({200, "application/json",
                                        fit_json(designation, fit, *tables, *stored)});
                      });
                });
          }};
}

/// Adds the parameters that select stored values to those of a path.
std::vector<Parameter> with_filters(std::vector<Parameter> parameters) {
  return std::move(parameters) + fit_filter_parameters() + std::vector{revision_parameter()};
}

/// Writes the fit as its own path returns it, with the names of its classes.
Result<void> write_found(JsonWriter& json, const metrology::FoundFit& found,
                         iso286::NominalSize size, const ToleranceTables& tables) {
  const auto fit = TRY(tables.fit(size, found.hole, found.shaft));
  const std::string hole(tables.class_name(found.hole));
  const std::string shaft(tables.class_name(found.shaft));
  json.begin_object();
  write_fit_members(json, fit, {size, hole, shaft}, tables);
  json.member("hole_class", hole)
      .member("shaft_class", shaft)
      .member("preferred", found.preferred)
      .end_object();
  return {};
}

Result<Response> search_fits(const Request& request, const ToleranceTables& tables) {
  const auto size = TRY(iso286::NominalSize::make(*request.length("nominal_mm")));
  const metrology::ClearanceBounds bounds{.least = *request.length("min_clearance_um"),
                                          .most = *request.length("max_clearance_um")};
  if (bounds.least > bounds.most)
    return Error{ErrorCode::QueryInvalid, "min_clearance_um is above max_clearance_um"};
  constexpr std::int64_t kUsual = 100;
  const auto limit = static_cast<std::size_t>(request.integer("limit").value_or(kUsual));
  const auto found = metrology::find_fits(tables, size, bounds);
  std::string body;
  JsonWriter json(body);
  json.begin_object().key("fits").begin_array();
  for (std::size_t i = 0; i < std::min(limit, found.size()); ++i)
    TRY(write_found(json, found[i], size, tables));
  json.end_array().member("total", std::uint64_t{found.size()}).end_object();
  return tagged_json(std::move(body), etag_of(tables));
}

}  // namespace

std::string stored_clearance_schema() { return schema_of<StoredClearance>(Side::Answer); }

void add_fits_routes(Routes& add) {
  add("GET /v1/fits/{hole}/{shaft} getFit open 404 422", answer_fit(add, of_two_segments),
      {.summary = "Fit of a hole and a shaft",
       .description =
           "Limits of both and the clearances; interference is negative clearance. Filters "
           "for holes and for shafts add `statistical.stored`, from what was measured; "
           "with these it is for viewers.",
       .parameters = with_filters({path_parameter("hole", "Size and class of the hole: 25H7"),
                                   path_parameter("shaft", "Class of the shaft: g6")}),
       .query_access = "viewer",
       .outcomes = {{.meaning = "The fit", .schema = "Fit"}}});
  add("GET /v1/fits/{fit} getFitAsOne open 404 422", answer_fit(add, of_one_segment),
      {.summary = "Fit of a hole and a shaft, written as one",
       .description = "One path segment, with an encoded slash: 25H7%2Fg6.",
       .parameters = with_filters({path_parameter("fit", "25H7/g6, the stroke percent-encoded")}),
       .query_access = "viewer",
       .outcomes = {{.meaning = "The fit", .schema = "Fit"}}});
  add("GET /v1/fits findFits open 422", ResponseCache::of_revision(add.cache, search_fits),
      {.summary = "Fits whose clearances lie within bounds",
       .description = "The preferred fits of ISO 286-1 first, then the widest tolerances.",
       .parameters = {{.name = "nominal_mm",
                       .type = http::LengthIn{.too_long = ErrorCode::SizeOutOfRange},
                       .required = true,
                       .description = "Nominal size, 0 < D <= 3150"},
                      {.name = "min_clearance_um",
                       .type = http::LengthIn{.unit = http::LengthUnit::Micrometre},
                       .required = true,
                       .description = "Least clearance allowed; interference is negative"},
                      {.name = "max_clearance_um",
                       .type = http::LengthIn{.unit = http::LengthUnit::Micrometre},
                       .required = true,
                       .description = "Greatest clearance allowed"},
                      query("limit", http::Integer{.min = 1, .max = 1000},
                            "Maximum number of fits, 1 to 1000 (default: 100)"),
                      revision_parameter()},
       .outcomes = {{.meaning = "The fits found", .schema = "FoundFits"}}});
}

}  // namespace fitgauge::api
