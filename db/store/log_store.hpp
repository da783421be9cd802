#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/digest.hpp"

namespace fitgauge::store {

namespace sql {
class Connection;
}

/// The log that the measurements of a data folder form: its origin, its keys, and those nodes of
/// its tree that are kept. The leaves stand in the measurements (MeasurementsStore::log_hashes).
class LogStore {
 public:
  explicit LogStore(sql::Connection& connection);
  ~LogStore();

  struct State {
    std::array<std::uint8_t, 16> origin{};  ///< random, made with the database, for ever its own
    std::optional<std::string> name{};      ///< what its checkpoints begin with; none yet
    std::int64_t size = 0;                  ///< rows that are in the tree
  };
  State state() const;

  /// Once, at the first start.
  void set_name(std::string_view name);

  /// A history before the one that state() names, and what of it went on in the next.
  struct Branch {
    std::array<std::uint8_t, 16> origin{};
    std::string name{};
    std::int64_t size = 0;  ///< rows of its tree
    /// The newest numbers in ids that it gave out: of measurements, runs, events and notes.
    std::array<std::int64_t, 4> newest{};
  };
  std::vector<Branch> branches() const;  ///< the oldest first
  /// Whether the database is a copy that `backup` made and nobody has started.
  bool is_copy() const;
  /// Why no measurement is recorded, if the centre has another log of this name.
  std::optional<std::string> forked() const;
  void set_forked(const std::optional<std::string>& reason);
  /// Ends the history that state() names with the `size` rows there are, and begins another.
  void begin_branch(std::int64_t size, const std::array<std::uint8_t, 16>& origin,
                    std::string_view name);

  /// The public keys (vkeys) that have signed, the newest first.
  std::vector<std::string> keys() const;
  void add_key(std::string_view vkey, std::int64_t now_ns);

  /// The root of 256^level leaves, the `index`-th of its level.
  struct Node {
    int level = 0;  ///< 1 and up
    std::int64_t index = 0;
    Digest hash{};
  };
  /// Sets the size of the tree and keeps the nodes that were completed.
  void grow(std::int64_t size, std::span<const Node> nodes);

  using Visitor = std::function<void(const Digest&)>;
  /// Visits the nodes of a level from `first` on. @returns how many there were, at most `count`.
  std::int64_t nodes(int level, std::int64_t first, std::int64_t count, const Visitor& visit) const;

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
