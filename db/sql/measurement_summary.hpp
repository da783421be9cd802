#pragma once

#include "db/sql/index_nodes.hpp"
#include "db/sql/measurement_query.hpp"
#include "db/sql/statement.hpp"
#include "db/store/block_columns.hpp"
#include "db/store/measurement_index.hpp"
#include "db/store/measurement_row.hpp"
#include "db/store/measurement_statistics.hpp"
#include "db/store/tuple_statistics.hpp"

namespace fitgauge::store {

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
