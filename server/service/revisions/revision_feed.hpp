#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "service/revisions/revision.hpp"

namespace fitgauge::store {
class Database;
struct Stores;
}  // namespace fitgauge::store

namespace fitgauge::app {

class Origins;
class TableCatalog;

/// What this centre hands on to its stations: the tables with own columns, keys of viewers and
/// operators by their hashes, setups, plans, and corrections of a station's records. Thread-safe.
class RevisionFeed {
 public:
  using Done = std::function<void(Result<RevisionPage>)>;

  RevisionFeed(store::Database& database, const TableCatalog& tables, const Origins& origins)
      : database_(database), tables_(tables), origins_(origins) {}

  /// What has changed behind a position; all there is, where this folder has not given it out.
  /// Of each thing its last revision alone.
  /// @param station the digits of its origin: whose corrections are meant.
  /// @errors those of storage.
  void read(std::string_view station, std::string position, Done done) const;

 private:
  Result<RevisionPage> page(const store::Stores& stores, std::string_view station,
                            std::string_view position) const;
  bool fill(const store::Stores& stores, const std::string& name, Revision& revision) const;

  store::Database& database_;
  const TableCatalog& tables_;
  const Origins& origins_;
};

}  // namespace fitgauge::app
