#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/measurements/measurement.hpp"
#include "app/service/commit_signal.hpp"

namespace fitgauge::store {
class Database;
}

namespace fitgauge::app {

class TableCatalog;

/// How far a reader of events has come. The measurements themselves are the log of what was
/// recorded; only events that are in no other table are stored as such.
struct EventPosition {
  std::int64_t measurement = 0;
  bool reject_is_due = false;  ///< this measurement was told as recorded, not yet as rejected
  std::int64_t stored = 0;

  friend bool operator==(const EventPosition&, const EventPosition&) = default;
};

/// The id of an event, opaque to the outside: a reader that stopped there goes on with the next.
std::string event_id_text(const EventPosition& position);
std::optional<EventPosition> parse_event_id(std::string_view text);

/// One event, with a measurement or a payload; views, valid during the visitor's call.
struct Event {
  /// `measurement.recorded`, `verdict.reject`, `run.finished`, `table.changed`,
  /// `note.added`
  std::string_view type;
  EventPosition id;
  const Measurement* measurement = nullptr;
  std::string_view payload{};  ///< JSON
};

/// What happened, in order, for readers that come back. Thread-safe; nothing here blocks.
class EventService {
 public:
  /// @param retention how many measurements and how many stored events a reader may be behind.
  /// @param origins outlive the service.
  EventService(store::Database& database, const TableCatalog& tables, const Origins& origins,
               CommitSignal& signal, std::int64_t retention)
      : database_(database),
        tables_(tables),
        origins_(origins),
        signal_(signal),
        retention_(retention) {}

  /// Where the reader is now.
  struct Page {
    EventPosition position;
    bool gap = false;  ///< what came next is gone; the position is the newest
  };
  using Visitor = std::function<void(const Event&)>;
  using Done = std::function<void(Result<Page>)>;

  /// Visits the events of up to `limit` measurements and stored events each, on a reader thread.
  /// @param after none: from now on, so that none is visited.
  /// @param source of the measurements; none: all. @errors StorageUnavailable, StorageBusy.
  void read(std::optional<EventPosition> after, std::optional<Source> source, std::size_t limit,
            Visitor visit, Done done);

  /// An event that is in no other table, on its own.
  struct Stored {
    std::int64_t id = 0;
    std::string type{};
    std::string payload{};  ///< JSON
    Timestamp at{};
  };
  struct StoredPage {
    std::vector<Stored> events{};  ///< oldest first
    std::int64_t newest = 0;       ///< of all that there are
    bool gap = false;              ///< some that came next are gone
  };
  /// Reads up to `limit` stored events behind `after`, on a reader thread.
  /// @errors StorageUnavailable, StorageBusy.
  void read_stored(std::int64_t after, std::size_t limit,
                   std::function<void(Result<StoredPage>)> done);

  /// A listener is told when there may be new events.
  void add(std::shared_ptr<CommitListener> listener) { signal_.add(std::move(listener)); }
  void remove(const std::shared_ptr<CommitListener>& listener) { signal_.remove(listener); }
  std::size_t readers() const { return signal_.listeners(); }

 private:
  store::Database& database_;
  const TableCatalog& tables_;
  const Origins& origins_;
  CommitSignal& signal_;
  std::int64_t retention_;
};

}  // namespace fitgauge::app
