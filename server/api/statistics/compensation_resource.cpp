#include "api/resources.hpp"

#include <algorithm>
#include <array>

#include "api/handlers.hpp"
#include "api/measurements/measurement_listing.hpp"
#include "api/wire/formulas.hpp"
#include "metrology/statistics/compensation.hpp"

namespace fitgauge::api {
namespace {

using metrology::Compensation;
using metrology::CompensationState;

/// Values before these do not change the offset.
constexpr std::size_t kMostParts = 500;
constexpr double kNanometresOfUm = 1000;
constexpr double kMillionths = 1e6;
constexpr double kUsualCost = 0.1;

/// The newest values of one characteristic, from the newest on.
struct CorrectedParts {
  std::vector<metrology::MadePart> parts{};
  std::optional<Length> target{};
  std::optional<Length> lower{};
  std::optional<Length> upper{};
  bool is_overdue = false;  ///< the gauge of the newest value is
  std::optional<Error> error{};

  void add(const app::Measurement& value) {
    const auto low = value.has_lower_limit() ? std::optional(value.lower_limit()) : std::nullopt;
    const auto high = value.has_upper_limit() ? std::optional(value.upper_limit()) : std::nullopt;
    const bool is_first = parts.empty() && !is_overdue;
    if (is_first) {
      lower = low;
      upper = high;
      if (!target && low && high) target = Length::nanometres((low->count() + high->count()) / 2);
    } else if (low != lower || high != upper) {
      error = Error{ErrorCode::LimitsMixed,
                    "the values have different limits: select those of one characteristic"};
    }
    is_overdue = is_overdue || (is_first && value.calibration_due);
    if (value.calibration_due || !target) return;
    parts.push_back(
        {.deviation = static_cast<double>((value.decisive() - *target).count()) / kNanometresOfUm,
         .offset = static_cast<double>(value.offset.value_or(0)) / kNanometresOfUm});
  }

  /// From the target to the nearer limit, in µm.
  double half_tolerance() const {
    double least = INFINITY;
    for (const auto& limit : {lower, upper}) {
      if (!limit) continue;
      least = std::min(least, std::abs(static_cast<double>((*limit - *target).count())));
    }
    return least / kNanometresOfUm;
  }
};

struct Proposal {
  Compensation found{};
  std::size_t values = 0;
};
void members(auto& v, const Proposal& proposal) {
  constexpr double kCoverage = 1.96;
  const Compensation& c = proposal.found;
  const double reach = kCoverage * c.offset_uncertainty;
  v.member("state", c.state, Words{CompensationState::Unstable});
  v.member("reason", c.reason, "Of the state, in a sentence");
  v.member("offset_um", c.offset, "Brings the size of the next part to the target");
  v.member(
      "interval_um",
      c.offset ? std::optional(std::array{*c.offset - reach, *c.offset + reach}) : std::nullopt,
      "That it lies in with 95 %");
  v.member("values", proposal.values, "That it was found from");
  v.member("next_in_parts", c.next_in, "After so many parts measure one again");
  v.member("wear_um", c.offset ? std::optional(c.wear) : std::nullopt, "Of the size, a part");
  v.member("scatter_um", c.offset ? std::optional(c.scatter) : std::nullopt,
           "Standard deviation about the level");
  v.member("dead_band_um", c.offset ? std::optional(c.dead_band) : std::nullopt,
           "An offset within it costs more than it saves");
  formula_members(v, "compensation");
}

Result<http::Response> proposal_of(CorrectedParts& read, double cost) {
  if (read.error) return *read.error;
  if (!read.target && (read.lower || read.upper)) {
    return Error{ErrorCode::QueryInvalid, "values with one limit need a target", "target_mm"};
  }
  const double half = read.target ? read.half_tolerance() : 0;
  if (read.target && !(half > 0)) {
    return Error{ErrorCode::QueryInvalid, "the target lies on a limit", "target_mm"};
  }
  std::reverse(read.parts.begin(), read.parts.end());
  Proposal proposal{metrology::propose_offset(read.parts, half, cost), read.parts.size()};
  if (read.is_overdue) {
    proposal.found = {.reason = "the gauge of the last value is overdue for calibration"};
  }
  return json_response(body_json(proposal));
}

void propose(const Services& services, const http::Request& request, http::Responder responder) {
  auto query = measurement_query(services, request);
  if (!query) return responder.fail(query.error());
  query->newest_first = true;
  const auto given = request.integer("cost");
  const double cost = given ? static_cast<double>(*given) / kMillionths : kUsualCost;
  const auto read = std::make_shared<CorrectedParts>();
  read->target = request.length("target_mm");
  services.measurements.list(
      *query, 0, kMostParts, [read](const app::Measurement& value) { read->add(value); },
      [read, cost,
       answer = answer_by(share(std::move(responder)))](const Result<app::ListPage>& page) {
        answer(page ? proposal_of(*read, cost) : Result<http::Response>(page.error()));
      });
}

}  // namespace

void add_compensation_routes(std::vector<http::Route>& routes, const Services& services) {
  auto parameters = measurement_filter_parameters();
  parameters.push_back({.name = "target_mm",
                        .type = http::LengthIn{},
                        .description = "The middle of the limits when absent"});
  parameters.push_back(
      {.name = "cost",
       .type = http::Decimal{.scale = 6, .min = 1, .max = 1'000'000'000},
       .description = "Of a correction, in parts; 0.1 when absent. A larger one makes fewer"});
  routes.push_back({
      .pattern = "/v1/measurements/compensation",
      .handler = with(services, propose),
      .summary = "The next offset of a machine",
      .description = "A proposal from the newest 500 values that match; nothing moves a machine. "
                     "Select one characteristic, and the machine or the tool that makes it.",
      .parameters = std::move(parameters),
      .access = "viewer",
      .operation = "proposeOffset",
      .tag = "measurements",
      .outcomes = {{.meaning = "What was found", .schema = "Compensation"}},
      .refusals = {422},
  });
}

void add_compensation_schemas(Schemas& schemas) {
  schemas.push_back(answer_schema<Proposal>("Compensation"));
}

}  // namespace fitgauge::api
