#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "db/sql/statement.hpp"
#include "db/store/measurement_filter.hpp"
#include "db/store/measurement_index.hpp"
#include "db/store/tuple_statistics.hpp"

namespace fitgauge::store {

/// A value that is asked for, of a field as the index numbers them.
struct FieldValue {
  int field = 0;
  std::string value;
};

/// Whether measurements of this kind (8 * source + verdict) are asked for.
bool is_asked(const MeasurementFilter& filter, int kind);
Source source_of(int kind);
Verdict verdict_of(int kind);

/// What the nodes of the index say without their blocks being read.
class IndexNodes {
 public:
  explicit IndexNodes(sql::Connection& connection);

  /// How a node's times lie to those the filter asks for.
  enum class Times : std::uint8_t { Outside, Inside, Partly };
  struct Found {
    Times times = Times::Partly;
    bool has_aggregates = false;  ///< of its current rows
    bool has_pairs = false;       ///< and tuples
  };
  /// @returns none where there is no such node
  std::optional<Found> find(const IndexNode& node, const MeasurementFilter& filter);

  /// Whether it is known that no current row of the kinds asked for has all these values.
  /// @pre node.level > 0
  bool lacks(const IndexNode& node, std::span<const FieldValue> values,
             const MeasurementFilter& filter);

  /// Rows of value, kind, statistics and whether there is no value: of all values, or of one, which
  /// has none where the field has none either or where it has aggregates at all.
  sql::Rows aggregates(const IndexNode& node, int field);
  sql::Rows aggregates(const IndexNode& node, int field, std::string_view value);

  /// At most a row: what PairIndex keeps of the two fields.
  sql::Rows pairs(const IndexNode& node, int field, int by_field);

  /// @param bytes what the column is a view of
  std::optional<TupleColumn> column(const IndexNode& node, int field, std::string& bytes);

 private:
  bool lacks(const IndexNode& node, const FieldValue& wanted, const MeasurementFilter& filter);

  sql::Statement node_;
  sql::Statement aggregates_;
  sql::Statement aggregates_of_value_;
  sql::Statement pairs_;
  std::vector<std::uint8_t> matching_;  ///< tuples
};

}  // namespace fitgauge::store
