#pragma once

#include "db/sql/index_nodes.hpp"
#include "db/sql/statement.hpp"
#include "db/store/measurement_index.hpp"
#include "db/store/measurement_statistics.hpp"

namespace fitgauge::store {

/// Statistics of a node, derived only from the measurements.
struct NodeIndex {
  std::int64_t min_measured_at = 0;
  std::int64_t max_measured_at = 0;
  std::int64_t min_received_at = 0;
  std::int64_t max_received_at = 0;

  /// Rows of a block by field and value; empty for other nodes.
  std::map<std::pair<int, std::string>, RowSet> postings;
  /// Field, value and kind (8 * source + verdict) of the rows that no other row corrects.
  using AggregateKey = std::tuple<int, std::optional<std::string>, int>;
  std::map<AggregateKey, ExactStatistics> aggregates;
  /// Values of a block as store::ValueBlock reads them. None for nodes above blocks, and if a row
  /// is a correction or belongs to another folder.
  std::optional<std::string> values;
  PairIndex::Node pairs;
};

/// Makes the index of the measurements: nodes, postings, aggregates, values and pairs. The writer's
/// maintenance uses it, and the verifier derives all of the index again with it.
class MeasurementIndexer {
 public:
  explicit MeasurementIndexer(sql::Connection& connection);

  /// Does one step: updates a stale node, or indexes the next whole block with the nodes that it
  /// completes, or adds missing parts to a node of an earlier release.
  /// @returns whether there was something to do.
  bool step();

  /// A row was corrected: its nodes' aggregates are stale until a step has made them anew.
  void corrected(std::int64_t id);

  /// Derives the whole index and calls `note` with each node that differs from the stored one.
  void verify(const std::function<void(std::string)>& note);

 private:
  static std::optional<IndexNode> first_of(sql::Statement& nodes);
  void make_stale(std::int64_t id);
  void renew(const IndexNode& node);
  NodeIndex derive(const IndexNode& node);
  NodeIndex derive_block(const IndexNode& node);
  NodeIndex derive_parent(const IndexNode& node);
  void aggregate_rows(const IndexNode& node, TextField field, NodeIndex& index);
  void insert(const IndexNode& node, const NodeIndex& index);
  void insert_sums(const IndexNode& node, const NodeIndex& index);
  bool is_stored(const IndexNode& node, const NodeIndex& index, bool stale);

  sql::Connection& connection_;
  PairIndex pairs_;
  sql::Statement last_block_;
  sql::Statement block_;
  sql::Statement corrected_;
  sql::Statement stands_;
  sql::Statement insert_node_;
  sql::RowsInsert insert_postings_;
  sql::Statement insert_values_;
  sql::Statement insert_aggregate_;
  sql::Statement child_times_;
  sql::Statement child_aggregates_;
  sql::Statement make_stale_;
  sql::Statement rivals_;
  sql::Statement stale_;
  sql::Statement unpaired_;
  sql::Statement delete_aggregates_;
  sql::Statement make_fresh_;
  sql::Statement nodes_;
  sql::Statement posting_;
  sql::Statement values_;
  sql::Statement node_aggregates_;
  sql::Statement count_postings_;
  sql::Statement count_values_;
};

}  // namespace fitgauge::store
