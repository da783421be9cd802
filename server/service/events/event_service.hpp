#pragma once

#include "base/thread.hpp"
#include "db/store/documents_store.hpp"
#include "record/measurement.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

/// Wants to know when there may be something new to read.
class CommitListener {
 public:
  CommitListener& operator=(CommitListener&&) = delete;  // neither copied nor moved
  virtual ~CommitListener() = default;

  /// Called on the signal's thread after one or more commits: must not block.
  virtual void committed() = 0;
};

/// Notifies its listeners of commits, on its own thread: the writer only sets a flag, for any
/// number of listeners. Commits in quick succession are one notification. Thread-safe.
class CommitSignal {
 public:
  CommitSignal();
  ~CommitSignal();

  void raise();

  /// Ends the thread; then no listener is called. Listeners must not call it.
  void stop() { thread_.stop(); }

  void add(std::shared_ptr<CommitListener> listener);
  /// Removes a listener; a running call may still end afterwards.
  void remove(const std::shared_ptr<CommitListener>& listener);
  std::size_t listeners() const;

 private:
  void run(const std::stop_token& stop);

  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  std::vector<std::shared_ptr<CommitListener>> listeners_;  ///< the oldest first
  bool raised_ = false;
  Thread thread_;
};

/// Position of a reader of events. The measurements are the log of recorded events; only events
/// without another table are stored as such.
struct EventPosition {
  std::int64_t measurement = 0;
  bool reject_is_due = false;  ///< this measurement was sent as recorded, not yet as rejected
  std::int64_t stored = 0;

  friend auto operator<=>(const EventPosition&, const EventPosition&) = default;
};

/// The opaque id of an event: a reader that stopped there continues after it.
/// @param history ending of the ids of the folder
std::string event_id_text(const EventPosition& position, std::string_view history);
/// Parses an id of an event; none for other texts, or if the history ended before it.
std::optional<EventPosition> parse_event_id(std::string_view text, const Origins& origins);

/// One event, with a measurement or a payload; views, valid during the call it is given to.
struct Event {
  /// `measurement.recorded`, `verdict.reject`, `run.finished`, `table.changed`,
  /// `note.added`
  std::string_view type;
  EventPosition id;
  std::string_view history;  ///< as for event_id_text()
  const Measurement* measurement = nullptr;
  std::string_view payload{};  ///< JSON
};

/// Events in order, for readers that reconnect. Thread-safe; nothing here blocks.
class EventService : Records {
 public:
  /// @param retention number of measurements and of stored events that a reader may be behind.
  EventService(const Records& records, CommitSignal& signal, std::int64_t retention)
      : Records(records), signal_(signal), retention_(retention) {}

  /// The place of a reader: readers at the same place get the same page.
  struct Place {
    std::optional<EventPosition> after{};  ///< none: only events after now
    std::optional<Source> source{};        ///< of the measurements; none: all

    friend auto operator<=>(const Place&, const Place&) = default;
  };
  struct Page {
    EventPosition position;  ///< new position of the reader
    bool gap = false;        ///< the next events are deleted; the position is the newest
    bool more = false;       ///< there are more than a page holds
    std::string text{};
  };
  /// Writes an event at the end of a page's text.
  using Write = void (*)(std::string& text, const Event& event);
  using PageDone = std::function<void(const Result<Page>&)>;

  /// Returns the events of up to 200 measurements and up to 200 stored ones, written by a reader
  /// thread. Readers that request a page before a thread reads it share the page.
  /// @param write one function for all. @errors StorageUnavailable, StorageBusy.
  void read(const Place& place, Write write, PageDone done);

  /// Position of a reader after this event; none: it is reported as a gap.
  std::optional<EventPosition> position_of(std::string_view event_id) const {
    return parse_event_id(event_id, origins_);
  }
  /// The id of the event at which a reader of pages is now.
  std::string id_text(const EventPosition& position) const {
    return event_id_text(position, origins_.own());
  }

  /// Whether a stored event with this number was given its id in that history.
  bool is_of(std::string_view history, std::int64_t stored) const {
    return !history.empty() && origins_.number(history, stored, Counted::Event) == 0;
  }
  /// A single event that is in no other table.
  struct Stored : store::Event {
    std::string_view history{};  ///< in which it was given its id
  };
  struct StoredPage {
    std::vector<Stored> events{};  ///< oldest first
    std::int64_t newest = 0;       ///< of all existing events
    bool gap = false;              ///< some of the next events are deleted
  };
  /// Reads up to `limit` stored events after `after`, on a reader thread.
  /// @errors StorageUnavailable, StorageBusy.
  void read_stored(std::int64_t after, std::size_t limit,
                   std::function<void(Result<StoredPage>)> done);

  /// Adds a listener, which is called if there may be new events.
  void add(std::shared_ptr<CommitListener> listener) { signal_.add(std::move(listener)); }
  void remove(const std::shared_ptr<CommitListener>& listener) { signal_.remove(listener); }
  std::size_t readers() const { return signal_.listeners(); }

 private:
  using Readers = std::vector<PageDone>;
  struct PageWork;

  CommitSignal& signal_;
  std::int64_t retention_;
  std::mutex mutex_;
  std::map<Place, Readers> waiting_;  ///< for pages that no thread has begun to read
};

}  // namespace fitgauge::app
