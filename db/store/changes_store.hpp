#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/digest.hpp"

namespace fitgauge::store {

namespace sql {
class Connection;
}

/// A change of what decides: a table, a document or a key.
struct Change {
  std::int64_t id = 0;  ///< 1, 2, … without gaps
  std::int64_t at_ns = 0;
  std::optional<std::string> caller{};
  std::string kind{};
  std::string name{};
  std::string action{};
  std::optional<std::string> before{};  ///< JSON; none: it was not there
  std::optional<std::string> after{};   ///< JSON; none: it is gone
};

struct ChangeFilter {
  std::optional<std::string> kind{};
  std::optional<std::string> name{};
  std::optional<std::int64_t> from_ns{};
  std::optional<std::int64_t> to_ns{};  ///< before then
};

/// The changes, kept for ever: the database refuses UPDATE and DELETE.
class ChangesStore {
 public:
  explicit ChangesStore(sql::Connection& connection);
  ~ChangesStore();

  std::int64_t size() const;
  /// @pre its id is size() + 1. @param leaf its hash in the tree of changes
  void append(const Change& change, const Digest& leaf);
  struct Page {
    std::vector<Change> changes{};
    bool has_more = false;
  };
  /// Those behind `after`, oldest first, at most `limit`, and no more behind 4 MiB of texts.
  Page list(const ChangeFilter& filter, std::int64_t after, std::int64_t limit) const;
  /// Visits the hashes of `count` changes behind `after`.
  void leaves(std::int64_t after, std::int64_t count,
              const std::function<void(const Digest&)>& visit) const;

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
