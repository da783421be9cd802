#include "db/store/tables_store.hpp"

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"
#include "db/store/canonical_digest.hpp"

namespace fitgauge::store {
namespace {

using sql::Rows;

bool is_sorted(const TableContent& content) {
  return std::ranges::is_sorted(content.cells) && std::ranges::is_sorted(content.custom);
}

TableContent sorted(TableContent content) {
  std::ranges::sort(content.cells);
  std::ranges::sort(content.custom);
  return content;
}

bool is_valid(const TableCell& cell) { return cell.over_nm >= 0 && cell.over_nm < cell.up_to_nm; }
bool is_valid(const CustomCell& cell) {
  return cell.over_nm >= 0 && cell.over_nm < cell.up_to_nm && cell.lower_nm <= cell.upper_nm;
}

/// The first cell of a sorted list that is invalid or begins at the size of the previous cell.
template <class Cell>
const Cell* first_invalid(const std::vector<Cell>& cells) {
  const Cell* before = nullptr;
  for (const Cell& cell : cells) {
    const bool twice = before != nullptr && before->table == cell.table &&
                       before->column == cell.column && before->over_nm == cell.over_nm;
    if (twice || !is_valid(cell)) return &cell;
    before = &cell;
  }
  return nullptr;
}

template <class Cell>
Error invalid(const Cell& cell) {
  return {ErrorCode::TableRowsInvalid,
          "a size range is repeated or empty, or its lower deviation is above its upper deviation",
          fmt::format("{} {} over {} nm up to {} nm", cell.table, cell.column, cell.over_nm,
                      cell.up_to_nm)};
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

struct TablesStore::Statements {
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

  std::optional<LoadedTables> load(std::optional<TableRevision> revision) {
    if (!revision) return std::nullopt;
    LoadedTables loaded{.revision = *std::move(revision), .content = {}, .computed = {}};
    loaded.content = {read_all<TableCell>(cells.query(loaded.revision.number)),
                      read_all<CustomCell>(custom.query(loaded.revision.number))};
    loaded.computed = digest_of(loaded.content);
    return loaded;
  }

  /// The set with exactly these cells, stored now if it was not.
  std::int64_t set_of(const std::vector<TableCell>& list) {
    const Digest digest = digest_of({.cells = list, .custom = {}});
    if (const auto known = read_first<std::int64_t>(set_by_digest.query(digest))) return *known;
    const auto set = insert_set.returning<std::int64_t>(digest);
    for (const TableCell& cell : list) {
      insert_cell.run(set, cell.table, cell.column, cell.over_nm, cell.up_to_nm, cell.value_nm);
    }
    return set;
  }
};

std::string shown_digits(const Digest& digest) { return to_hex(digest).substr(0, kShownDigits); }

Digest digest_of(const TableContent& content) {
  if (!is_sorted(content)) return digest_of(sorted(content));  // stored cells come sorted
  CanonicalDigest digest;
  const auto add = [&digest](const auto& cells) {
    digest.add(cells.size());
    for (const auto& cell : cells) {
      boost::pfr::for_each_field(cell, [&digest](const auto& member) { digest.add(member); });
    }
  };
  add(content.cells);
  add(content.custom);
  return digest.finish();
}

TablesStore::TablesStore(sql::Connection& connection)
    : statements_(std::make_shared<Statements>(connection)) {}

Result<TableRevision> TablesStore::import(const TableImport& tables, std::int64_t now_ns) {
  const std::optional<TableRevision> newest = statements_->one(statements_->newest);
  const std::optional<std::int64_t> in_force =
      newest ? std::optional(newest->number) : std::nullopt;
  if (tables.parent != in_force) {
    return Error{
        ErrorCode::PreconditionFailed,
        fmt::format("the current tables are revision {}: read them again and repeat the change",
                    newest ? newest->id : "none")};
  }
  const TableContent content = sorted(tables.content);
  if (const TableCell* cell = first_invalid(content.cells)) return invalid(*cell);
  if (const CustomCell* cell = first_invalid(content.custom)) return invalid(*cell);

  const std::int64_t set = statements_->set_of(content.cells);
  const auto number = statements_->insert_revision.returning<std::int64_t>(
      digest_of(content), set, tables.source, now_ns, tables.parent, tables.caller);
  for (const CustomCell& cell : content.custom) {
    statements_->insert_custom.run(number, cell.table, cell.column, cell.over_nm, cell.up_to_nm,
                                   cell.upper_nm, cell.lower_nm);
  }
  if (tables.id) statements_->insert_id.run(number, *tables.id);
  return *statements_->one(statements_->by_number, number);
}

std::optional<LoadedTables> TablesStore::load_latest() const {
  return statements_->load(statements_->one(statements_->newest));
}

std::optional<LoadedTables> TablesStore::load(std::int64_t number) const {
  return statements_->load(statements_->one(statements_->by_number, number));
}

std::optional<LoadedTables> TablesStore::load(std::string_view id) const {
  if (auto given = statements_->load(statements_->one(statements_->by_given_id, id))) return given;
  std::int64_t number = 0;
  std::from_chars(id.data(), id.data() + id.size(), number);
  auto loaded = load(number);
  if (loaded && loaded->revision.id != id) loaded.reset();
  return loaded;
}

Digest TablesStore::compute_digest(std::int64_t number) const {
  CanonicalDigest digest;
  statements_->add(
      digest,
      "table_cells WHERE table_set = (SELECT table_set FROM table_revisions WHERE number = ?)",
      statements_->cells, number);
  statements_->add(digest, "custom_cells WHERE revision = ?", statements_->custom, number);
  return digest.finish();
}

std::vector<TableRevision> TablesStore::list() const {
  std::vector<TableRevision> revisions;
  for (Rows rows = statements_->all.query(); rows.next();) revisions.push_back(read_revision(rows));
  return revisions;
}

}  // namespace fitgauge::store
