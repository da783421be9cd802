#include "db/sql/index_nodes.hpp"

namespace fitgauge::store {
namespace {

using sql::Blob;
using sql::Rows;
using Times = IndexNodes::Times;

/// Relation of the times from `min` to `max` to the range `from` <= time < `to`.
Times relation_of(std::int64_t min, std::int64_t max, std::optional<std::int64_t> from,
                  std::optional<std::int64_t> to) {
  if ((from && max < *from) || (to && min >= *to)) return Times::Outside;
  if ((!from || min >= *from) && (!to || max < *to)) return Times::Inside;
  return Times::Partly;
}

}  // namespace

Source source_of(int kind) { return static_cast<Source>(kind / 8); }
Verdict verdict_of(int kind) { return static_cast<Verdict>(kind % 8); }

bool is_asked(const MeasurementFilter& filter, int kind) {
  return (!filter.source || source_of(kind) == *filter.source) &&
         (!filter.verdict || verdict_of(kind) == *filter.verdict);
}

AggregatedValue::AggregatedValue(const sql::Connection& connection)
    : is_none(connection.dialect().keys_may_be_null ? "value IS NULL" : "value = 0"),
      parameter(connection.dialect().keys_may_be_null ? "?" : "coalesce(?, 0)") {}

std::optional<IndexNodes::Found> IndexNodes::find(const IndexNode& node,
                                                  const MeasurementFilter& filter) {
  Rows rows = node_.query(node.level, node.node);
  if (!rows.next()) return std::nullopt;
  const auto measured = relation_of(rows.get<std::int64_t>(0), rows.get<std::int64_t>(1),
                                    filter.from_ns, filter.to_ns);
  const auto received = relation_of(rows.get<std::int64_t>(2), rows.get<std::int64_t>(3),
                                    filter.received_from_ns, filter.received_to_ns);
  Found found{.has_aggregates = !rows.get<bool>(4), .has_pairs = rows.get<bool>(5)};
  if (measured == Times::Outside || received == Times::Outside) {
    found.times = Times::Outside;
  } else if (measured == Times::Inside && received == Times::Inside) {
    found.times = Times::Inside;
  }
  return found;
}

bool IndexNodes::lacks(const IndexNode& node, std::span<const FieldValue> values,
                       const MeasurementFilter& filter) {
  if (std::any_of(values.begin(), values.end(),
                  [&](const auto& wanted) { return lacks(node, wanted, filter); })) {
    return true;
  }
  matching_.clear();
  bool any = true;
  std::string bytes;
  for (const auto& [field, value] : values) {
    const auto found = column(node, field, bytes);
    if (!found) continue;
    if (matching_.empty()) matching_.assign(found->numbers.size(), 1);
    if (matching_.size() != found->numbers.size()) return false;
    any = any && found->keep(value, matching_);
  }
  return !any || (!matching_.empty() &&
                  std::find(matching_.begin(), matching_.end(), 1) == matching_.end());
}

/// Outdated sums have at least the values of the current rows.
bool IndexNodes::lacks(const IndexNode& node, const FieldValue& wanted,
                       const MeasurementFilter& filter) {
  if (wanted.field > static_cast<int>(kSummedColumns.size())) return false;
  for (Rows rows = aggregates(node, wanted.field, wanted.value); rows.next();) {
    if (is_asked(filter, rows.get<int>(1))) return false;
  }
  return aggregates(node, wanted.field).next();
}

Rows IndexNodes::aggregates(const IndexNode& node, int field) {
  return aggregates_.query(node.level, node.node, field);
}

Rows IndexNodes::aggregates(const IndexNode& node, int field, std::string_view value) {
  return aggregates_of_value_.query(node.level, node.node, field, value);
}

Rows IndexNodes::pairs(const IndexNode& node, int field, int by_field) {
  return pairs_.query(node.level, field, by_field, node.node);
}

std::optional<TupleColumn> IndexNodes::column(const IndexNode& node, int field,
                                              std::string& bytes) {
  Rows rows = pairs(node, field, PairIndex::kColumns);
  if (!rows.next()) return std::nullopt;
  bytes = rows.get<Blob>(0).bytes;
  TupleColumn column;
  return column.read(bytes) ? std::optional(std::move(column)) : std::nullopt;
}

}  // namespace fitgauge::store
