#pragma once

#include "db/sql/index_nodes.hpp"
#include "db/sql/statement.hpp"
#include "db/store/block_columns.hpp"
#include "db/store/measurement_index.hpp"
#include "db/store/measurement_row.hpp"
#include "db/store/measurement_statistics.hpp"
#include "db/store/tuple_statistics.hpp"

namespace fitgauge::store {

/// Last id in blocks of the index; 0 if there is none.
std::int64_t indexed_to(sql::Statement& last_block);
sql::Statement last_block_statement(sql::Connection& connection);

/// The length that summaries and figures are of, in nm: at 20 °C if the row was corrected to it.
inline constexpr std::string_view kSummedLength = "coalesce(m.corrected_nm, m.measured_nm)";

/// Conditions for a row `m` that no correction replaces: no correction names the row, and no later
/// correction names the same record as the row or as a correction that the row goes back to.
/// @param last the last id that counts, or a parameter; occurs once in each condition.
struct CurrentCondition {
  std::string is_not_corrected;
  std::string has_no_later_rival;

  explicit CurrentCondition(std::string_view last);
};

/// Finds the measurements that match a filter, in either order. It reads all rows that are not yet
/// indexed; in indexed blocks it reads only rows with the requested values.
class MeasurementQuery {
 public:
  /// @param columns to select from the table `m`; the id follows them.
  MeasurementQuery(sql::Connection& connection, std::string columns);

  /// Called for each row; false ends the query.
  using Visitor = std::function<bool(const sql::Rows&)>;

  enum class BlockRead : std::uint8_t { Passed, Taken, Ended };
  /// Receives an indexed block that the index answers except for corrections: of its rows among
  /// `ids`, the rows in `rows` match. Passed: read and visit them one by one; Ended: end the query.
  using BlockReader =
      std::function<BlockRead(std::int64_t block, const RowSet& rows, const IdSpan& ids)>;

  /// Visits the matching rows among `ids`. @returns false if the visitor ended the query. Without
  /// any correction, rows are not checked for corrections.
  bool run(const MeasurementFilter& filter, const IdSpan& ids, ListOrder order,
           const Visitor& visit, const BlockReader& read_block = {});

  /// Visits the matching rows among these. @returns false if the visitor ended the query.
  bool run_each(const MeasurementFilter& filter, std::span<const std::int64_t> ids,
                const Visitor& visit);

 private:
  static std::vector<FieldValue> postings_of(const MeasurementFilter& filter);
  static bool is_source(const FieldValue& posting);

  /// The context of a query for its parts.
  struct Reading {
    const MeasurementFilter& filter;
    ListOrder order;
    const Visitor& visit;
    const BlockReader& read_block;  ///< empty if the index is not sufficient
    bool is_current = false;        ///< only rows that no other corrects now are asked for
  };
  using SpanReader = std::function<bool(const IdSpan& ids)>;

  bool asks_for_current(const MeasurementFilter& filter);
  sql::Statement& matching_rows(const MeasurementFilter& filter, ListOrder order);
  bool run_current(const Reading& reading, const IdSpan& ids);
  bool scan(sql::Statement& matching, const IdSpan& ids, ListOrder order, const Visitor& visit);
  bool run_indexed(const Reading& reading, sql::Statement& matching, const IdSpan& ids);
  bool visit_nodes(const Reading& reading, std::span<const FieldValue> postings, const IdSpan& ids,
                   const SpanReader& read);
  bool visit_node(const Reading& reading, std::span<const FieldValue> postings,
                  const IndexNode& node, const IdSpan& ids, const SpanReader& read);
  bool has_none(const Reading& reading, std::span<const FieldValue> postings,
                const IndexNode& node);
  bool run_noted(const Reading& reading, sql::Statement& matching, const IdSpan& ids);
  bool run_block(const Reading& reading, sql::Statement& matching, const IdSpan& ids,
                 const RowSet& rows, std::int64_t block);
  sql::Statement& matching_blocks(const Reading& reading, std::span<const FieldValue> postings,
                                  bool tells_inside);
  RowSet rows_in_block(const FieldValue& posting, std::int64_t block);
  sql::Statement& statement(const std::string& sql);

  sql::Connection& connection_;
  const std::string columns_;
  const std::int64_t most_at_once_;
  IndexNodes nodes_{connection_};
  sql::Statement last_block_{last_block_statement(connection_)};
  sql::Statement block_rows_{
      connection_,
      "SELECT rows FROM measurement_postings WHERE field = ? AND value = ? AND "
      "block = ?"};
  sql::Statement corrected_{
      connection_,
      "SELECT count(*) FROM (SELECT 1 FROM measurements WHERE correction_of IS NOT NULL "
      "AND id <= ? LIMIT 1) AS found"};
  std::map<std::string, sql::Statement> statements_;  ///< by their text
};

/// A query for a part of a log. In a folder with only its own rows, and before the first row of
/// another folder, a row's place is its id. After that, it is the origin and the place there.
struct LogQuery {
  LogQuery(sql::Connection& c, std::string_view columns)
      : by_id(c, fmt::format("SELECT {} FROM measurements WHERE id > ? AND id <= ? ORDER BY id "
                             "LIMIT ?",
                             columns)),
        by_place(c, fmt::format("SELECT {} FROM measurements WHERE origin = ? AND seq > ? ORDER BY "
                                "seq LIMIT ?",
                                columns)) {}

  /// @param alone up to this id all rows are of this folder. @returns the number of rows.
  template <class Visit>
  std::int64_t run(std::int64_t origin, std::int64_t alone, std::int64_t after, std::int64_t limit,
                   const Visit& visit) {
    std::int64_t count = 0;
    if (origin == 0 && after < alone) {
      for (sql::Rows rows = by_id.query(after, alone, limit); rows.next(); ++count) visit(rows);
      after += count;
    }
    if (count == limit || (origin == 0 && alone == kLastId)) return count;
    for (sql::Rows rows = by_place.query(origin, after, limit - count); rows.next(); ++count) {
      visit(rows);
    }
    return count;
  }

  sql::Statement by_id;
  sql::Statement by_place;
};

/// Summarises measurements by the values of one field. If the filter has only verdict, source,
/// times, this field, other fields and the designation, whole nodes of the index are added. Other
/// blocks are added by their columns, and only the newest rows and rows of few blocks are read one
/// by one.
class MeasurementSummary {
 public:
  MeasurementSummary(sql::Connection& connection, TextField group_by);

  /// @errors QueryInvalid when there are more than `max_groups` groups.
  Result<std::vector<SummaryGroup>> run(const MeasurementFilter& filter, std::size_t max_groups);

 private:
  struct Group {
    ExactStatistics statistics;
    std::array<std::int64_t, 5> verdicts{};  ///< by Verdict, Good first
  };

  void look_at_filter();
  bool is_rare(const FieldValue& wanted);
  void add_nodes();
  void add_node(const IndexNode& node);
  bool add_aggregates(const IndexNode& node);
  bool add_by_others(const IndexNode& node);
  bool add_pairs(const IndexNode& node);
  bool add_tuples(const IndexNode& node);
  bool add_sums(const IndexNode& node, const TupleColumn& groups);
  void add_later(const IdSpan& ids);
  void add_rows(const IdSpan& ids);
  bool add_row(const sql::Rows& rows);
  MeasurementQuery::BlockRead add_block(std::int64_t block, const RowSet& rows, const IdSpan& ids);
  void add_corrected_rows();
  void add(std::optional<std::string_view> value, Verdict verdict,
           const ExactStatistics& statistics);

  const TextField group_by_;
  sql::Connection& connection_;
  MeasurementQuery rows_;
  IndexNodes nodes_{connection_};
  sql::Statement last_block_{last_block_statement(connection_)};
  sql::Statement columns_{
      connection_,
      "SELECT c.bytes FROM measurement_nodes n JOIN measurement_columns c ON c.block = "
      "n.node WHERE n.level = 0 AND n.node = ? AND n.paired = 1"};
  sql::Statement blocks_of_value_{
      connection_,
      "SELECT count(*) FROM (SELECT 1 FROM measurement_postings WHERE field = ? "
      "AND value = ? LIMIT ?) AS found"};
  sql::Statement corrected_{
      connection_,
      fmt::format("SELECT correction_of FROM measurements WHERE correction_of IS NOT NULL "
                  "UNION SELECT m.id FROM measurements m WHERE m.id IN (SELECT id FROM "
                  "measurements WHERE correction_of IS NOT NULL) AND NOT {} ORDER BY 1",
                  CurrentCondition(std::to_string(kLastId)).has_no_later_rival)};

  // State of the summary that is being made.
  const MeasurementFilter* filter_ = nullptr;
  std::size_t max_groups_ = 0;
  bool fits_ = true;
  bool is_additive_ = true;         ///< nodes answer the filter
  std::vector<FieldValue> others_;  ///< by other fields than group_by
  IdSpan left_;                     ///< adjacent rows to read
  std::map<std::optional<std::string>, Group, std::less<>> groups_;
  std::vector<IdSpan> aggregated_;  ///< sums of nodes, without corrected rows
  std::vector<std::uint8_t> matching_tuples_;
  std::vector<ExactStatistics> tuple_sums_;
  BlockColumns block_;
  BlockColumns::Column groups_of_block_;
  std::vector<ExactStatistics> block_statistics_;
};

}  // namespace fitgauge::store
