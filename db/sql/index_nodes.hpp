#pragma once

#include "db/sql/statement.hpp"
#include "db/store/measurement_index.hpp"
#include "db/store/tuple_statistics.hpp"

namespace fitgauge::store {

/// Field value of aggregates over rows without that field: NULL, or 0 if the engine's keys cannot
/// be NULL.
struct AggregatedValue {
  std::string_view is_none;
  std::string_view parameter;

  explicit AggregatedValue(const sql::Connection& connection);
};

/// A value that is asked for, of a field as the index numbers them.
struct FieldValue {
  int field = 0;
  std::string value;
};

/// Whether measurements of this kind (8 * source + verdict) are asked for.
bool is_asked(const MeasurementFilter& filter, int kind);
Verdict verdict_of(int kind);

/// Statistics of the nodes of the index, without their blocks.
class IndexNodes {
 public:
  explicit IndexNodes(sql::Connection& connection) : connection_(connection) {}

  /// Relation of a node's times to the times of the filter.
  enum class Times : std::uint8_t { Outside, Inside, Partly };
  struct Found {
    Times times = Times::Partly;
    bool has_aggregates = false;  ///< of its current rows
    bool has_pairs = false;       ///< and tuples
  };
  /// @returns none if there is no such node
  std::optional<Found> find(const IndexNode& node, const MeasurementFilter& filter);

  /// Returns true if surely no current row of the wanted kinds has all these values.
  /// @pre node.level > 0
  bool lacks(const IndexNode& node, std::span<const FieldValue> values,
             const MeasurementFilter& filter);

  /// Returns rows of value, kind, statistics and whether the value is absent, for all values or for
  /// one. The absent value has a row only if some rows lack the field or the field has aggregates.
  sql::Rows aggregates(const IndexNode& node, int field);
  sql::Rows aggregates(const IndexNode& node, int field, std::string_view value);

  /// Returns at most one row: the entry of PairIndex for the two fields.
  sql::Rows pairs(const IndexNode& node, int field, int by_field);

  /// @param bytes storage of the column, which is a view of it
  std::optional<TupleColumn> column(const IndexNode& node, int field, std::string& bytes);

 private:
  bool lacks(const IndexNode& node, const FieldValue& wanted, const MeasurementFilter& filter);

  sql::Connection& connection_;
  sql::Statement node_{
      connection_,
      "SELECT min_measured_at, max_measured_at, min_received_at, max_received_at, stale, "
      "paired FROM measurement_nodes WHERE level = ? AND node = ?"};
  sql::Statement aggregates_{
      connection_, fmt::format("SELECT value, kind, statistics, {} FROM measurement_aggregates "
                               "WHERE level = ? AND node = ? AND field = ?",
                               AggregatedValue(connection_).is_none)};
  sql::Statement aggregates_of_value_{
      connection_,
      "SELECT value, kind, statistics, 0 FROM measurement_aggregates "
      "WHERE level = ? AND node = ? AND field = ? AND value = ?"};
  sql::Statement pairs_{
      connection_,
      "SELECT bytes FROM measurement_pairs WHERE level = ? AND field = ? AND by_field = ? "
      "AND node = ?"};
  std::vector<std::uint8_t> matching_;  ///< tuples
};

/// Index of the values of several fields. A block has its columns (store::BlockColumns). A node
/// above blocks has the statistics of one field by the values of another (store::PairStatistics),
/// if the values are few, or by the values of many fields together (store::TupleSums). Tuples are
/// stored like pairs: the column of a field at the key of the field and no field, and the sums at
/// the keys of no field and a number: 0 for the first kTuplesTogether, 1 for the next, and so on.
/// Without tuples 0 is empty.
class PairIndex {
 public:
  /// The stored parts of a node.
  struct Node {
    bool is_complete = true;               ///< false: the nodes below have not got theirs yet
    std::optional<std::string> columns{};  ///< of a block
    std::map<std::pair<int, int>, std::string> pairs{};  ///< of others, by the two fields
  };

  static constexpr int kSums = 0;     ///< the field of tuples' sums
  static constexpr int kColumns = 0;  ///< key of their columns

  explicit PairIndex(sql::Connection& connection) : connection_(connection) {}

  /// Builds it from the stored nodes below. @pre node.level > 0
  Node derive(const IndexNode& node);
  void insert(const IndexNode& node, const Node& index);
  void erase(const IndexNode& node);

  bool is_stored(const IndexNode& node, const Node& index);
  /// Returns the number of stored entries whose nodes do not exist.
  std::int64_t count_surplus();

 private:
  void derive_from_columns(const IndexNode& node, Node& index);
  void derive_from_pairs(const IndexNode& node, Node& index);
  void join_tuples(const IndexNode& node, Node& index);
  void add_column(const IndexNode& node, std::size_t column, NumberedColumn& all);
  template <class Visit>
  bool visit_sums(const IndexNode& node, const Visit& visit);

  sql::Connection& connection_;
  sql::Statement columns_{connection_, "SELECT bytes FROM measurement_columns WHERE block = ?"};
  sql::Statement insert_columns_{connection_, "INSERT INTO measurement_columns VALUES (?, ?)"};
  sql::Statement delete_columns_{connection_, "DELETE FROM measurement_columns WHERE block = ?"};
  sql::Statement child_pairs_{
      connection_,
      "SELECT bytes FROM measurement_pairs WHERE level = ? AND field = ? AND "
      "by_field = ? AND node BETWEEN ? AND ? ORDER BY node"};
  sql::Statement pair_{
      connection_,
      "SELECT bytes FROM measurement_pairs WHERE level = ? AND field = ? AND by_field = ? "
      "AND node = ?"};
  sql::Statement insert_pair_{connection_, "INSERT INTO measurement_pairs VALUES (?, ?, ?, ?, ?)"};
  sql::Statement delete_pair_{
      connection_,
      "DELETE FROM measurement_pairs WHERE level = ? AND field = ? AND by_field = ? "
      "AND node = ?"};
  sql::Statement count_surplus_columns_{
      connection_,
      "SELECT count(*) FROM measurement_columns c WHERE NOT EXISTS (SELECT "
      "1 FROM measurement_nodes n WHERE n.level = 0 AND n.node = c.block)"};
  sql::Statement count_surplus_pairs_{
      connection_,
      "SELECT count(*) FROM measurement_pairs p WHERE p.level = 0 OR NOT EXISTS (SELECT 1 "
      "FROM measurement_nodes n WHERE n.level = p.level AND n.node = p.node)"};
};

}  // namespace fitgauge::store
