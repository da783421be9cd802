#include "service/events/event_service.hpp"

#include "db/store/database.hpp"
#include "service/measurements/measurement_storage.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

/// Between two rounds, so that a busy writer does not keep the readers busy for each of its
/// commits.
constexpr std::chrono::milliseconds kRest{5};

constexpr std::size_t kRowsAPage = 200;

/// Reads a whole number from the front of `text`.
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
  EventReader(const Stores& stores, EventService::Write write, std::string_view history)
      : stores_(stores), write_(write), history_(history) {}

  EventPosition newest() const {
    return {.measurement = stores_.measurements.last_id(), .stored = stores_.events.kept().newest};
  }

  /// Whether the events after `after` still exist. A future position is of another database.
  bool can_go_on(const EventPosition& after, std::int64_t retention) const {
    const EventPosition end = newest();
    const store::EventsStore::Kept kept = stores_.events.kept();
    return after.measurement <= end.measurement && after.stored <= end.stored &&
           end.measurement - after.measurement <= retention && after.stored + 1 >= kept.oldest;
  }

  EventService::Page read(const EventPosition& after, std::optional<Source> source,
                          const RowNames& names) {
    page_.position = after;
    read_measurements(source, names);
    const auto stored = stores_.events.after(page_.position.stored, kRowsAPage);
    for (const store::Event& event : stored) {
      page_.position.stored = event.id;
      put(event.type, nullptr, event.payload);
    }
    page_.more = page_.more || stored.size() == kRowsAPage;
    return std::move(page_);
  }

 private:
  void read_measurements(std::optional<Source> source, const RowNames& names) {
    store::MeasurementFilter filter;
    filter.source = source;
    filter.history = true;
    EventPosition& position = page_.position;
    const auto end = stores_.measurements.last_id();
    const auto after = position.measurement - (position.reject_is_due ? 1 : 0);
    const auto next =
        stores_.measurements.list(filter, after, kRowsAPage,
                                  [&](const MeasurementRow& row) { tell(from_store(row, names)); });
    page_.more = next.has_value();
    // Skipped rows of another source need not be read again.
    position.measurement = next.value_or(end);
    position.reject_is_due = false;
  }

  void tell(const Measurement& measurement) {
    EventPosition& position = page_.position;
    const bool told = position.reject_is_due && position.measurement == measurement.row;
    const bool rejected = measurement.result.verdict == gauging::Verdict::Reject;
    position.measurement = measurement.row;
    position.reject_is_due = rejected;
    if (!told) put("measurement.recorded", &measurement);
    position.reject_is_due = false;
    if (rejected) put("verdict.reject", &measurement);
  }

  void put(std::string_view type, const Measurement* measurement, std::string_view payload = {}) {
    write_(page_.text, {type, page_.position, history_, measurement, payload});
  }

  const Stores& stores_;
  const EventService::Write write_;
  const std::string_view history_;
  EventService::Page page_;
};

}  // namespace

CommitSignal::CommitSignal()
    : thread_("commit signal", [this](const std::stop_token& stop) { run(stop); }) {}
CommitSignal::~CommitSignal() = default;

void CommitSignal::raise() {
  const std::lock_guard lock(mutex_);
  if (raised_ || listeners_.empty()) return;
  raised_ = true;
  wake_.notify_one();
}

void CommitSignal::add(std::shared_ptr<CommitListener> listener) {
  const std::lock_guard lock(mutex_);
  listeners_.push_back(std::move(listener));
}

void CommitSignal::remove(const std::shared_ptr<CommitListener>& listener) {
  const std::lock_guard lock(mutex_);
  std::erase(listeners_, listener);
}

std::size_t CommitSignal::listeners() const {
  const std::lock_guard lock(mutex_);
  return listeners_.size();
}

void CommitSignal::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return raised_; })) {
    raised_ = false;
    auto listeners = listeners_;
    lock.unlock();
    for (const auto& listener : listeners) {
      guarded("a listener of commits", [&] { listener->committed(); });
    }
    listeners.clear();
    lock.lock();
    wake_.wait_for(lock, stop, kRest, [] { return false; });
  }
}

std::string event_id_text(const EventPosition& position, std::string_view history) {
  return fmt::format("m{}{}.e{}-{}", position.measurement, position.reject_is_due ? "r" : "",
                     position.stored, history);
}

std::optional<EventPosition> parse_event_id(std::string_view text, const Origins& origins) {
  EventPosition position;
  if (!take(text, "m")) return std::nullopt;
  const auto measurement = take_number(text);
  position.reject_is_due = take(text, "r");
  if (!measurement || !take(text, ".e")) return std::nullopt;
  const auto stored = take_number(text);
  if (!stored || (!text.empty() && !take(text, "-"))) return std::nullopt;
  if (origins.number(text, *measurement) != 0) return std::nullopt;
  if (origins.number(text, *stored, Counted::Event) != 0) return std::nullopt;
  position.measurement = *measurement;
  position.stored = *stored;
  return position;
}

/// A page for all requests until the transaction begins: later requests may ask for later commits.
struct EventService::PageWork {
  EventService& service;
  Place place;
  Write write;
  std::shared_ptr<Readers> readers;

  void prepare() const {
    const std::lock_guard lock(service.mutex_);
    *readers = std::move(service.waiting_.extract(place).mapped());
  }

  Result<Page> operator()(const Stores& stores) const {
    EventReader reader(stores, write, service.origins_.own());
    if (!place.after) return Page{.position = reader.newest()};
    if (!reader.can_go_on(*place.after, service.retention_)) {
      return Page{.position = reader.newest(), .gap = true};
    }
    return reader.read(*place.after, place.source, row_names(service.tables_, service.origins_));
  }
};

void EventService::read(const Place& place, Write write, PageDone done) {
  {
    const std::lock_guard lock(mutex_);
    const auto [waiting, is_first] = waiting_.try_emplace(place);
    waiting->second.push_back(std::move(done));
    if (!is_first) return;
  }
  PageWork work{*this, place, write, std::make_shared<Readers>()};
  auto tell = [work](const Result<Page>& page) {
    if (work.readers->empty()) work.prepare();  // refused before it began
    for (const PageDone& reader : *work.readers) {
      guarded("a reader of events", [&] { reader(page); });
    }
  };
  database_.readers().submit(std::move(work), std::move(tell));
}

void EventService::read_stored(std::int64_t after, std::size_t limit,
                               std::function<void(Result<StoredPage>)> done) {
  database_.readers().submit(
      [this, after, limit](const Stores& stores) {
        const store::EventsStore::Kept kept = stores.events.kept();
        StoredPage page{.newest = kept.newest, .gap = after + 1 < kept.oldest};
        for (store::Event& event : stores.events.after(after, limit)) {
          const auto history = origins_.own(Counted::Event, event.id);
          page.events.push_back({std::move(event), history});
        }
        return page;
      },
      std::move(done));
}

}  // namespace fitgauge::app
