#include "db/sql/measurement_indexer.hpp"

#include "db/sql/connection.hpp"
#include "db/store/block_columns.hpp"

namespace fitgauge::store {
namespace {

using sql::Blob;
using sql::Rows;

/// A field with more values has no aggregates: in a block they would be as long as its rows, and no
/// summary has more than 10,000 groups.
constexpr std::array<std::size_t, kLevels> kMostValues = {256, 4'096, 10'000, 10'000};

/// The columns of a block's rows before its texts.
struct BlockColumn {
  enum : int {
    MeasuredAt,
    ReceivedAt,
    Verdict,
    Source,
    Nominal,
    Run,
    Measured,  ///< at 20 °C if it was corrected
    Lower,
    Upper,
    CorrectionOf,
    Origin,
    Texts
  };
};

std::string block_sql() {
  std::string columns;
  for (const TextColumn& column : kTextColumns) columns += fmt::format(", m.{}", column.column);
  return fmt::format(
      "SELECT m.measured_at, m.received_at, m.verdict, m.source, m.nominal_nm, m.run_id, {}, "
      "m.nominal_nm + m.lower_deviation_nm, "
      "m.nominal_nm + m.upper_deviation_nm, m.correction_of, coalesce(m.origin, 0){} FROM "
      "measurements m WHERE m.id BETWEEN ? AND ? ORDER BY m.id",
      kSummedLength, columns);
}

int kind_of(int source, int verdict) { return 8 * source + verdict; }

using Values = std::set<std::optional<std::string>>;

/// Index entry of a field's value in the previous row. Consecutive rows mostly share it, so it need
/// not be searched again.
struct FieldPlace {
  std::optional<std::string> value;
  RowSet* rows = nullptr;                 ///< those with the value
  ExactStatistics* statistics = nullptr;  ///< of the value and `kind`
  int kind = 0;
};

/// Place of an entry of designations.
struct DesignationPlace {
  static constexpr std::size_t kColumn = column_of_field(number_of(IndexField::Designation));

  std::int64_t nominal_nm = 0;
  RowSet* rows = nullptr;  ///< rows of the designation; null: none
};

/// Removes the aggregates of a field with too many values.
void drop_field(NodeIndex& index, int field) {
  std::erase_if(index.aggregates,
                [&](const auto& entry) { return std::get<0>(entry.first) == field; });
}

}  // namespace

MeasurementIndexer::MeasurementIndexer(sql::Connection& c)
    : connection_(c), block_(c, block_sql()) {}

bool MeasurementIndexer::step() {
  if (const auto stale = first_of(stale_)) {
    renew(*stale);
    return true;
  }
  const std::int64_t indexed = indexed_to(last_block_);
  if (connection_.measurements().last_id() < indexed + kBlock) {
    const auto unpaired = first_of(unpaired_);
    if (unpaired) renew(*unpaired);
    return unpaired.has_value();
  }
  IndexNode node = IndexNode::of(indexed + 1, 0);
  insert(node, derive(node));
  while (node.level + 1 < kLevels && node.ids().last == node.parent().ids().last) {
    node = node.parent();
    insert(node, derive(node));
  }
  return true;
}

std::optional<IndexNode> MeasurementIndexer::first_of(sql::Statement& nodes) {
  Rows rows = nodes.query();
  if (!rows.next()) return std::nullopt;
  return IndexNode{rows.get<int>(0), rows.get<std::int64_t>(1)};
}

void MeasurementIndexer::renew(const IndexNode& node) {
  delete_aggregates_.run(node.level, node.node);
  pairs_.erase(node);
  const NodeIndex index = derive(node);
  insert_sums(node, index);
  make_fresh_.run(index.pairs.is_complete, node.level, node.node);
}

void MeasurementIndexer::corrected(std::int64_t id) {
  make_stale(id);
  // One of the rivals replaced another rival with its corrections.
  for (Rows rows = rivals_.query(id); rows.next();) make_stale(rows.get<std::int64_t>(0));
}

void MeasurementIndexer::make_stale(std::int64_t id) {
  for (int level = 0; level < kLevels; ++level) {
    make_stale_.run(level, IndexNode::of(id, level).node);
  }
}

NodeIndex MeasurementIndexer::derive(const IndexNode& node) {
  return node.level == 0 ? derive_block(node) : derive_parent(node);
}

NodeIndex MeasurementIndexer::derive_block(const IndexNode& node) {
  NodeIndex index;
  const IdSpan ids = node.ids();
  std::int64_t row = 0;
  std::array<Values, kTextColumns.size()> values;
  std::array<FieldPlace, kTextColumns.size()> places;
  ValueBlockWriter block;
  BlockColumnsWriter columns;
  DesignationPlace designation;
  int kind = 0;
  RowSet* sources = nullptr;  // rows of the kind's source
  RowSet* verdicts = nullptr;
  bool is_plain = true;
  RowSet corrected;
  for (Rows rows = corrected_.query(ids.first, ids.last); rows.next();) {
    corrected.add(rows.get<std::int64_t>(0) - ids.first);
  }
  const auto post = [&](int field, std::string value) {
    RowSet& with = index.postings[{field, std::move(value)}];
    with.add(row);
    return &with;
  };
  for (Rows rows = block_.query(ids.first, ids.last); rows.next(); ++row) {
    const auto measured_at = rows.get<std::int64_t>(BlockColumn::MeasuredAt);
    const auto received_at = rows.get<std::int64_t>(BlockColumn::ReceivedAt);
    if (row == 0) index.times = {measured_at, measured_at, received_at, received_at};
    auto& [min_measured_at, max_measured_at, min_received_at, max_received_at] = index.times;
    min_measured_at = std::min(min_measured_at, measured_at);
    max_measured_at = std::max(max_measured_at, measured_at);
    min_received_at = std::min(min_received_at, received_at);
    max_received_at = std::max(max_received_at, received_at);
    const auto measured_nm = rows.get<std::int64_t>(BlockColumn::Measured);
    const bool corrects =
        rows.get<std::optional<std::int64_t>>(BlockColumn::CorrectionOf).has_value();
    const bool is_current = !corrected.contains(row) &&
                            (!corrects || stands_.returning<std::int64_t>(ids.first + row) == 1);
    is_plain = is_plain && rows.get<std::int64_t>(BlockColumn::Origin) == 0 && !corrects;
    block.add({.measured_nm = measured_nm,
               .lower_limit_nm = rows.get<std::int64_t>(BlockColumn::Lower),
               .upper_limit_nm = rows.get<std::int64_t>(BlockColumn::Upper),
               .subgroup = rows.get<std::optional<std::string_view>>(
                   BlockColumn::Texts + static_cast<int>(index_of(TextField::Subgroup)))});
    const auto source = rows.get<int>(BlockColumn::Source);
    const auto verdict = rows.get<int>(BlockColumn::Verdict);
    if (row == 0 || kind_of(source, verdict) != kind) {
      kind = kind_of(source, verdict);
      sources = post(number_of(IndexField::Source), std::to_string(source));
      verdicts = post(number_of(IndexField::Verdict), std::to_string(verdict));
    }
    sources->add(row);
    verdicts->add(row);
    columns.add(kind, is_current, measured_nm);
    if (const auto run = rows.get<std::optional<std::int64_t>>(BlockColumn::Run)) {
      post(number_of(IndexField::Run), std::to_string(*run));
    }
    for (const TextColumn& column : kTextColumns) {
      const auto field = index_of(column.field);
      FieldPlace& place = places[field];
      const auto value =
          rows.get<std::optional<std::string_view>>(BlockColumn::Texts + static_cast<int>(field));
      const bool is_new = row == 0 || place.value != value;
      if (is_new) place = {.value = value ? std::optional<std::string>(*value) : std::nullopt};
      const bool is_summed = field < kSummedColumns.size();
      if (is_new && is_summed) {
        columns.add_text(field, value);
      } else if (is_summed) {
        columns.repeat_text(field);
      }
      if (column.field == TextField::ToleranceClass) {
        const auto nominal_nm = rows.get<std::int64_t>(BlockColumn::Nominal);
        if (is_new || nominal_nm != designation.nominal_nm) {
          const auto key =
              value ? std::optional(designation_key(nominal_nm, *value)) : std::nullopt;
          columns.add_text(DesignationPlace::kColumn, key);
          designation = {.nominal_nm = nominal_nm,
                         .rows = key ? post(number_of(IndexField::Designation), *key) : nullptr};
        } else {
          columns.repeat_text(DesignationPlace::kColumn);
          if (designation.rows != nullptr) designation.rows->add(row);
        }
      }
      if (is_summed && is_current && values[field].size() <= kMostValues[0]) {
        if (place.statistics == nullptr || place.kind != kind) {
          values[field].insert(place.value);
          place.kind = kind;
          place.statistics = &index.aggregates[{number_of(column.field), place.value, kind}];
        }
        place.statistics->add(measured_nm);
      }
      if (!value) continue;
      if (is_new) {
        place.rows = post(number_of(column.field), *place.value);
      } else {
        place.rows->add(row);
      }
    }
  }
  for (const TextColumn& column : kSummedColumns) {
    if (values[index_of(column.field)].size() > kMostValues[0]) {
      drop_field(index, number_of(column.field));
    }
  }
  if (is_plain) index.values = block.encode();
  index.pairs.columns = columns.encode();
  return index;
}

/// Joins the nodes below, in their order: sums count from the first value. If a field has too many
/// values in one of them, up to 32 blocks are read again, because this node may still have few
/// enough.
NodeIndex MeasurementIndexer::derive_parent(const IndexNode& node) {
  NodeIndex index;
  index.pairs = pairs_.derive(node);
  const IndexNode first = node.child(0);
  const IndexNode last = node.child(kFanOut - 1);
  if (Rows rows = child_times_.query(first.level, first.node, last.node); rows.next()) {
    index.times = sql::row_of<NodeTimes>(rows);
    index.pairs.is_complete = rows.get<std::int64_t>(4) == 1;
  }
  std::map<int, std::set<std::int64_t>> children;
  std::map<int, Values> values;
  for (Rows rows = child_aggregates_.query(first.level, first.node, last.node); rows.next();) {
    const auto field = rows.get<int>(1);
    auto value = rows.get<bool>(5) ? std::nullopt : rows.get<std::optional<std::string>>(2);
    children[field].insert(rows.get<std::int64_t>(0));
    values[field].insert(value);
    index.aggregates[{field, std::move(value), rows.get<int>(3)}].add(
        ExactStatistics::decode(rows.get<Blob>(4).bytes));
  }
  const std::size_t most = kMostValues.at(static_cast<std::size_t>(node.level));
  for (const TextColumn& column : kSummedColumns) {
    const int field = number_of(column.field);
    const bool complete = children[field].size() == static_cast<std::size_t>(kFanOut);
    if (complete && values[field].size() <= most) continue;
    drop_field(index, field);
    if (!complete && node.level == 1) aggregate_rows(node, column.field, index);
  }
  return index;
}

void MeasurementIndexer::aggregate_rows(const IndexNode& node, TextField field, NodeIndex& index) {
  MeasurementQuery query(
      connection_, fmt::format("m.{}, m.source, m.verdict, {}", column_of(field), kSummedLength));
  Values values;
  const MeasurementFilter current{.source = std::nullopt};
  const bool few = query.run(current, node.ids(), ListOrder::OldestFirst, [&](const Rows& rows) {
    auto value = rows.get<std::optional<std::string>>(0);
    values.insert(value);
    if (values.size() > kMostValues[1]) return false;
    index
        .aggregates[{number_of(field), std::move(value),
                     kind_of(rows.get<int>(1), rows.get<int>(2))}]
        .add(rows.get<std::int64_t>(3));
    return true;
  });
  if (!few) drop_field(index, number_of(field));
}

void MeasurementIndexer::insert(const IndexNode& node, const NodeIndex& index) {
  const auto& [min_measured_at, max_measured_at, min_received_at, max_received_at] = index.times;
  insert_node_.run(node.level, node.node, min_measured_at, max_measured_at, min_received_at,
                   max_received_at, index.pairs.is_complete);
  struct Posting {
    int field;
    std::string_view value;
    std::string rows;
  };
  std::vector<Posting> postings;
  postings.reserve(index.postings.size());
  for (const auto& [key, rows] : index.postings) {
    postings.push_back({key.first, key.second, rows.encode()});
  }
  insert_postings_.run(postings, [&](const Posting& posting, const auto& bind) {
    bind(posting.field, posting.value, node.node, Blob{posting.rows});
  });
  if (index.values) insert_values_.run(node.node, Blob{*index.values});
  insert_sums(node, index);
}

void MeasurementIndexer::insert_sums(const IndexNode& node, const NodeIndex& index) {
  for (const auto& [key, statistics] : index.aggregates) {
    const auto& [field, value, kind] = key;
    const auto bytes = statistics.encode();
    const Blob blob{{bytes.data(), bytes.size()}};
    insert_aggregate_.run(node.level, node.node, field, value, kind, blob);
  }
  pairs_.insert(node, index.pairs);
}

void MeasurementIndexer::verify(const std::function<void(std::string)>& note) {
  struct Stored {
    IndexNode node;
    bool stale = false;
    bool paired = false;
    NodeTimes times{};
  };
  std::vector<Stored> stored;
  for (Rows rows = nodes_.query(); rows.next();) {
    stored.push_back({.node = {rows.get<int>(4), rows.get<std::int64_t>(5)},
                      .stale = rows.get<bool>(6),
                      .paired = rows.get<std::int64_t>(7) == 1,
                      .times = sql::row_of<NodeTimes>(rows)});
  }
  std::int64_t postings = 0;
  std::int64_t values = 0;
  for (const Stored& node : stored) {
    const NodeIndex index = derive(node.node);
    postings += static_cast<std::int64_t>(index.postings.size());
    values += index.values ? 1 : 0;
    if (index.times == node.times && is_stored(node.node, index, node.stale) &&
        (!node.paired || pairs_.is_stored(node.node, index.pairs))) {
      continue;
    }
    const IdSpan ids = node.node.ids();
    note(fmt::format("the index of measurements {} to {} (level {}) differs from the measurements",
                     ids.first, ids.last, node.node.level));
  }
  const auto surplus = count_postings_.returning<std::int64_t>() - postings +
                       count_values_.returning<std::int64_t>() - values;
  if (surplus > 0) note(fmt::format("the index has {} values without a measurement", surplus));
  if (surplus < 0) note(fmt::format("the index lacks {} values of measurements", -surplus));
  if (const auto others = pairs_.count_surplus(); others > 0) {
    note(fmt::format("the index has {} unknown columns or pairs of rows", others));
  }
}

bool MeasurementIndexer::is_stored(const IndexNode& node, const NodeIndex& index, bool stale) {
  for (const auto& [key, rows] : index.postings) {
    Rows found = posting_.query(key.first, key.second, node.node);
    if (!found.next() || found.get<Blob>(0).bytes != rows.encode()) return false;
  }
  if (index.values) {
    Rows found = values_.query(node.node);
    if (!found.next() || found.get<Blob>(0).bytes != *index.values) return false;
  }
  if (stale) return true;
  std::size_t count = 0;
  for (Rows rows = node_aggregates_.query(node.level, node.node); rows.next(); ++count) {
    const auto found = index.aggregates.find(
        {rows.get<int>(0),
         rows.get<bool>(4) ? std::nullopt : rows.get<std::optional<std::string>>(1),
         rows.get<int>(2)});
    if (found == index.aggregates.end()) return false;
    const auto bytes = found->second.encode();
    if (rows.get<Blob>(3).bytes != std::string_view(bytes.data(), bytes.size())) return false;
  }
  return count == index.aggregates.size();
}

}  // namespace fitgauge::store
