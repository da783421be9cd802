#include "db/store/measurements_store.hpp"

#include "db/sql/connection.hpp"
#include "db/sql/measurement_indexer.hpp"
#include "db/sql/measurement_query.hpp"
#include "db/sql/statement.hpp"
#include "db/store/block_columns.hpp"
#include "db/store/measurement_row.hpp"

namespace fitgauge::store {
namespace {

using sql::Blob;
using sql::Rows;
using sql::Statement;

MeasurementRow read_row(const Rows& rows) {
  MeasurementRow row;
  int column = 0;
  row.id = rows.get<std::int64_t>(column);
  for_each_field(row, [&](std::string_view /*column*/, auto& value) {
    value = rows.get<std::remove_reference_t<decltype(value)>>(++column);
  });
  row.hash = rows.get<Digest>(++column);
  return row;
}

constexpr std::string_view kValueColumns =
    "m.nominal_nm + m.lower_deviation_nm, m.nominal_nm + m.upper_deviation_nm, m.subgroup, ";
constexpr std::string_view kPlaceColumns =
    "coalesce(m.origin, 0), CASE WHEN m.origin > 0 THEN coalesce(m.number, m.seq) ELSE m.id END";
/// Columns of the place if every row is of this folder: columns at the far end are slow to read.
constexpr std::string_view kOwnPlaceColumns = "0, m.id";

/// Counts the rows of a page.
class Page {
 public:
  explicit Page(std::size_t limit) : limit_(limit) {}

  /// @returns whether the row `id` is part of the page; a row after it means a next page.
  bool take(std::int64_t id) {
    more_ = count_++ == limit_;
    if (!more_) last_ = id;
    return !more_;
  }
  /// The cursor for the next page, or none when this was the last.
  std::optional<std::int64_t> next() const { return more_ ? std::optional(last_) : std::nullopt; }

 private:
  const std::size_t limit_;
  std::size_t count_ = 0;
  std::int64_t last_ = 0;
  bool more_ = false;
};

}  // namespace

template <>
struct StatementsOf<MeasurementsStore> {
  sql::Connection& connection;
  sql::MeasurementTable& table{connection.measurements()};
  Statement by_id{connection,
                  fmt::format("SELECT {} FROM measurements WHERE id = ?", measurement_columns())};
  Statement correction{connection,
                       "SELECT id FROM measurements WHERE correction_of = ? "
                       "ORDER BY received_at DESC, hash DESC LIMIT 1"};
  Statement lost_target{
      connection, fmt::format("SELECT correction_of FROM measurements m WHERE id = ? AND NOT {}",
                              CurrentCondition(std::to_string(kLastId)).has_no_later_rival)};
  Statement corrections{connection, "SELECT count(*) FROM measurements WHERE correction_of = ?"};
  Statement all_corrections{connection,
                            "SELECT id, correction_of FROM measurements WHERE correction_of IS NOT "
                            "NULL AND id <= ?"};
  Statement hand_on{
      connection,
      "WITH RECURSIVE back(target, origin) AS (SELECT correction_of, origin FROM "
      "measurements WHERE id = ?1 UNION ALL SELECT m.correction_of, m.origin FROM back "
      "JOIN measurements m ON m.id = back.target) INSERT INTO revisions (tag, kind, name, "
      "station) SELECT randomblob(8), 5, ?1, origin FROM back WHERE target IS NULL AND "
      "origin > 0"};
  Statement revision{connection,
                     "SELECT 1 FROM table_revisions WHERE number = ?1 UNION ALL "
                     "SELECT 1 FROM origin_revisions WHERE number = -?1"};
  Statement first_forwarded{connection, "SELECT min(first_row) FROM origins"};
  Statement forked{connection, "SELECT reason FROM log_marks WHERE mark = 'forked'"};
  Statement newest_of_own{connection, "SELECT max(seq) FROM measurements WHERE origin = 0"};
  Statement by_number{connection, "SELECT id FROM measurements WHERE origin = ? AND number = ?"};
  Statement by_place{connection,
                     "SELECT id FROM measurements WHERE origin = ? AND seq = ? AND number IS NULL"};
  LogQuery log_rows{connection, measurement_columns()};
  LogQuery log_hashes{connection, "hash"};
  MeasurementIndexer indexer{connection};
  MeasurementQuery whole_rows{connection, measurement_columns()};
  MeasurementQuery values{
      connection, fmt::format("m.id, {}, {}{}", kSummedLength, kValueColumns, kPlaceColumns)};
  MeasurementQuery own_values{
      connection, fmt::format("m.id, {}, {}{}", kSummedLength, kValueColumns, kOwnPlaceColumns)};
  Statement block_values{connection, "SELECT bytes FROM measurement_values WHERE block = ?"};
  Statement corrected_among{connection,
                            "SELECT count(*) FROM (SELECT 1 FROM measurements WHERE correction_of "
                            "BETWEEN ? AND ? LIMIT 1) AS found"};
  Statement forwarded_rows{
      connection,
      "SELECT count(*) FROM (SELECT 1 FROM measurements WHERE origin IS NOT NULL "
      "LIMIT 1) AS found"};
  MeasurementQuery ids{connection, "m.id"};

  /// If two folders continue one history, their rows would get the same ids.
  Result<void> require_one_history() {
    if (connection.dialect().is_shared) return {};  // no folder, and nothing is forwarded from it
    auto why = read_first<std::string>(forked.query());
    return why ? Error{ErrorCode::LogForked, *std::move(why)} : Result<void>();
  }

  /// A row whose revision is missing is a bug of the caller. Revisions are never deleted, so a
  /// revision that was seen exists.
  void require_revision(std::int64_t number) {
    if (number == seen_revision) return;
    if (!revision.query(number).next()) {
      throw std::logic_error(fmt::format("table revision not found: {}", number));
    }
    seen_revision = number;
  }

  /// Up to this id all rows are of this folder.
  std::int64_t alone() {
    const auto first = first_forwarded.returning<std::optional<std::int64_t>>();
    return first ? *first - 1 : kLastId;
  }

  std::int64_t own_rows(std::int64_t first_others) {
    return newest_of_own.returning<std::optional<std::int64_t>>().value_or(first_others);
  }

  /// Whether there are rows of other folders: final, once others cannot add the first.
  bool holds_others() {
    if (may_hold_others || connection.dialect().is_shared) may_hold_others = alone() != kLastId;
    return may_hold_others;
  }

  /// Numbers rows of this folder in its log, if there are rows of others between them.
  std::vector<MeasurementRow> numbered(std::span<const MeasurementRow> rows) {
    std::vector<MeasurementRow> numbered(rows.begin(), rows.end());
    std::int64_t place = own_rows(alone());
    for (MeasurementRow& row : numbered) {
      row.origin = 0;
      row.seq = ++place;
    }
    return numbered;
  }

  std::map<TextField, MeasurementSummary> summaries;  ///< each made at its first use
  std::optional<std::int64_t> seen_revision;
  bool may_hold_others = true;  ///< of the writer's: no other connection appends
};

Result<void> MeasurementsStore::append(std::span<const MeasurementRow> rows) {
  TRY(statements().require_one_history());
  for (const MeasurementRow& row : rows) {
    if (const auto of = row.correction_of) {
      if (!statements().by_id.query(*of).next()) {
        return Error{ErrorCode::MeasurementUnknown, fmt::format("measurement not found: {}", *of)};
      }
      if (replaced_by(*of)) {
        return Error{
            ErrorCode::MeasurementCorrected,
            fmt::format("measurement {} has a correction: correct the current measurement", *of)};
      }
    }
    if (row.table_revision) statements().require_revision(*row.table_revision);
  }
  if (!statements().table.own_rows() && statements().holds_others()) {
    statements().table.append(statements().numbered(rows));
  } else {
    statements().table.append(rows);
  }
  for (const MeasurementRow& row : rows) {
    if (!row.correction_of) continue;
    statements().indexer.corrected(*row.correction_of);
    if (statements().holds_others()) statements().hand_on.run(row.id);
  }
  return {};
}

void MeasurementsStore::append_forwarded(std::span<const MeasurementRow> rows) {
  statements().may_hold_others = true;
  statements().table.append(rows);
  for (const MeasurementRow& row : rows) {
    if (row.correction_of) statements().indexer.corrected(*row.correction_of);
  }
}

std::optional<std::int64_t> MeasurementsStore::find_forwarded(std::int64_t origin,
                                                              std::int64_t number) const {
  for (Statement* by : {&statements().by_number, &statements().by_place}) {
    if (const auto id = read_first<std::int64_t>(by->query(origin, number))) return id;
  }
  return std::nullopt;
}

void MeasurementsStore::list_log(std::int64_t origin, std::int64_t after, std::int64_t limit,
                                 const Visitor& visit) const {
  statements().log_rows.run(origin, statements().alone(), after, limit,
                            [&](const Rows& rows) { visit(read_row(rows)); });
}

std::int64_t MeasurementsStore::log_hashes(std::int64_t origin, std::int64_t after,
                                           std::int64_t limit, const HashVisitor& visit) const {
  return statements().log_hashes.run(origin, statements().alone(), after, limit,
                                     [&](const Rows& rows) { visit(rows.get<Digest>(0)); });
}

bool MeasurementsStore::find(std::int64_t id, const Visitor& visit) const {
  Rows rows = statements().by_id.query(id);
  if (!rows.next()) return false;
  visit(read_row(rows));
  return true;
}

std::optional<std::int64_t> MeasurementsStore::corrected_by(std::int64_t id) const {
  return read_first<std::int64_t>(statements().correction.query(id));
}

std::optional<std::int64_t> MeasurementsStore::replaced_by(std::int64_t id) const {
  if (const auto newer = corrected_by(id)) return newer;
  const auto target = read_first<std::int64_t>(statements().lost_target.query(id));
  return target ? corrected_by(*target) : std::nullopt;
}

bool MeasurementsStore::has_rivals(std::int64_t correction_of) const {
  return statements().corrections.returning<std::int64_t>(correction_of) > 1;
}

std::optional<std::int64_t> MeasurementsStore::list(const MeasurementFilter& filter,
                                                    std::int64_t after, std::size_t limit,
                                                    const Visitor& visit, ListOrder order) const {
  IdSpan ids{.first = 1, .last = kLastId};
  if (order == ListOrder::NewestFirst) {
    if (after > 0) ids.last = after - 1;
  } else {
    if (after == kLastId) return std::nullopt;
    ids.first = after + 1;
  }
  Page page(limit);
  statements().whole_rows.run(filter, ids, order, [&](const Rows& rows) {
    if (!page.take(rows.get<std::int64_t>(0))) return false;
    visit(read_row(rows));
    return true;
  });
  return page.next();
}

std::optional<std::int64_t> MeasurementsStore::list_values(const MeasurementFilter& filter,
                                                           std::int64_t after, std::size_t limit,
                                                           const RunVisitor& visit) const {
  if (after == kLastId) return std::nullopt;
  const IdSpan ids{.first = after + 1, .last = kLastId};
  const bool all_own = statements().forwarded_rows.returning<std::int64_t>() == 0;
  MeasurementQuery& values = all_own ? statements().own_values : statements().values;
  Page page(limit);
  const auto take = [&](MeasuredRun run) {
    std::size_t fitting = 0;
    while (fitting < run.values.size() && page.take(run.values[fitting].id)) ++fitting;
    const bool all = fitting == run.values.size();
    run.values = run.values.first(fitting);
    if (fitting > 0) visit(run);
    return all;
  };
  const auto take_row = [&](const Rows& rows) {
    const MeasuredRun::Value value{.id = rows.get<std::int64_t>(0),
                                   .number = rows.get<std::int64_t>(6),
                                   .measured_nm = rows.get<std::int64_t>(1)};
    return take({.lower_limit_nm = rows.get<std::int64_t>(2),
                 .upper_limit_nm = rows.get<std::int64_t>(3),
                 .subgroup = rows.get<std::optional<std::string_view>>(4),
                 .origin = rows.get<std::int64_t>(5),
                 .values = {&value, 1}});
  };
  ValueBlock block;
  const auto take_block = [&](std::int64_t node, const RowSet& rows, const IdSpan& among) {
    using BlockRead = MeasurementQuery::BlockRead;
    const IdSpan whole = IndexNode{0, node}.ids();
    const bool is_whole = filter.history || statements().corrected_among.returning<std::int64_t>(
                                                whole.first, whole.last) == 0;
    Rows found = statements().block_values.query(node);
    if (!is_whole || !found.next() || !block.read(found.get<Blob>(0).bytes)) {
      return BlockRead::Passed;
    }
    return block.visit_runs(rows, whole.first, among, take) ? BlockRead::Taken : BlockRead::Ended;
  };
  values.run(filter, ids, ListOrder::OldestFirst, take_row, take_block);
  return page.next();
}

void MeasurementsStore::list_corrections(std::int64_t last, const CorrectionVisitor& visit) const {
  for (Rows rows = statements().all_corrections.query(last); rows.next();) {
    visit(rows.get<std::int64_t>(0), rows.get<std::int64_t>(1));
  }
}

std::optional<std::int64_t> MeasurementsStore::first_of_newest(const MeasurementFilter& filter,
                                                               std::size_t count) const {
  std::optional<std::int64_t> first;
  const IdSpan all{.first = 1, .last = kLastId};
  statements().ids.run(filter, all, ListOrder::NewestFirst, [&](const Rows& rows) {
    first = rows.get<std::int64_t>(0);
    return --count > 0;
  });
  return first;
}

bool MeasurementsStore::index_step() { return statements().indexer.step(); }

void MeasurementsStore::verify_index(const std::function<void(std::string)>& note) const {
  statements().indexer.verify(note);
}

std::int64_t MeasurementsStore::log_size() const {
  if (const auto counted = statements().table.own_rows()) return *counted;
  const std::int64_t others = statements().alone();
  return others != kLastId ? statements().own_rows(others) : last_id();
}

std::int64_t MeasurementsStore::last_id() const { return statements().table.last_id(); }

std::optional<Timestamp> MeasurementsStore::newest_received_at() const {
  std::optional<Timestamp> newest;
  find(last_id(), [&](const MeasurementRow& row) { newest = Timestamp{row.received_at_ns}; });
  return newest;
}

Result<std::vector<SummaryGroup>> MeasurementsStore::summary(const MeasurementFilter& filter,
                                                             TextField group_by,
                                                             std::size_t max_groups) const {
  auto& summaries = statements().summaries;
  const auto made = summaries.try_emplace(group_by, statements().connection, group_by).first;
  return made->second.run(filter, max_groups);
}

}  // namespace fitgauge::store
