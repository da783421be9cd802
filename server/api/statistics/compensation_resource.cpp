#include "api/measurements/measurements.hpp"
#include "api/statistics/next_offset.hpp"
#include "api/wire/event_text.hpp"
#include "api/wire/formulas.hpp"
#include "metrology/statistics/compensation.hpp"
#include "record/record.hpp"

namespace fitgauge::api {
namespace {

using metrology::Compensation;
using metrology::CompensationState;

/// Values before these do not change the offset.
constexpr std::size_t kMostParts = 500;
constexpr double kNanometresOfUm = 1000;
constexpr double kMillionths = 1e6;

/// The newest values of one characteristic, and the parts in the order of making.
struct CorrectedParts {
  struct Value {
    std::int64_t row = 0;
    std::int64_t place = 0;  ///< row of the first value in its chain of corrections
    Length decisive{};
    double offset = 0;
    std::optional<std::string> tool{};
    bool is_fit = true;  ///< its gauge is
    bool is_left_out = false;
  };

  std::shared_ptr<const GaugeBook> gauges{};
  app::MeasurementQuery filters{};  ///< of the order
  std::optional<Length> target{};
  std::vector<Value> values{};  ///< all that were added
  std::vector<metrology::MadePart> parts{};
  double offset = 0;         ///< corrections that were made after the last part
  bool begins_tool = false;  ///< the tool was changed after the last part
  std::string newest{};      ///< id of the newest value that counts; empty: there is none
  std::optional<Length> lower{};
  std::optional<Length> upper{};
  bool is_unfit = false;  ///< the gauge of the last value is
  std::optional<Error> error{};

  /// Tests the gauge as it was stored and as it is now: it may be blocked after it has measured.
  bool is_gauge_fit(const app::Measurement& value) const {
    if (value.calibration_due || value.gauge_blocked) return false;
    const auto gauge = value.gauge ? gauges->find(*value.gauge) : gauges->end();
    if (gauge == gauges->end()) return true;
    const GaugePeriod* period = gauge->second.at(value.measured_at);
    return period == nullptr || (!period->is_blocked && !period->is_overdue(value.measured_at));
  }

  /// Returns the query of all values. The filters that leave out single values are applied here,
  /// because the correction before such a value was made.
  app::MeasurementQuery query() const {
    app::MeasurementQuery query = filters;
    query.shows_first_rows = true;
    if (filters.set_aside == false) {
      query.set_aside.reset();
      query.shows_notes = true;
    }
    if (filters.confirmed == false) query.confirmed.reset();
    return query;
  }

  void take_limits(const app::Measurement& value) {
    const auto low = value.has_lower_limit() ? std::optional(value.lower_limit()) : std::nullopt;
    const auto high = value.has_upper_limit() ? std::optional(value.upper_limit()) : std::nullopt;
    if (newest.empty()) {
      newest = app::measurement_id_text(value.id, value.origin);
      lower = low;
      upper = high;
      if (!target && low && high) target = Length::nanometres((low->count() + high->count()) / 2);
    } else if (low != lower || high != upper) {
      error = Error{ErrorCode::LimitsMixed,
                    "the values have different limits: select those of one characteristic"};
    }
  }

  /// Adds values from the newest on.
  void add(const app::Measurement& value) {
    const bool is_left_out = (filters.set_aside == false && app::sets_aside(value.notes)) ||
                             (filters.confirmed == false && value.confirmed);
    if (!is_left_out) take_limits(value);
    values.push_back({.row = value.row,
                      .place = value.first_row,
                      .decisive = value.decisive(),
                      .offset = static_cast<double>(value.offset.value_or(0)) / kNanometresOfUm,
                      .tool = value.tool ? std::optional<std::string>(*value.tool) : std::nullopt,
                      .is_fit = is_gauge_fit(value),
                      .is_left_out = is_left_out});
  }

  /// Makes the parts: a correction has the place of the value that it replaces.
  /// @param has_older whether older values match, which were not added
  void arrange(bool has_older) {
    if (!target) return;
    if (has_older) {
      const std::int64_t oldest = values.back().row;
      std::erase_if(values, [oldest](const Value& value) { return value.place < oldest; });
    }
    std::ranges::sort(values, {},
                      [](const Value& value) { return std::pair(value.place, value.row); });
    std::optional<std::string> tool;
    for (const Value& value : values) {
      if (value.tool) {
        begins_tool = begins_tool || (tool && *tool != *value.tool);
        tool = value.tool;
      }
      offset += value.offset;
      if (!value.is_left_out) is_unfit = !value.is_fit;
      if (value.is_left_out || !value.is_fit) continue;
      parts.push_back(
          {.deviation = static_cast<double>((value.decisive - *target).count()) / kNanometresOfUm,
           .offset = std::exchange(offset, 0.0),
           .has_new_tool = std::exchange(begins_tool, false)});
    }
  }

  /// Distance from the target to the nearer limit, in µm; at most 0 if it is not a good size.
  double half_tolerance() const {
    const double below = lower ? static_cast<double>((*target - *lower).count()) : INFINITY;
    const double above = upper ? static_cast<double>((*upper - *target).count()) : INFINITY;
    return std::min(below, above) / kNanometresOfUm;
  }
};

/// Properties that the values share.
struct Selected {
  std::optional<std::string> characteristic{};
  std::optional<std::string> machine{};
};
Selected selected_by(const app::MeasurementQuery& query) {
  return {query.texts.at(app::kOfCharacteristic), query.texts.at(app::kOfMachine)};
}
void members(auto& v, const Selected& of) {
  v.optional("characteristic", of.characteristic, "As in the query");
  v.optional("machine", of.machine, "As in the query");
}

struct Failure {
  Selected of{};
  Error error;
};
void members(auto& v, const Failure& failure) {
  members(v, failure.of);
  v.member("code", id(failure.error.code));
  v.member("detail", std::string_view(failure.error.message));
}

struct Proposal {
  Selected of{};
  Compensation found{};
  std::size_t values = 0;
};
void members(auto& v, const Proposal& proposal) {
  constexpr double kCoverage = 1.96;
  const Compensation& c = proposal.found;
  const double reach = kCoverage * c.offset_uncertainty;
  members(v, proposal.of);
  v.member("state", c.state, Words{CompensationState::Unstable});
  v.member("reason", c.reason, "Reason for the state, as a sentence");
  v.member("offset_um", c.offset, "Brings the size of the next part to the target");
  v.member(
      "interval_um",
      c.offset ? std::optional(std::array{*c.offset - reach, *c.offset + reach}) : std::nullopt,
      "Interval of 95 % for the offset");
  v.member("values", proposal.values, "Number of values used");
  v.member("next_in_parts", c.next_in, "Number of parts until the next measurement");
  v.member("wear_um", c.offset ? std::optional(c.wear) : std::nullopt,
           "Change of the size from part to part");
  v.member("scatter_um", c.offset ? std::optional(c.scatter) : std::nullopt,
           "Standard deviation about the level");
  v.member("dead_band_um", c.offset ? std::optional(c.dead_band) : std::nullopt,
           "An offset within it costs more than it saves");
  formula_members(v, "compensation");
}

Result<Proposal> proposal_of(CorrectedParts& read, double cost) {
  if (read.error) return *read.error;
  const bool has_limits = read.lower || read.upper;
  if (!read.newest.empty() && !has_limits)
    return Error{ErrorCode::LimitsNone, "the values have no limits, which an offset needs"};
  if (!read.target && has_limits)
    return Error{ErrorCode::QueryInvalid, "values with one limit need a target", "target_mm"};
  const double half = read.target ? read.half_tolerance() : 0;
  if (read.target && !(half > 0))
    return Error{ErrorCode::QueryInvalid, "target_mm must be between the limits", "target_mm"};
  Proposal proposal{.found = metrology::propose_offset(read.parts, half, cost, read.offset),
                    .values = read.parts.size()};
  if (read.is_unfit) {
    proposal.found = {.reason =
                          "the gauge of the last value is overdue for calibration or blocked"};
  } else if (read.begins_tool) {
    proposal.found = {.reason = "the first value of the tool is left out: measure the next part"};
  }
  return proposal;
}

/// @param done gets the proposal and the id of the newest value, on a storage thread
template <class Done>
void find_offset(const OffsetOrder& order, app::MeasurementService& measurements,
                 const GaugesInUse& gauges, Done done) {
  const auto read = std::make_shared<CorrectedParts>(
      CorrectedParts{.gauges = gauges.book(), .filters = order.query, .target = order.target});
  measurements.list(
      read->query(), 0, kMostParts, [read](const app::Measurement& value) { read->add(value); },
      [read, order, done = std::move(done)](const Result<app::ListPage>& page) {
        if (page) read->arrange(page->next.has_value());
        auto found = page ? proposal_of(*read, order.cost) : Result<Proposal>(page.error());
        if (found) found->of = selected_by(order.query);
        done(std::move(found), read->newest);
      });
}

/// Sends the proposal, or why there is none, at the beginning and when its state changes.
class OffsetStream final : public CommitStream {
 public:
  OffsetStream(const Services& services, OffsetOrder order)
      : CommitStream(services.events), services_(services), order_(std::move(order)) {}

 private:
  void read() override {
    order_.find_news(services_.measurements, services_.gauges,
                     [self = std::static_pointer_cast<OffsetStream>(shared_from_this())](
                         const Result<OffsetNews>& news) {
                       if (!news) return self->fail();
                       std::string piece;
                       if (std::exchange(self->told_, news->told) != news->told)
                         append_event(piece, news->event, news->newest, news->data);
                       self->took(std::move(piece));
                     });
  }

  const Services& services_;
  const OffsetOrder order_;
  std::string told_{};  ///< used by one reading thread at a time
};

void propose(const Services& services, const Request& request, Responder responder) {
  auto query = TRY_OR_FAIL(responder, measurement_query(services, request));
  OffsetOrder order{std::move(query), request.length("target_mm")};
  order.query.newest_first = true;
  if (const auto given = request.integer("cost"))
    order.cost = static_cast<double>(*given) / kMillionths;
  const bool streams = request.response_type() == kEventStreamType;
  const auto give = [&services, order, streams, answer = answer_by(share(std::move(responder)))](
                        const Result<Proposal>& found, const std::string&) {
    if (found && streams)
      return answer(event_response(std::make_shared<OffsetStream>(services, order)));
    answer(json_response(found ? Result<std::string>(body_json(*found)) : found.error()));
  };
  find_offset(order, services.measurements, services.gauges, give);
}

}  // namespace

void OffsetOrder::find_news(app::MeasurementService& measurements, const GaugesInUse& gauges,
                            std::function<void(Result<OffsetNews>)> done) const {
  find_offset(*this, measurements, gauges,
              [of = selected_by(query), done = std::move(done)](const Result<Proposal>& found,
                                                                const std::string& newest) {
                if (!found && http::is_server_error(status_of(found.error().code)))
                  return done(found.error());
                OffsetNews news{.event = found ? kOffsetChanged : kOffsetFailed, .newest = newest};
                news.data = found ? body_json(*found) : body_json(Failure{of, found.error()});
                news.told = found ? word(found->found.state) : std::string_view(news.data);
                done(std::move(news));
              });
}

void add_compensation_routes(Routes& add) {
  auto parameters = measurement_filter_parameters();
  parameters.push_back(query("target_mm", http::LengthIn{},
                             "Value to aim at in mm (default: the middle of the limits)"));
  parameters.push_back(
      query("cost", http::Decimal{.scale = 6, .min = 1, .max = 1'000'000'000},
            "Cost of a correction in parts (default: 0.1); a larger cost gives fewer corrections"));
  add("GET /v1/measurements/compensation proposeOffset viewer 422", propose,
      {.summary = "The next offset of a machine",
       .description = "A proposal from the newest 500 values that match; nothing moves a machine. "
                      "Select one characteristic, and the machine or the tool that makes it. As "
                      "`text/event-stream`, `compensation.changed` carries it now and at each "
                      "change of its state; `compensation.failed`, with `code` and `detail`, says "
                      "that the values give none until the next one.",
       .parameters = std::move(parameters),
       .response_types = {"application/json", std::string(kEventStreamType)},
       .outcomes = {{.meaning = "Result", .schema = "Compensation"}}});
}

void add_compensation_schemas(Schemas& schemas) {
  schemas.push_back(answer_schema<Proposal>("Compensation"));
}

}  // namespace fitgauge::api
