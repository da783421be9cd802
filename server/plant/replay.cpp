#include "plant/replay.hpp"

#include <fmt/format.h>

#include <charconv>
#include <future>

#include "service/events/event_service.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kEventsAtATime = 1000;

Error invalid_from(std::string message) {
  api::FieldErrors errors;
  errors.add(ErrorCode::FieldInvalid, "/from", std::move(message));
  return *errors.take();
}

/// Waits for what a service gives to `done`.
template <class T, class Start>
Result<T> given_by(const Start& start) {
  std::promise<Result<T>> promise;
  auto result = promise.get_future();
  start([&promise](Result<T> given) { promise.set_value(std::move(given)); });
  return result.get();
}

/// The number of an event of this folder.
std::optional<std::int64_t> event_number(std::string_view id, std::string_view origin) {
  std::int64_t number = 0;
  if (!id.starts_with('e')) return std::nullopt;
  const auto [end, fault] = std::from_chars(id.data() + 1, id.data() + id.size(), number);
  const std::string_view rest(end, static_cast<std::size_t>(id.data() + id.size() - end));
  const bool is_own = fault == std::errc() && rest.starts_with('-') && rest.substr(1) == origin;
  return is_own ? std::optional(number) : std::nullopt;
}

/// The row of the first measurement that was received then or later; none: there is none.
Result<std::optional<std::int64_t>> first_row_from(Timestamp time, const Plant& plant) {
  app::MeasurementQuery query;
  query.source.reset();
  query.history = true;
  query.received_from = time;
  std::optional<std::int64_t> first;
  const auto listed = given_by<app::ListPage>([&](auto done) {
    plant.measurements.list(
        query, 0, 1, [&](const app::Measurement& found) { first = found.row; }, std::move(done));
  });
  if (!listed) return listed.error();
  return first;
}

/// The newest event from before that time, 0 when there is none.
Result<std::int64_t> last_event_before(Timestamp time, const Plant& plant) {
  std::int64_t last = 0;
  for (;;) {
    const auto page = given_by<app::EventService::StoredPage>(
        [&](auto done) { plant.events.read_stored(last, kEventsAtATime, std::move(done)); });
    if (!page) return page.error();
    for (const auto& event : page->events) {
      if (event.at >= time) return last;
      last = event.id;
    }
    if (page->events.size() < kEventsAtATime) return last;
  }
}

}  // namespace

Result<void> move_back(Progress& progress, const ReplayOrder& order, const Plant& plant) {
  std::optional<std::int64_t> position;
  std::optional<std::int64_t> event;
  if (const auto time = parse_rfc3339(order.from)) {
    const auto first = first_row_from(*time, plant);
    if (!first) return first.error();
    if (*first) position = std::min(**first - 1, progress.position);
    if (progress.event) {
      const auto last = last_event_before(*time, plant);
      if (!last) return last.error();
      event = std::min(*last, *progress.event);
    }
  } else if (const auto number = event_number(order.from, plant.origin)) {
    if (!progress.event) return invalid_from("the connection sends no events beside measurements");
    event = *number - 1;
  } else {
    const auto name = plant.measurements.parse_id(order.from);
    if (!name) {
      return invalid_from(fmt::format(
          "from must be the id of a measurement or an event, or an RFC 3339 time; got '{}'",
          order.from));
    }
    const auto row = given_by<std::int64_t>([&](auto done) {
      plant.measurements.find(
          *name, [](const auto&) {}, std::move(done));
    });
    if (!row)
      return row.error().code == ErrorCode::MeasurementUnknown ? invalid_from(row.error().message)
                                                               : row.error();
    position = *row - 1;
  }
  if (position.value_or(0) > progress.position || event.value_or(0) > progress.event.value_or(0)) {
    return invalid_from(
        "from must have gone out before: what follows the connection's position "
        "goes out anyway");
  }
  if (position) progress.position = *position;
  if (event) progress.event = *event;
  progress.planned = 0;
  return {};
}

}  // namespace fitgauge::connections
