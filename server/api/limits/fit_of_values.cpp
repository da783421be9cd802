#include "api/limits/fit_of_values.hpp"

#include "api/measurements/measurement_listing.hpp"
#include "api/statistics/value_selection.hpp"
#include "metrology/statistics/fit_analysis.hpp"
#include "service/jobs.hpp"

namespace fitgauge::api {
namespace {

constexpr std::string_view kHole = "hole";
constexpr std::string_view kShaft = "shaft";

/// The values of one side of a fit, with their figures.
struct MeasuredSide {
  SelectedValues selected{};
  std::string as_of{};
  metrology::Capability capability{};

  metrology::MeasuredSizes sizes() const { return {capability.mean, capability.overall}; }
};

void members(auto& v, const MeasuredSide& side) {
  v.member("selection", selection_of(side.selected, side.as_of), "Measurements of the figure");
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
Result<app::MeasurementQuery> side_query(const Services& services, const http::Request& request,
                                         std::string_view side) {
  const std::string prefix = fmt::format("{}_", side);
  const std::string_view query = request.query();
  if (!query.starts_with(prefix) && query.find('&' + prefix) == std::string_view::npos) {
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
  auto as_of = TRY(selection.read(services.measurements, query));
  auto selected = TRY(std::move(selection).selected(ignores_subgroups));
  if (selected.lower_limit != limits.lower_limit() ||
      selected.upper_limit != limits.upper_limit()) {
    const auto mm = [](const std::optional<Length>& limit) {
      return limit ? format_mm(*limit) : std::string("none");
    };
    return Error{ErrorCode::LimitsMixed,
                 fmt::format("they have the limits {} and {} mm, the fit has {} and {} mm",
                             mm(selected.lower_limit), mm(selected.upper_limit),
                             format_mm(limits.lower_limit()), format_mm(limits.upper_limit()))};
  }
  constexpr long double kConfidence = 0.95L;
  auto capability = TRY(metrology::assess_capability(selected.data, selected.limits, kConfidence));
  selected.data = {};
  return MeasuredSide{std::move(selected), std::move(as_of), std::move(capability)};
}

}  // namespace

std::string stored_clearance_schema() { return schema_of<StoredClearance>(Side::Answer); }

std::vector<http::Parameter> fit_filter_parameters() {
  std::vector<http::Parameter> parameters;
  for (const std::string_view side : {kHole, kShaft}) {
    auto filters = measurement_filter_parameters(fmt::format("{}_", side));
    for (http::Parameter& filter : filters) {
      filter.description = fmt::format("Stored {}s: {}", side, filter.description);
      parameters.push_back(std::move(filter));
    }
  }
  parameters.push_back(subgroups_parameter());
  return parameters;
}

void read_fit_of_values(const Services& services, const http::Request& request,
                        const iso286::Fit& fit, std::function<void(Result<WriteStored>)> done) {
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

}  // namespace fitgauge::api
