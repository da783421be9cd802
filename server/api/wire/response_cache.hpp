#pragma once

#include <unordered_map>

#include "http/route.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::api {

/// Returns the current tables, or the revision of the request.
/// @errors RevisionUnknown, TablesInconsistent, StorageUnavailable.
void tables_of(app::TableCatalog& catalog, const Request& request,
               app::Done<app::TableCatalog::Tables> done);

using TableHandler =
    std::function<Result<Response>(const Request&, const iso286::ToleranceTables&)>;

/// A handler that answers at once by `current`, or by `make` from older tables if the query has
/// `revision`.
/// @errors RevisionUnknown, and those of both.
http::EitherHandler of_revision(app::TableCatalog& tables, http::SyncHandler current,
                                TableHandler make);

/// Returns whether `revision` is the only member of a query.
bool asks_for_revision_alone(const Request& request);

Parameter revision_parameter();

/// Answers made from the tables, serialised once per route, arguments and form, however these are
/// spelt; dropped when the tables change. At most 4 MiB, no answer over 64 KiB. Thread-safe.
class ResponseCache {
 public:
  explicit ResponseCache(app::TableCatalog& tables) : tables_(tables) {}

  /// A handler that responds from the cache, or from `make` with the current tables. Only 200 is
  /// cached.
  /// @errors TablesInconsistent if the tables fail their audit; those of `make`.
  static http::SyncHandler cached(std::shared_ptr<ResponseCache> cache, TableHandler make);

  /// A handler like cached() that uses older tables, without the cache, if the query has
  /// `revision`.
  /// @errors RevisionUnknown, and those of cached().
  static http::EitherHandler of_revision(std::shared_ptr<ResponseCache> cache, TableHandler make) {
    return api::of_revision(cache->tables_, cached(cache, make), make);
  }

 private:
  using Prepared = std::shared_ptr<const http::PreparedResponse>;

  Prepared find(const Request& request);
  void keep(const Request& request, std::shared_ptr<const app::TableState> state,
            Prepared response);

  app::TableCatalog& tables_;
  std::mutex mutex_;
  std::shared_ptr<const app::TableState> state_;  // the tables the answers were made from
  std::unordered_map<std::string, Prepared> answers_;
  std::size_t bytes_ = 0;
  std::string key_;  // reused, so that a hit allocates nothing
};

}  // namespace fitgauge::api
