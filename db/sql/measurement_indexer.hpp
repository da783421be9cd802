#pragma once

#include "db/sql/measurement_query.hpp"
#include "db/store/measurement_statistics.hpp"

namespace fitgauge::store {

/// First and last times of a node's rows; its members are columns in their order (sql::row_of).
struct NodeTimes {
  std::int64_t min_measured_at = 0;
  std::int64_t max_measured_at = 0;
  std::int64_t min_received_at = 0;
  std::int64_t max_received_at = 0;

  friend bool operator==(const NodeTimes&, const NodeTimes&) = default;
};

/// Statistics of a node, derived only from the measurements.
struct NodeIndex {
  NodeTimes times;
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
  PairIndex pairs_{connection_};
  sql::Statement last_block_{last_block_statement(connection_)};
  sql::Statement block_;
  sql::Statement corrected_{
      connection_, "SELECT correction_of FROM measurements WHERE correction_of BETWEEN ? AND ?"};
  sql::Statement stands_{connection_,
                         fmt::format("SELECT count(*) FROM measurements m WHERE m.id = ? AND {}",
                                     CurrentCondition(std::to_string(kLastId)).has_no_later_rival)};
  sql::Statement insert_node_{connection_,
                              "INSERT INTO measurement_nodes VALUES (?, ?, ?, ?, ?, ?, 0, ?)"};
  sql::RowsInsert insert_postings_{connection_, "INSERT INTO measurement_postings VALUES ",
                                   "(?, ?, ?, ?)"};
  sql::Statement insert_values_{connection_, "INSERT INTO measurement_values VALUES (?, ?)"};
  sql::Statement insert_aggregate_{
      connection_, fmt::format("INSERT INTO measurement_aggregates VALUES (?, ?, ?, {}, ?, ?)",
                               AggregatedValue(connection_).parameter)};
  sql::Statement child_times_{
      connection_,
      "SELECT min(min_measured_at), max(max_measured_at), min(min_received_at), "
      "max(max_received_at), min(paired) FROM measurement_nodes WHERE level = ? AND "
      "node BETWEEN ? AND ?"};
  sql::Statement child_aggregates_{
      connection_, fmt::format("SELECT node, field, value, kind, statistics, {} FROM "
                               "measurement_aggregates WHERE level = ? AND node BETWEEN ? "
                               "AND ? ORDER BY node",
                               AggregatedValue(connection_).is_none)};
  sql::Statement make_stale_{
      connection_,
      "UPDATE measurement_nodes SET stale = 1, paired = 0 WHERE level = ? AND node = ?"};
  sql::Statement rivals_{
      connection_,
      "WITH RECURSIVE back(id) AS (SELECT id FROM measurements WHERE correction_of = ?1 AND "
      "(SELECT count(*) FROM measurements WHERE correction_of = ?1) > 1 UNION ALL "
      "SELECT c.id FROM back JOIN measurements c ON c.correction_of = back.id) "
      "SELECT id FROM back"};
  sql::Statement stale_{
      connection_,
      "SELECT level, node FROM measurement_nodes WHERE stale = 1 ORDER BY level, node "
      "LIMIT 1"};
  sql::Statement unpaired_{
      connection_,
      "SELECT level, node FROM measurement_nodes WHERE paired = 0 ORDER BY level, node "
      "LIMIT 1"};
  sql::Statement delete_aggregates_{
      connection_, "DELETE FROM measurement_aggregates WHERE level = ? AND node = ?"};
  sql::Statement make_fresh_{
      connection_,
      "UPDATE measurement_nodes SET stale = 0, paired = ? WHERE level = ? AND node = ?"};
  sql::Statement nodes_{
      connection_,
      "SELECT min_measured_at, max_measured_at, min_received_at, max_received_at, level, node, "
      "stale, paired FROM measurement_nodes ORDER BY level, node"};
  sql::Statement posting_{
      connection_,
      "SELECT rows FROM measurement_postings WHERE field = ? AND value = ? AND block = ?"};
  sql::Statement values_{connection_, "SELECT bytes FROM measurement_values WHERE block = ?"};
  sql::Statement node_aggregates_{connection_,
                                  fmt::format("SELECT field, value, kind, statistics, {} FROM "
                                              "measurement_aggregates WHERE level = ? AND node = ?",
                                              AggregatedValue(connection_).is_none)};
  sql::Statement count_postings_{connection_, "SELECT count(*) FROM measurement_postings"};
  sql::Statement count_values_{connection_, "SELECT count(*) FROM measurement_values"};
};

}  // namespace fitgauge::store
