#include "db/store/tables_store.hpp"

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"
#include "db/store/canonical_digest.hpp"

namespace fitgauge::store {
namespace {

using sql::Rows;

/// The columns of a cell, and of a row of a custom class.
using CellRow = std::tuple<std::string_view, std::string_view, std::int64_t, std::int64_t,
                           std::optional<std::int64_t>>;
using CustomRow = std::tuple<std::string_view, std::string_view, std::int64_t, std::int64_t,
                             std::int64_t, std::int64_t>;

std::vector<CellRow> rows_of(const std::vector<iso286::TableCell>& cells) {
  std::vector<CellRow> rows;
  for (const auto& [table, range, column, value] : cells) {
    rows.emplace_back(name(table), column, range.over.count(), range.up_to.count(),
                      value ? std::optional(value->count()) : std::nullopt);
  }
  if (!std::ranges::is_sorted(rows)) std::ranges::sort(rows);
  return rows;
}

std::vector<CustomRow> rows_of(const std::vector<iso286::CustomColumn>& columns) {
  std::vector<CustomRow> rows;
  for (const auto& column : columns) {
    for (const auto& [range, deviations] : column.rows) {
      rows.emplace_back(word(column.feature), column.name, range.over.count(), range.up_to.count(),
                        deviations.upper.count(), deviations.lower.count());
    }
  }
  std::ranges::sort(rows);
  return rows;
}

Digest digest_of_rows(const std::vector<CellRow>& cells, const std::vector<CustomRow>& custom) {
  CanonicalDigest digest;
  const auto add = [&digest](const auto& rows) {
    digest.add(rows.size());
    for (const auto& row : rows) {
      std::apply([&digest](const auto&... members) { (digest.add(members), ...); }, row);
    }
  };
  add(cells);
  add(custom);
  return digest.finish();
}

bool has_order(const CellRow&) { return true; }
bool has_order(const CustomRow& row) { return std::get<5>(row) <= std::get<4>(row); }

/// @errors TableRowsInvalid for a row that begins at the size of the previous row, or is empty.
template <class Row>
Result<void> check_rows(const std::vector<Row>& sorted) {
  std::optional<std::tuple<std::string_view, std::string_view, std::int64_t>> before;
  for (const Row& row : sorted) {
    const std::tuple begin(std::get<0>(row), std::get<1>(row), std::get<2>(row));
    const auto& [table, column, over] = begin;
    const std::int64_t up_to = std::get<3>(row);
    if (before == begin || over < 0 || over >= up_to || !has_order(row)) {
      return Error{ErrorCode::TableRowsInvalid,
                   "a size range is repeated or empty, or its lower deviation is above its upper "
                   "deviation",
                   fmt::format("{} {} over {} nm up to {} nm", table, column, over, up_to)};
    }
    before = begin;
  }
  return {};
}

Length length_in(const Rows& rows, int column) {
  return Length::nanometres(rows.get<std::int64_t>(column));
}
iso286::NominalSizeRange range_in(const Rows& rows) {
  return {.over = length_in(rows, 2), .up_to = length_in(rows, 3)};
}

Error unknown_table(const Rows& rows) {
  const auto table = rows.get<std::string>(0);
  return {ErrorCode::TablesInconsistent, "unknown table " + table, table};
}

constexpr std::size_t kShownDigits = 8;

TableRevision read_revision(const Rows& rows) {
  auto revision = row_of<TableRevision>(rows);
  if (revision.id.empty()) {
    revision.id = fmt::format("{}-{}", revision.number, shown_digits(revision.digest));
  }
  return revision;
}

std::string select_revision(std::string_view rest) {
  return fmt::format(
      "SELECT number, coalesce((SELECT id FROM table_revision_ids WHERE revision = number), ''), "
      "digest, source, created_at, parent, caller FROM table_revisions {}",
      rest);
}

}  // namespace

template <>
struct StatementsOf<TablesStore> {
  sql::Connection& c;
  sql::Statement newest{c, select_revision("ORDER BY number DESC LIMIT 1")};
  sql::Statement by_number{c, select_revision("WHERE number = ?")};
  sql::Statement by_given_id{c, select_revision("WHERE number = (SELECT max(revision) FROM "
                                                "table_revision_ids WHERE id = ?)")};
  sql::Statement all{c, select_revision("ORDER BY number")};
  sql::Statement cells{
      c,
      "SELECT table_name, column_name, over_nm, up_to_nm, value_nm FROM table_cells WHERE "
      "table_set = (SELECT table_set FROM table_revisions WHERE number = ?) "
      "ORDER BY table_name, column_name, over_nm"};
  sql::Statement custom{
      c,
      "SELECT table_name, column_name, over_nm, up_to_nm, upper_nm, lower_nm FROM "
      "custom_cells WHERE revision = ? ORDER BY table_name, column_name, over_nm"};
  sql::Statement set_by_digest{c, "SELECT id FROM table_sets WHERE digest = ?"};
  sql::Statement insert_set{c, kTableSets.insert(c) + " RETURNING id"};
  sql::Statement insert_cell{c, "INSERT INTO table_cells VALUES (?, ?, ?, ?, ?, ?)"};
  sql::Statement insert_revision{c, kTableRevisions.insert(c) + " RETURNING number"};
  sql::Statement insert_custom{c, "INSERT INTO custom_cells VALUES (?, ?, ?, ?, ?, ?, ?)"};
  sql::Statement insert_id{c, kTableRevisionIds.insert(c)};

  std::optional<TableRevision> one(sql::Statement& statement, auto... key) {
    Rows rows = statement.query(key...);
    if (!rows.next()) return std::nullopt;
    return read_revision(rows);
  }

  /// Adds the number of cells and the cells, which come sorted.
  void add(CanonicalDigest& digest, std::string_view place, sql::Statement& query,
           std::int64_t number) {
    sql::Statement counting(c, fmt::format("SELECT count(*) FROM {}", place));
    digest.add(counting.returning<std::int64_t>(number));
    for (Rows rows = query.query(number); rows.next();) {
      digest.add(rows.get<std::string_view>(0));
      digest.add(rows.get<std::string_view>(1));
      for (int i = 2; i < rows.columns(); ++i) {
        digest.add(rows.get<std::optional<std::int64_t>>(i));
      }
    }
  }

  Result<iso286::TableData> read(std::int64_t number) {
    iso286::TableData data;
    for (Rows rows = cells.query(number); rows.next();) {
      const auto table = iso286::table_from_name(rows.get<std::string_view>(0));
      if (!table) return unknown_table(rows);
      const auto value = rows.get<std::optional<std::int64_t>>(4);
      data.cells.push_back({*table, range_in(rows), rows.get<std::string>(1),
                            value ? std::optional(Length::nanometres(*value)) : std::nullopt});
    }
    std::map<std::pair<iso286::Feature, std::string>, std::vector<iso286::CustomRow>> columns;
    for (Rows rows = custom.query(number); rows.next();) {
      const auto feature = iso286::feature_from_word(rows.get<std::string_view>(0));
      if (!feature) return unknown_table(rows);
      columns[{*feature, rows.get<std::string>(1)}].push_back(
          {range_in(rows), {.upper = length_in(rows, 4), .lower = length_in(rows, 5)}});
    }
    for (auto& [key, rows] : columns) {
      data.custom_columns.push_back({key.first, key.second, std::move(rows)});
    }
    return data;
  }

  std::optional<LoadedTables> load(std::optional<TableRevision> revision) {
    if (!revision) return std::nullopt;
    LoadedTables loaded{.content = read(revision->number)};
    loaded.revision = *std::move(revision);
    if (loaded.content) loaded.computed = digest_of(*loaded.content);
    return loaded;
  }

  /// The set with exactly these cells, stored now if it was not.
  std::int64_t set_of(const std::vector<CellRow>& rows) {
    const Digest digest = digest_of_rows(rows, {});
    if (const auto known = read_first<std::int64_t>(set_by_digest.query(digest))) return *known;
    const auto set = insert_set.returning<std::int64_t>(digest);
    for (const CellRow& row : rows) {
      std::apply([&](const auto&... values) { insert_cell.run(set, values...); }, row);
    }
    return set;
  }
};

std::string shown_digits(const Digest& digest) { return to_hex(digest).substr(0, kShownDigits); }

Digest digest_of(const iso286::TableData& content) {
  return digest_of_rows(rows_of(content.cells), rows_of(content.custom_columns));
}

Result<TableRevision> TablesStore::import(const TableImport& tables, std::int64_t now_ns) {
  const std::optional<TableRevision> newest = statements().one(statements().newest);
  const std::optional<std::int64_t> in_force =
      newest ? std::optional(newest->number) : std::nullopt;
  if (tables.parent != in_force) {
    return Error{
        ErrorCode::PreconditionFailed,
        fmt::format("the current tables are revision {}: read them again and repeat the change",
                    newest ? newest->id : "none")};
  }
  const auto cells = rows_of(tables.content.cells);
  TRY(check_rows(cells));
  const auto custom = rows_of(tables.content.custom_columns);
  TRY(check_rows(custom));

  const std::int64_t set = statements().set_of(cells);
  const auto number = statements().insert_revision.returning<std::int64_t>(
      digest_of_rows(cells, custom), set, tables.source, now_ns, tables.parent, tables.caller);
  for (const CustomRow& row : custom) {
    std::apply([&](const auto&... values) { statements().insert_custom.run(number, values...); },
               row);
  }
  if (tables.id) statements().insert_id.run(number, *tables.id);
  return *statements().one(statements().by_number, number);
}

std::optional<LoadedTables> TablesStore::load_latest() const {
  return statements().load(statements().one(statements().newest));
}

std::optional<LoadedTables> TablesStore::load(std::int64_t number) const {
  return statements().load(statements().one(statements().by_number, number));
}

std::optional<LoadedTables> TablesStore::load(std::string_view id) const {
  if (auto given = statements().load(statements().one(statements().by_given_id, id))) return given;
  std::int64_t number = 0;
  std::from_chars(id.data(), id.data() + id.size(), number);
  auto loaded = load(number);
  if (loaded && loaded->revision.id != id) loaded.reset();
  return loaded;
}

Digest TablesStore::compute_digest(std::int64_t number) const {
  CanonicalDigest digest;
  statements().add(
      digest,
      "table_cells WHERE table_set = (SELECT table_set FROM table_revisions WHERE number = ?)",
      statements().cells, number);
  statements().add(digest, "custom_cells WHERE revision = ?", statements().custom, number);
  return digest.finish();
}

std::vector<TableRevision> TablesStore::list() const {
  std::vector<TableRevision> revisions;
  for (Rows rows = statements().all.query(); rows.next();) revisions.push_back(read_revision(rows));
  return revisions;
}

}  // namespace fitgauge::store
