#pragma once

#include "base/digest.hpp"
#include "db/store/on_connection.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::store {

/// Digests the numbers in the order of table, column and range, independent of the order given
/// (canonical_digest.hpp): the number of cells, of each its table, column, range and value, then
/// the number of rows of custom classes, of each its feature, class, range and deviations.
Digest digest_of(const iso286::TableData& content);

struct TableRevision {
  std::int64_t number = 0;  ///< 1, 2, …: measurements refer to it
  /// Number and the first eight digits of the digest, `1-3f9a0c21`; of a revision that came from a
  /// centre, the centre's.
  std::string id{};
  Digest digest{};  ///< as stored at import
  std::string source{};
  std::int64_t created_at_ns = 0;
  std::optional<std::int64_t> parent{};  ///< number of the revision this one was made from
  std::optional<std::string> caller{};
};

struct LoadedTables {
  TableRevision revision{};
  Result<iso286::TableData> content;  ///< TablesInconsistent if a table or feature is unknown
  Digest
      computed{};  ///< of the content as loaded: differs from revision.digest when a cell changed
};

struct TableImport {
  iso286::TableData content{};
  std::string source{};
  std::optional<std::int64_t> parent{};
  std::optional<std::string> caller{};
  std::optional<std::string> id{};  ///< id at the centre that it came from
};

/// The end of an id: the first eight digits of the digest.
std::string shown_digits(const Digest& digest);

/// The immutable revisions of the tolerance tables. The newest one is in force. Cells of the
/// standard that a revision shares with an older one are stored once.
class TablesStore : public OnConnection<TablesStore> {
 public:
  /// @errors PreconditionFailed when `parent` is not the newest revision (another import came
  ///   first); TableRowsInvalid when two cells are the same or a range is empty.
  Result<TableRevision> import(const TableImport& tables, std::int64_t now_ns);

  std::optional<LoadedTables> load_latest() const;
  std::optional<LoadedTables> load(std::string_view id) const;
  std::optional<LoadedTables> load(std::int64_t number) const;
  /// As `LoadedTables::computed`, without the content. @pre the database sorts texts by bytes.
  Digest compute_digest(std::int64_t number) const;
  std::vector<TableRevision> list() const;  ///< oldest first
};

}  // namespace fitgauge::store
