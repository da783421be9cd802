#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::store {

namespace sql {
class Connection;
}

struct Event {
  std::int64_t id = 0;
  std::string type{};
  std::string payload{};  ///< opaque here
  std::int64_t created_at_ns = 0;
};

/// Events for replay, the newest ones only. Ids rise and are never used twice.
class EventsStore {
 public:
  explicit EventsStore(sql::Connection& connection);
  ~EventsStore();

  std::int64_t append(std::string_view type, std::string_view payload, std::int64_t now_ns);

  std::vector<Event> after(std::int64_t id, std::size_t limit) const;  ///< oldest first
  /// The oldest and newest ids kept; 0 and 0 when there are none. A reader that stopped at an id
  /// below `oldest - 1` has missed events.
  struct Kept {
    std::int64_t oldest = 0;
    std::int64_t newest = 0;
  };
  Kept kept() const;

  /// Deletes the oldest so that at most `keep` remain, up to `limit` of them. @returns how many.
  std::int64_t trim(std::int64_t keep, std::int64_t limit);

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
