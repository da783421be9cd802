#include "app/service/event_service.hpp"

#include <fmt/format.h>

#include <charconv>

#include "app/measurements/mapping.hpp"
#include "app/tables/table_catalog.hpp"
#include "store/database.hpp"

namespace fitgauge::app {
namespace {

/// Takes a whole number from the front of `text`.
std::optional<std::int64_t> take_number(std::string_view& text) {
  std::int64_t number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || number < 0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

/// Walks one page of events in one state of the database.
class EventReader {
 public:
  EventReader(const store::Stores& stores, const EventService::Visitor& visit)
      : stores_(stores), visit_(visit) {}

  EventPosition newest() const {
    return {.measurement = stores_.measurements.last_id(), .stored = stores_.events.kept().newest};
  }

  /// Whether what follows `after` can still be told. A position of the future is of another
  /// database.
  bool can_go_on(const EventPosition& after, std::int64_t retention) const {
    const EventPosition end = newest();
    const store::EventsStore::Kept kept = stores_.events.kept();
    return after.measurement <= end.measurement && after.stored <= end.stored &&
           end.measurement - after.measurement <= retention && after.stored + 1 >= kept.oldest;
  }

  EventPosition read(EventPosition after, std::optional<Source> source, std::size_t limit,
                     const RowNames& names) {
    position_ = after;
    read_measurements(source, limit, names);
    for (const store::Event& event : stores_.events.after(position_.stored, limit)) {
      position_.stored = event.id;
      visit_({.type = event.type, .id = position_, .payload = event.payload});
    }
    return position_;
  }

 private:
  void read_measurements(std::optional<Source> source, std::size_t limit, const RowNames& names) {
    store::MeasurementFilter filter;
    filter.source = source ? std::optional(to_store(*source)) : std::nullopt;
    filter.history = true;
    const auto end = stores_.measurements.last_id();
    const auto after = position_.measurement - (position_.reject_is_due ? 1 : 0);
    const auto next = stores_.measurements.list(
        filter, after, limit,
        [&](const store::MeasurementRow& row) { tell(from_store(row, names)); });
    // Rows of another source that were passed over need not be looked at again.
    position_.measurement = next.value_or(end);
    position_.reject_is_due = false;
  }

  void tell(const Measurement& measurement) {
    const bool told = position_.reject_is_due && position_.measurement == measurement.row;
    const bool rejected = measurement.result.verdict == gauging::Verdict::Reject;
    position_.measurement = measurement.row;
    position_.reject_is_due = rejected;
    if (!told) {
      visit_({.type = "measurement.recorded", .id = position_, .measurement = &measurement});
    }
    position_.reject_is_due = false;
    if (rejected) visit_({.type = "verdict.reject", .id = position_, .measurement = &measurement});
  }

  const store::Stores& stores_;
  const EventService::Visitor& visit_;
  EventPosition position_;
};

}  // namespace

std::string event_id_text(const EventPosition& position) {
  return fmt::format("m{}{}.e{}", position.measurement, position.reject_is_due ? "r" : "",
                     position.stored);
}

std::optional<EventPosition> parse_event_id(std::string_view text) {
  EventPosition position;
  if (!take(text, "m")) return std::nullopt;
  const auto measurement = take_number(text);
  position.reject_is_due = take(text, "r");
  if (!measurement || !take(text, ".e")) return std::nullopt;
  const auto stored = take_number(text);
  if (!stored || !text.empty()) return std::nullopt;
  position.measurement = *measurement;
  position.stored = *stored;
  return position;
}

void EventService::read(std::optional<EventPosition> after, std::optional<Source> source,
                        std::size_t limit, Visitor visit, Done done) {
  database_.readers().submit(
      [this, after, source, limit,
       visit = std::move(visit)](const store::Stores& stores) -> Result<Page> {
        EventReader reader(stores, visit);
        if (!after) return Page{.position = reader.newest()};
        if (!reader.can_go_on(*after, retention_)) {
          return Page{.position = reader.newest(), .gap = true};
        }
        const RowNames names = row_names(tables_, origins_);
        return Page{.position = reader.read(*after, source, limit, names)};
      },
      std::move(done));
}

void EventService::read_stored(std::int64_t after, std::size_t limit,
                               std::function<void(Result<StoredPage>)> done) {
  database_.readers().submit(
      [after, limit](const store::Stores& stores) -> Result<StoredPage> {
        const store::EventsStore::Kept kept = stores.events.kept();
        StoredPage page{.newest = kept.newest, .gap = after + 1 < kept.oldest};
        for (store::Event& event : stores.events.after(after, limit)) {
          page.events.push_back({.id = event.id,
                                 .type = std::move(event.type),
                                 .payload = std::move(event.payload),
                                 .at = Timestamp{event.created_at_ns}});
        }
        return page;
      },
      std::move(done));
}

}  // namespace fitgauge::app
