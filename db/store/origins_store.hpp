#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/digest.hpp"
#include "db/store/log_store.hpp"

namespace fitgauge::store {

namespace sql {
class Connection;
}

/// The other data folders whose records stand here, as their stations forward them; and how far
/// this folder's own log was forwarded.
class OriginsStore {
 public:
  explicit OriginsStore(sql::Connection& connection);
  ~OriginsStore();

  struct Origin {
    std::int64_t number = 0;                  ///< in MeasurementRow::origin, from 1 on
    std::string digits{};                     ///< what its ids end with
    std::optional<std::int64_t> first_row{};  ///< the id of its first row here
    std::int64_t size = 0;                    ///< rows of it that are here
    std::string checkpoint{};  ///< the signed head of so many; empty before the first
  };
  std::vector<Origin> list() const;  ///< by number
  std::optional<Origin> find(std::string_view digits) const;
  std::optional<Origin> find(std::int64_t number) const;

  /// @returns its number.
  std::int64_t add(std::string_view digits);
  /// Its head after more rows came. `first_row` is set with the first of them.
  void set_head(const Origin& origin);

  /// The public keys whose checkpoints are taken, the oldest first.
  std::vector<std::string> keys(std::int64_t origin) const;
  void add_key(std::int64_t origin, std::string_view vkey, std::int64_t now_ns);

  /// The log that this one is a branch of, and how many of its rows it begins with.
  struct Base {
    std::int64_t origin = 0;
    std::int64_t size = 0;
  };
  std::optional<Base> base(std::int64_t origin) const;
  void set_base(std::int64_t origin, const Base& base);

  /// Keeps nodes of its tree, as LogStore::grow.
  void keep_nodes(std::int64_t origin, std::span<const LogStore::Node> nodes);
  /// As LogStore::nodes.
  std::int64_t nodes(std::int64_t origin, int level, std::int64_t first, std::int64_t count,
                     const LogStore::Visitor& visit) const;

  /// Signed heads that contradict its own: the folder was copied and started twice.
  std::vector<std::string> forks(std::int64_t origin) const;
  /// @returns false: this one is known.
  bool add_fork(std::int64_t origin, std::string_view checkpoint, std::int64_t now_ns);

  struct Revision {
    std::int64_t number = 0;  ///< rows name it by the negative of this
    std::string id{};
  };
  /// The table revisions that judged forwarded records and are not here.
  std::vector<Revision> revisions() const;
  /// @returns its number; it may be known already.
  std::int64_t add_revision(std::string_view id);

  struct Forwarded {
    std::string centre{};
    std::int64_t size = 0;  ///< rows of this folder's own log that the centre has confirmed
  };
  std::optional<Forwarded> forwarded() const;
  void set_forwarded(const Forwarded& forwarded);

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
