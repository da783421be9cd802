#include "sql/measurement_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace fitgauge::store {
namespace {

using sql::Blob;
using sql::Rows;

Source source_of(int kind) { return static_cast<Source>(kind / 8); }
Verdict verdict_of(int kind) { return static_cast<Verdict>(kind % 8); }

/// Where the times from `min` to `max` lie to the range `from` <= time < `to`.
template <class Relation>
Relation relation_of(std::int64_t min, std::int64_t max, std::optional<std::int64_t> from,
                     std::optional<std::int64_t> to) {
  if ((from && max < *from) || (to && min >= *to)) return Relation::Outside;
  if ((!from || min >= *from) && (!to || max < *to)) return Relation::Inside;
  return Relation::Partly;
}

}  // namespace

MeasurementSummary::MeasurementSummary(sql::Connection& c, TextField group_by)
    : group_by_(group_by),
      rows_(c, fmt::format("m.{}, m.verdict, m.measured_nm", column_of(group_by))),
      last_block_(last_block_statement(c)),
      node_(c,
            "SELECT min_measured_at, max_measured_at, min_received_at, max_received_at, stale "
            "FROM measurement_nodes WHERE level = ? AND node = ?"),
      aggregates_(c, fmt::format("SELECT value, kind, statistics, {} FROM measurement_aggregates "
                                 "WHERE level = ? AND node = ? AND field = ?",
                                 AggregatedValue(c).is_none)),
      aggregates_of_value_(c,
                           "SELECT value, kind, statistics, 0 FROM measurement_aggregates "
                           "WHERE level = ? AND node = ? AND field = ? AND value = ?"),
      corrected_(
          c, fmt::format("SELECT correction_of FROM measurements WHERE correction_of IS NOT NULL "
                         "UNION SELECT m.id FROM measurements m WHERE m.correction_of IS NOT "
                         "NULL AND NOT {} ORDER BY 1",
                         CurrentCondition(std::to_string(kLastId)).has_no_later_rival)) {}

Result<std::vector<SummaryGroup>> MeasurementSummary::run(const MeasurementFilter& filter,
                                                          std::size_t max_groups) {
  filter_ = &filter;
  max_groups_ = max_groups;
  fits_ = true;
  groups_.clear();
  aggregated_.clear();
  if (is_additive(filter)) {
    add_nodes();
    if (filter.history) add_corrected_rows();
  } else {
    add_rows(filter, {.first = 1, .last = kLastId});
  }
  if (!fits_) {
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("there are more than {} groups; narrow the filter", max_groups)};
  }
  std::vector<SummaryGroup> summary;
  summary.reserve(groups_.size());
  for (const auto& [value, group] : groups_) {
    SummaryGroup& made = summary.emplace_back();
    made.value = value;
    made.count = group.statistics.count();
    made.verdicts = group.verdicts;
    made.mean_mm = group.statistics.mean_mm();
    if (made.count > 1) made.standard_deviation_mm = group.statistics.standard_deviation_mm();
    made.min_nm = group.statistics.min_nm();
    made.max_nm = group.statistics.max_nm();
  }
  return summary;
}

/// Whether the aggregates by the field, the source and the verdict answer the filter.
bool MeasurementSummary::is_additive(const MeasurementFilter& filter) const {
  if (filter.designation || filter.run_id || filter.as_of_id || filter.cause || filter.has_notes) {
    return false;
  }
  return std::all_of(kTextColumns.begin(), kTextColumns.end(), [&](const TextColumn& column) {
    return column.field == group_by_ || !filter.text(column.field);
  });
}

/// Goes over what is indexed by the largest nodes there are, then reads the newer rows.
void MeasurementSummary::add_nodes() {
  const std::int64_t indexed = indexed_to(last_block_);
  std::int64_t id = 1;
  while (id <= indexed && fits_) {
    IndexNode node = IndexNode::of(id, kLevels - 1);
    while (node.level > 0 && (node.ids().first != id || node.ids().last > indexed)) {
      node = IndexNode::of(id, node.level - 1);
    }
    add_node(node);
    id = node.ids().last + 1;
  }
  add_rows(*filter_, {.first = indexed + 1, .last = kLastId});
}

void MeasurementSummary::add_node(const IndexNode& node) {
  bool usable = false;
  const Relation where = relation(node, usable);
  if (where == Relation::Outside) return;
  if (where == Relation::Inside && usable && add_aggregates(node)) return;
  if (node.level == 0) return add_rows(*filter_, node.ids());
  for (std::int64_t i = 0; i < kFanOut && fits_; ++i) add_node(node.child(i));
}

/// @param usable set to whether the node has aggregates of its current rows.
MeasurementSummary::Relation MeasurementSummary::relation(const IndexNode& node, bool& usable) {
  Rows rows = node_.query(node.level, node.node);
  if (!rows.next()) return Relation::Partly;
  usable = !rows.get<bool>(4);
  const auto measured = relation_of<Relation>(rows.get<std::int64_t>(0), rows.get<std::int64_t>(1),
                                              filter_->from_ns, filter_->to_ns);
  const auto received = relation_of<Relation>(rows.get<std::int64_t>(2), rows.get<std::int64_t>(3),
                                              filter_->received_from_ns, filter_->received_to_ns);
  if (measured == Relation::Outside || received == Relation::Outside) return Relation::Outside;
  const bool inside = measured == Relation::Inside && received == Relation::Inside;
  return inside ? Relation::Inside : Relation::Partly;
}

/// @returns whether the node has any by the field.
bool MeasurementSummary::add_aggregates(const IndexNode& node) {
  const auto& value = filter_->text(group_by_);
  const int field = number_of(group_by_);
  bool found = false;
  const auto add_all = [&](Rows rows) {
    while (rows.next() && fits_) {
      found = true;
      const auto kind = rows.get<int>(1);
      if (filter_->source && source_of(kind) != *filter_->source) continue;
      if (filter_->verdict && verdict_of(kind) != *filter_->verdict) continue;
      const auto group =
          rows.get<bool>(3) ? std::nullopt : rows.get<std::optional<std::string_view>>(0);
      add(group, verdict_of(kind), ExactStatistics::decode(rows.get<Blob>(2).bytes));
    }
  };
  if (value) {
    add_all(aggregates_of_value_.query(node.level, node.node, field, *value));
    // No rows of the value, or no aggregates of the field?
    found = found || aggregates_.query(node.level, node.node, field).next();
  } else {
    add_all(aggregates_.query(node.level, node.node, field));
  }
  if (found) aggregated_.push_back(node.ids());
  return found;
}

void MeasurementSummary::add_rows(const MeasurementFilter& filter, const IdSpan& ids) {
  rows_.run(filter, ids, ListOrder::OldestFirst, [&](const Rows& rows) {
    ExactStatistics one;
    one.add(rows.get<std::int64_t>(2));
    add(rows.get<std::optional<std::string_view>>(0), rows.get<Verdict>(1), one);
    return fits_;
  });
}

/// Aggregates are of current rows: a summary of all rows has the corrected ones as well.
void MeasurementSummary::add_corrected_rows() {
  auto span = aggregated_.begin();
  for (Rows rows = corrected_.query(); rows.next() && fits_;) {
    const auto id = rows.get<std::int64_t>(0);
    while (span != aggregated_.end() && span->last < id) ++span;
    if (span == aggregated_.end()) return;
    if (span->first <= id) add_rows(*filter_, {.first = id, .last = id});
  }
}

void MeasurementSummary::add(std::optional<std::string_view> value, Verdict verdict,
                             const ExactStatistics& statistics) {
  auto group = groups_.find(value);
  if (group == groups_.end()) {
    fits_ = groups_.size() < max_groups_;
    if (!fits_) return;
    group = groups_.try_emplace(value ? std::optional(std::string(*value)) : std::nullopt).first;
  }
  group->second.statistics.add(statistics);
  group->second.verdicts.at(static_cast<std::size_t>(verdict) - 1) += statistics.count();
}

}  // namespace fitgauge::store
