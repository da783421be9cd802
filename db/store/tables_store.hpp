#pragma once

#include "base/digest.hpp"

namespace fitgauge::store {

namespace sql {
class Connection;
}

// The members of rows are the columns in their order: sql::row_of reads them so.

/// One cell of a table of the standard. `table` and `column` are the caller's names.
struct TableCell {
  std::string table{};
  std::string column{};
  std::int64_t over_nm = 0;
  std::int64_t up_to_nm = 0;
  std::optional<std::int64_t> value_nm{};  ///< none: not defined by the standard

  // NOLINTNEXTLINE(modernize-use-nullptr): the zero is the compiler's
  friend auto operator<=>(const TableCell&, const TableCell&) = default;
};

/// One size range of a custom tolerance class.
struct CustomCell {
  std::string table{};
  std::string column{};
  std::int64_t over_nm = 0;
  std::int64_t up_to_nm = 0;
  std::int64_t upper_nm = 0;
  std::int64_t lower_nm = 0;

  // NOLINTNEXTLINE(modernize-use-nullptr): the zero is the compiler's
  friend auto operator<=>(const CustomCell&, const CustomCell&) = default;
};

/// All of a revision's numbers, each list sorted by table, column and range.
struct TableContent {
  std::vector<TableCell> cells{};
  std::vector<CustomCell> custom{};
};

/// Digests the content in sorted order, independent of the order given (canonical_digest.hpp): the
/// number of cells, the members of each cell in order, then number and members of the custom cells.
Digest digest_of(const TableContent& content);

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
  TableContent content{};
  Digest
      computed{};  ///< of the content as loaded: differs from revision.digest when a cell changed
};

struct TableImport {
  TableContent content{};
  std::string source{};
  std::optional<std::int64_t> parent{};
  std::optional<std::string> caller{};
  std::optional<std::string> id{};  ///< id at the centre that it came from
};

/// The end of an id: the first eight digits of the digest.
std::string shown_digits(const Digest& digest);

/// The immutable revisions of the tolerance tables. The newest one is in force. Cells of the
/// standard that a revision shares with an older one are stored once.
class TablesStore {
 public:
  explicit TablesStore(sql::Connection& connection);

  /// @errors PreconditionFailed when `parent` is not the newest revision (another import came
  ///   first); TableRowsInvalid when two cells are the same or a range is empty.
  Result<TableRevision> import(const TableImport& tables, std::int64_t now_ns);

  std::optional<LoadedTables> load_latest() const;
  std::optional<LoadedTables> load(std::string_view id) const;
  std::optional<LoadedTables> load(std::int64_t number) const;
  /// As `LoadedTables::computed`, without the content. @pre the database sorts texts by bytes.
  Digest compute_digest(std::int64_t number) const;
  std::vector<TableRevision> list() const;  ///< oldest first

 private:
  struct Statements;
  std::shared_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
