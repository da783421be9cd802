#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "sqlite/statement.hpp"
#include "store/measurement_index.hpp"
#include "store/measurement_statistics.hpp"

namespace fitgauge::store {

/// What the index says of a node; derived from the measurements alone.
struct NodeIndex {
  std::int64_t min_measured_at = 0;
  std::int64_t max_measured_at = 0;
  std::int64_t min_received_at = 0;
  std::int64_t max_received_at = 0;

  /// By field and value; of a block, empty for other nodes.
  std::map<std::pair<int, std::string>, RowSet> postings;
  /// By field, value and kind (8 * source + verdict) of the rows that no other row corrects.
  using AggregateKey = std::tuple<int, std::optional<std::string>, int>;
  std::map<AggregateKey, ExactStatistics> aggregates;
};

/// Makes the index of the measurements: nodes, postings and aggregates. Used by the writer's
/// maintenance, and by the verifier to derive all of it again.
class MeasurementIndexer {
 public:
  explicit MeasurementIndexer(sqlite::Connection& connection);

  /// Indexes the next whole block with the nodes that it completes, or makes the aggregates of a
  /// stale node anew. @returns whether there was something to do.
  bool step();

  /// A row was corrected: its nodes' aggregates are stale until a step has made them anew.
  void corrected(std::int64_t id);

  /// Derives the whole index and calls `note` with each node that differs from what is stored.
  void verify(const std::function<void(std::string)>& note);

 private:
  void make_stale(std::int64_t id);
  NodeIndex derive(const IndexNode& node);
  NodeIndex derive_block(const IndexNode& node);
  NodeIndex derive_parent(const IndexNode& node);
  void aggregate_rows(const IndexNode& node, TextField field, NodeIndex& index);
  void insert(const IndexNode& node, const NodeIndex& index);
  void insert_aggregates(const IndexNode& node, const NodeIndex& index);
  bool is_stored(const IndexNode& node, const NodeIndex& index, bool stale);

  sqlite::Connection& connection_;
  sqlite::Statement last_block_;
  sqlite::Statement newest_;
  sqlite::Statement block_;
  sqlite::Statement insert_node_;
  sqlite::Statement insert_posting_;
  sqlite::Statement insert_aggregate_;
  sqlite::Statement child_times_;
  sqlite::Statement child_aggregates_;
  sqlite::Statement make_stale_;
  sqlite::Statement rivals_;
  sqlite::Statement stale_;
  sqlite::Statement delete_aggregates_;
  sqlite::Statement make_fresh_;
  sqlite::Statement nodes_;
  sqlite::Statement posting_;
  sqlite::Statement node_aggregates_;
};

}  // namespace fitgauge::store
