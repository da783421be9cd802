#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fitgauge::store {

namespace sql {
class Connection;
}

/// What somebody found out about a measurement or did because of it; at least one of the texts.
struct Note {
  std::int64_t id = 0;           ///< given by the store
  std::int64_t measurement = 0;  ///< the row it is about
  std::optional<std::string> cause{};
  std::optional<std::string> measure{};
  std::optional<std::string> text{};
  std::optional<std::string> operator_id{};
  std::optional<std::string> caller{};
  std::int64_t received_at_ns = 0;
};

/// Notes beside measurements, kept for ever: the database refuses UPDATE and DELETE.
class NotesStore {
 public:
  explicit NotesStore(sql::Connection& connection);
  ~NotesStore();

  std::int64_t append(const Note& note);                   ///< @returns its id
  std::vector<Note> list(std::int64_t measurement) const;  ///< oldest first

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
