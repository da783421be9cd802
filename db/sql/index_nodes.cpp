#include "db/sql/index_nodes.hpp"

#include "db/store/block_columns.hpp"
#include "db/store/tuple_statistics.hpp"

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

/// Maximum of stored statistics of two fields, by level: each for about eight to several hundred
/// rows.
constexpr std::array<std::size_t, kLevels> kMostStatistics = {0, 4'096, 16'384, 65'536};

std::size_t most_statistics(const IndexNode& node) {
  return kMostStatistics.at(static_cast<std::size_t>(node.level));
}

/// Maximum of stored tuples.
constexpr std::array<std::size_t, kLevels> kMostTuples = {0, 4'096, 32'768, 65'536};

std::size_t most_tuples(const IndexNode& node) {
  return kMostTuples.at(static_cast<std::size_t>(node.level));
}

/// Calls `visit` with the fields of each possible pair: fields of groups are texts.
template <class Visit>
void for_each_pair(const Visit& visit) {
  for (int by = 1; by <= static_cast<int>(kSummedColumns.size()); ++by) {
    for (std::size_t column = 0; column < kBlockColumns; ++column) {
      if (const int field = field_of_column(column); field != by) visit(field, by);
    }
  }
}

/// Visits each entry with the fields of tuples.
template <class Visit>
void for_each_entry(const IndexNode& node, const Visit& visit) {
  for_each_pair(visit);
  for (std::size_t column = 0; column < kBlockColumns; ++column) {
    visit(field_of_column(column), PairIndex::kColumns);
  }
  const std::size_t sums = most_tuples(node) / kTuplesTogether;
  for (std::size_t i = 0; i < sums; ++i) visit(PairIndex::kSums, static_cast<int>(i));
}

void add_tuples(const TupleWriter& tuples, PairIndex::Node& index) {
  tuples.visit_columns([&](int field, std::string bytes) {
    index.pairs[{field, PairIndex::kColumns}] = std::move(bytes);
  });
  int by = 0;
  tuples.visit_sums([&](std::string bytes) {
    index.pairs[{PairIndex::kSums, by++}] = std::move(bytes);
  });
}

}  // namespace

Verdict verdict_of(int kind) { return sql::value_of<Verdict>(kind % 8); }

bool is_asked(const MeasurementFilter& filter, int kind) {
  return (!filter.source || kind / 8 == code_of(*filter.source)) &&
         (!filter.verdict || kind % 8 == code_of(*filter.verdict));
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
  if (std::ranges::any_of(values,
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
  return !any || (!matching_.empty() && std::ranges::find(matching_, 1) == matching_.end());
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

PairIndex::Node PairIndex::derive(const IndexNode& node) {
  Node index;
  node.level == 1 ? derive_from_columns(node, index) : derive_from_pairs(node, index);
  return index;
}

void PairIndex::derive_from_columns(const IndexNode& node, Node& index) {
  index.pairs[{kSums, 0}];  // empty where a block has no columns
  PairCounter counter;
  for (std::int64_t i = 0; i < kFanOut; ++i) {
    BlockColumns block;
    Rows rows = columns_.query(node.child(i).node);
    if (!rows.next() || !block.read(rows.get<Blob>(0).bytes)) return;
    counter.add(block);
  }
  counter.visit_pairs(most_statistics(node), [&](std::size_t column, std::size_t by_column,
                                                 const PairStatistics& pairs) {
    if (by_column >= kSummedColumns.size()) return;
    index.pairs[{field_of_column(column), field_of_column(by_column)}] = encode(pairs);
  });
  add_tuples(counter.tuples(most_tuples(node)), index);
}

/// Joins the nodes below in their order: sums count from the first value.
void PairIndex::derive_from_pairs(const IndexNode& node, Node& index) {
  const IndexNode first = node.child(0);
  const IndexNode last = node.child(kFanOut - 1);
  for_each_pair([&](int field, int by) {
    PairStatistics joined;
    std::int64_t children = 0;
    for (Rows rows = child_pairs_.query(first.level, field, by, first.node, last.node); rows.next();
         ++children) {
      visit_values(rows.get<Blob>(0).bytes, [&](std::string_view value, std::string_view pairs) {
        auto& by_values = joined[std::string(value)];
        visit_pairs_of(pairs, [&](std::optional<std::string_view> by_value, int kind,
                                  const ExactStatistics& statistics) {
          by_values[by_value ? std::optional(std::string(*by_value)) : std::nullopt][kind].add(
              statistics);
        });
        return true;
      });
    }
    if (children < kFanOut || count_of(joined) > most_statistics(node)) return;
    index.pairs[{field, by}] = encode(joined);
  });
  join_tuples(node, index);
}

/// Numbers the values of the nodes below first, then adds them up, because their statistics are not
/// all stored.
void PairIndex::join_tuples(const IndexNode& node, Node& index) {
  index.pairs[{kSums, 0}];
  std::array<NumberedColumn, kBlockColumns> columns;
  std::vector<std::uint8_t> kinds;
  const auto for_each_sums = [&](const auto& visit) {
    for (std::int64_t i = 0; i < kFanOut; ++i) {
      if (!visit_sums(node.child(i), visit)) return false;
    }
    return true;
  };
  if (!for_each_sums([&](std::size_t, int kind, const auto&) {
        kinds.push_back(static_cast<std::uint8_t>(kind));
      })) {
    return;
  }
  for (std::size_t column = 0; column < kBlockColumns; ++column) {
    NumberedColumn& all = columns[column];
    for (std::int64_t i = 0; i < kFanOut && all.fits(); ++i) add_column(node.child(i), column, all);
    if (all.rows().size() != kinds.size()) all.give_up();
  }
  TupleWriter writer(columns, kinds, most_tuples(node));
  std::size_t row = 0;
  for_each_sums([&](std::size_t, int, const auto& read) { writer.add(row++, read()); });
  add_tuples(writer, index);
}

/// @returns false if the node has no tuples
template <class Visit>
bool PairIndex::visit_sums(const IndexNode& node, const Visit& visit) {
  TupleSums sums;
  std::size_t last = kTuplesTogether;
  for (int by = 0; last == kTuplesTogether; ++by, last = sums.size()) {
    Rows rows = pair_.query(node.level, kSums, by, node.node);
    if (!rows.next()) return by > 0;
    if (!sums.read(rows.get<Blob>(0).bytes)) return false;
    sums.visit(visit);
  }
  return true;
}

void PairIndex::add_column(const IndexNode& node, std::size_t column, NumberedColumn& all) {
  TupleColumn found;
  Rows rows = pair_.query(node.level, field_of_column(column), kColumns, node.node);
  if (!rows.next() || !found.read(rows.get<Blob>(0).bytes)) return all.give_up();
  const std::vector<std::uint16_t> numbers = all.numbers_of(found.values);
  for (const char number : found.numbers) all.add(numbers[static_cast<unsigned char>(number)]);
}

void PairIndex::insert(const IndexNode& node, const Node& index) {
  if (index.columns) insert_columns_.run(node.node, Blob{*index.columns});
  for (const auto& [fields, bytes] : index.pairs) {
    insert_pair_.run(node.level, fields.first, fields.second, node.node, Blob{bytes});
  }
}

void PairIndex::erase(const IndexNode& node) {
  if (node.level == 0) return delete_columns_.run(node.node);
  for_each_entry(node,
                 [&](int field, int by) { delete_pair_.run(node.level, field, by, node.node); });
}

bool PairIndex::is_stored(const IndexNode& node, const Node& index) {
  const auto is_same = [](Rows rows, const std::string* expected) {
    const bool found = rows.next();
    return found == (expected != nullptr) && (!found || rows.get<Blob>(0).bytes == *expected);
  };
  if (node.level == 0) {
    return is_same(columns_.query(node.node), index.columns ? &*index.columns : nullptr);
  }
  bool all = true;
  for_each_entry(node, [&](int field, int by) {
    const auto expected = index.pairs.find({field, by});
    all = all && is_same(pair_.query(node.level, field, by, node.node),
                         expected == index.pairs.end() ? nullptr : &expected->second);
  });
  return all;
}

std::int64_t PairIndex::count_surplus() {
  return count_surplus_columns_.returning<std::int64_t>() +
         count_surplus_pairs_.returning<std::int64_t>();
}

}  // namespace fitgauge::store
