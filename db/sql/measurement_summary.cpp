#include "db/sql/measurement_query.hpp"

namespace fitgauge::store {
namespace {

using sql::Blob;
using sql::Rows;

bool is_summed(TextField field) { return index_of(field) < kSummedColumns.size(); }

}  // namespace

MeasurementSummary::MeasurementSummary(sql::Connection& c, TextField group_by)
    : group_by_(group_by),
      connection_(c),
      rows_(c, fmt::format("m.{}, m.verdict, {}", column_of(group_by), kSummedLength)) {}

Result<std::vector<SummaryGroup>> MeasurementSummary::run(const MeasurementFilter& filter,
                                                          std::size_t max_groups) {
  filter_ = &filter;
  max_groups_ = max_groups;
  fits_ = true;
  groups_.clear();
  aggregated_.clear();
  look_at_filter();
  if (is_additive_) {
    add_nodes();
    if (filter.history) add_corrected_rows();
  } else {
    add_rows({.first = 1, .last = kLastId});
  }
  if (!fits_) {
    return Error{
        ErrorCode::QueryInvalid,
        fmt::format("the response has more than {} groups: narrow the filter", max_groups)};
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

/// Checks if nodes answer the filter, and finds its other fields than the grouped one.
void MeasurementSummary::look_at_filter() {
  const MeasurementFilter& filter = *filter_;
  others_.clear();
  if (filter.designation) {
    others_.push_back(
        {number_of(IndexField::Designation),
         designation_key(filter.designation->nominal_nm, filter.designation->tolerance_class)});
  }
  for (const TextColumn& column : kTextColumns) {
    const auto& text = filter.text(column.field);
    if (text && column.field != group_by_) others_.push_back({number_of(column.field), *text});
  }
  is_additive_ = !filter.run_id && !filter.as_of_id && !filter.asks_of_rows() &&
                 is_summed(group_by_) &&
                 std::ranges::none_of(others_, [&](const auto& other) { return is_rare(other); }) &&
                 !filter.text(TextField::Tool);
}

/// Returns whether the value is in so few blocks that reading them is faster than reading nodes.
bool MeasurementSummary::is_rare(const FieldValue& wanted) {
  return blocks_of_value_.returning<std::int64_t>(wanted.field, wanted.value, kFanOut + 1) <=
         kFanOut;
}

/// Reads the index in the largest possible nodes, then the newer rows.
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
  add_later({.first = indexed + 1, .last = kLastId});
  add_rows(left_);
  left_ = {};
}

void MeasurementSummary::add_node(const IndexNode& node) {
  const auto found = nodes_.find(node, *filter_).value_or(IndexNodes::Found());
  if (found.times == IndexNodes::Times::Outside) return;
  if (found.times == IndexNodes::Times::Inside &&
      (others_.empty() ? found.has_aggregates && add_aggregates(node)
                       : found.has_pairs && add_by_others(node))) {
    aggregated_.push_back(node.ids());
    return;
  }
  // Blocks have no pairs; a query finds the blocks of a value directly.
  if (node.level <= (others_.empty() ? 0 : 1)) return add_later(node.ids());
  for (std::int64_t i = 0; i < kFanOut && fits_; ++i) add_node(node.child(i));
}

/// @returns whether the node has statistics by the other fields.
bool MeasurementSummary::add_by_others(const IndexNode& node) {
  return add_pairs(node) || add_tuples(node) ||
         (node.level > 1 && nodes_.lacks(node, others_, *filter_));
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
      if (!is_asked(*filter_, kind)) continue;
      const auto group =
          rows.get<bool>(3) ? std::nullopt : rows.get<std::optional<std::string_view>>(0);
      add(group, verdict_of(kind), ExactStatistics::decode(rows.get<Blob>(2).bytes));
    }
  };
  if (value) {
    add_all(nodes_.aggregates(node, field, *value));
    // No rows of the value, or no aggregates of the field?
    found = found || nodes_.aggregates(node, field).next();
  } else {
    add_all(nodes_.aggregates(node, field));
  }
  return found;
}

/// @returns whether the node has the two fields' statistics.
bool MeasurementSummary::add_pairs(const IndexNode& node) {
  if (node.level == 0 || others_.size() > 1) return false;
  const auto& other = others_.front();
  Rows rows = nodes_.pairs(node, other.field, number_of(group_by_));
  if (!rows.next()) return false;
  const auto& wanted = filter_->text(group_by_);
  visit_values(rows.get<Blob>(0).bytes, [&](std::string_view value, std::string_view pairs) {
    if (value < other.value) return true;
    if (value != other.value) return false;
    visit_pairs_of(pairs, [&](std::optional<std::string_view> group, int kind,
                              const ExactStatistics& statistics) {
      if (!is_asked(*filter_, kind) || (wanted && group != *wanted) || !fits_) return;
      add(group, verdict_of(kind), statistics);
    });
    return false;
  });
  return true;
}

/// @returns whether the node has tuples by all fields that are asked for.
bool MeasurementSummary::add_tuples(const IndexNode& node) {
  if (node.level == 0) return false;
  std::string group_bytes, bytes;
  const auto groups = nodes_.column(node, number_of(group_by_), group_bytes);
  if (!groups) return false;
  matching_tuples_.assign(groups->numbers.size(), 1);
  bool found = true;
  for (const auto& [field, value] : others_) {
    const auto column = nodes_.column(node, field, bytes);
    if (!column || column->numbers.size() != matching_tuples_.size()) return false;
    found = found && column->keep(value, matching_tuples_);
  }
  if (const auto& value = filter_->text(group_by_)) {
    found = found && groups->keep(*value, matching_tuples_);
  }
  return !found || add_sums(node, *groups);
}

/// Reads the sums only if there are matching tuples.
/// @returns whether all exist
bool MeasurementSummary::add_sums(const IndexNode& node, const TupleColumn& groups) {
  std::array<bool, kKinds> asked{};
  for (int kind = 0; kind < kKinds; ++kind)
    asked[static_cast<std::size_t>(kind)] = is_asked(*filter_, kind);
  tuple_sums_.assign(groups.values.size() * kKinds, {});
  const std::span<const std::uint8_t> matching(matching_tuples_);
  TupleSums sums;
  for (std::size_t first = 0; first < matching.size(); first += kTuplesTogether) {
    const auto here = matching.subspan(first, std::min(kTuplesTogether, matching.size() - first));
    if (std::ranges::find(here, 1) == here.end()) continue;
    Rows rows = nodes_.pairs(node, PairIndex::kSums, static_cast<int>(first / kTuplesTogether));
    if (!rows.next() || !sums.read(rows.get<Blob>(0).bytes) || sums.size() != here.size()) {
      return false;
    }
    sums.visit([&](std::size_t tuple, int kind, const auto& read) {
      if (here[tuple] == 0 || !asked[static_cast<std::size_t>(kind)]) return;
      const auto group = static_cast<unsigned char>(groups.numbers[first + tuple]);
      tuple_sums_[std::size_t{group} * kKinds + static_cast<std::size_t>(kind)].add(read());
    });
  }
  for (std::size_t i = 0; i < tuple_sums_.size() && fits_; ++i) {
    if (tuple_sums_[i].count() == 0) continue;
    add(groups.values[i / kKinds], verdict_of(static_cast<int>(i % kKinds)), tuple_sums_[i]);
  }
  return true;
}

/// Reads the postponed rows, if these ids do not follow them.
void MeasurementSummary::add_later(const IdSpan& ids) {
  if (left_.empty() || left_.last + 1 != ids.first) add_rows(std::exchange(left_, ids));
  left_.last = ids.last;
}

void MeasurementSummary::add_rows(const IdSpan& ids) {
  if (ids.empty()) return;
  MeasurementQuery::BlockReader by_columns;
  // The index numbers runs, and other folders use the same numbers; it has only rows that are
  // current now.
  if (!filter_->run_id && !filter_->as_of_id && is_summed(group_by_)) {
    by_columns = [&](std::int64_t block, const RowSet& rows, const IdSpan& among) {
      return add_block(block, rows, among);
    };
  }
  const auto visit = [this](const Rows& rows) { return add_row(rows); };
  rows_.run(*filter_, ids, ListOrder::OldestFirst, visit, by_columns);
}

bool MeasurementSummary::add_row(const Rows& rows) {
  ExactStatistics one;
  one.add(rows.get<std::int64_t>(2));
  add(rows.get<std::optional<std::string_view>>(0), rows.get<Verdict>(1), one);
  return fits_;
}

MeasurementQuery::BlockRead MeasurementSummary::add_block(std::int64_t block, const RowSet& rows,
                                                          const IdSpan& ids) {
  using BlockRead = MeasurementQuery::BlockRead;
  Rows found = columns_.query(block);
  if (!found.next() || !block_.read(found.get<Blob>(0).bytes) ||
      !block_.read(index_of(group_by_), groups_of_block_)) {
    return BlockRead::Passed;
  }
  const std::size_t kinds = block_.kinds();
  block_statistics_.assign(groups_of_block_.values.size() * kinds, {});
  const std::int64_t first = IndexNode{0, block}.ids().first;
  for (std::int64_t id = ids.first; id <= ids.last; ++id) {
    if (!rows.contains(id - first)) continue;
    const auto row = static_cast<std::size_t>(id - first);
    const std::size_t kind = block_.kind_of_row(row);
    if (!filter_->history && !block_.is_current(kind)) continue;
    block_statistics_[groups_of_block_.rows[row] * kinds + kind].add(block_.measured_nm(row));
  }
  for (std::size_t i = 0; i < block_statistics_.size() && fits_; ++i) {
    if (block_statistics_[i].count() == 0) continue;
    add(groups_of_block_.values[i / kinds], verdict_of(block_.kind(i % kinds)),
        block_statistics_[i]);
  }
  return fits_ ? BlockRead::Taken : BlockRead::Ended;
}

/// Aggregates count current rows: a summary of all rows adds the corrected ones.
void MeasurementSummary::add_corrected_rows() {
  std::vector<std::int64_t> ids;
  auto span = aggregated_.begin();
  for (Rows rows = corrected_.query(); rows.next();) {
    const auto id = rows.get<std::int64_t>(0);
    while (span != aggregated_.end() && span->last < id) ++span;
    if (span == aggregated_.end()) break;
    if (span->first <= id) ids.push_back(id);
  }
  rows_.run_each(*filter_, ids, [this](const Rows& rows) { return add_row(rows); });
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
  group->second.verdicts.at(static_cast<std::size_t>(verdict)) += statistics.count();
}

}  // namespace fitgauge::store
