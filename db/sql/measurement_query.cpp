#include "db/sql/measurement_query.hpp"

#include "db/sql/connection.hpp"
#include "record/measurement.hpp"

namespace fitgauge::store {
namespace {

using sql::Blob;
using sql::Rows;
using sql::Statement;

/// Maximum of statements kept for filters; then all are dropped.
constexpr std::size_t kMostKept = 64;
constexpr std::int64_t kRowsAtATime = 1024;
/// Smaller nodes are not worth a look: their blocks are found as soon.
constexpr int kLeastLookedAt = 2;
constexpr std::int64_t kFirstTime = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kLastTime = std::numeric_limits<std::int64_t>::max();

/// Calls `add(condition, value)` for each condition a row `m` has to meet.
template <class Add>
void for_each_condition(const MeasurementFilter& filter, Add&& add) {
  if (filter.verdict) add("m.verdict = ?", *filter.verdict);
  if (filter.source) add("m.source = ?", *filter.source);
  if (filter.run_id) {
    add("m.run_id = ?", *filter.run_id);
    add("coalesce(m.origin, 0) = ?", filter.run_origin);
  }
  if (filter.designation) {
    add("m.nominal_nm = ?", filter.designation->nominal_nm);
    add("m.tolerance_class = ?", std::string_view(filter.designation->tolerance_class));
    if (filter.designation->has_envelope) add("m.envelope = ?", app::kEnvelopeRequired);
  }
  for (std::size_t i = 0; i < kTextColumns.size(); ++i) {
    if (!filter.texts[i]) continue;
    add(fmt::format("m.{} = ?", kTextColumns[i].column), std::string_view(*filter.texts[i]));
  }
  if (filter.from_ns) add("m.measured_at >= ?", *filter.from_ns);
  if (filter.to_ns) add("m.measured_at < ?", *filter.to_ns);
  if (filter.received_from_ns) add("m.received_at >= ?", *filter.received_from_ns);
  if (filter.received_to_ns) add("m.received_at < ?", *filter.received_to_ns);
  if (filter.confirmed) add("coalesce(m.confirmed, 0) = ?", *filter.confirmed ? 1 : 0);
  if (filter.set_aside) {
    static const std::string newest = fmt::format(
        "coalesce((SELECT CASE n.measure WHEN '{0}' THEN 1 ELSE 0 END FROM notes n WHERE "
        "n.measurement = m.id AND n.measure IN ('{0}', '{1}') ORDER BY n.id DESC LIMIT 1), 0) = ?",
        app::kSetAside, app::kCountedAgain);
    add(newest, *filter.set_aside ? 1 : 0);
  }
  if (filter.asks_of_notes()) {
    // One note meets all: the parenthesis ends with the last condition.
    add("EXISTS (SELECT 1 FROM notes n WHERE n.measurement = m.id AND n.received_at >= ?",
        filter.noted_from_ns.value_or(kFirstTime));
    add(filter.cause ? "n.received_at < ?" : "n.received_at < ?)",
        filter.noted_to_ns.value_or(kLastTime));
    if (filter.cause) add("n.cause = ?)", std::string_view(*filter.cause));
  }
  if (!filter.history) {
    static const CurrentCondition current("?");
    add(current.is_not_corrected, filter.as_of_id.value_or(kLastId));
    add(current.has_no_later_rival, filter.as_of_id.value_or(kLastId));
  }
}

/// Adds the conditions of time for the node `b` of a block that may have such rows.
template <class Add>
void for_each_time_condition(const MeasurementFilter& filter, Add&& add) {
  if (filter.from_ns) add("b.max_measured_at >= ?", *filter.from_ns);
  if (filter.to_ns) add("b.min_measured_at < ?", *filter.to_ns);
  if (filter.received_from_ns) add("b.max_received_at >= ?", *filter.received_from_ns);
  if (filter.received_to_ns) add("b.min_received_at < ?", *filter.received_to_ns);
}

/// Adds the conditions that hold if all rows of the block match.
template <class Add>
void for_each_inside_condition(const MeasurementFilter& filter, Add&& add) {
  if (filter.from_ns) add("b.min_measured_at >= ?", *filter.from_ns);
  if (filter.to_ns) add("b.max_measured_at < ?", *filter.to_ns);
  if (filter.received_from_ns) add("b.min_received_at >= ?", *filter.received_from_ns);
  if (filter.received_to_ns) add("b.max_received_at < ?", *filter.received_to_ns);
}

/// Whether postings determine the matching rows if all times match, except for corrections.
bool is_said_by_index(const MeasurementFilter& filter) {
  return !filter.asks_of_rows() && (!filter.run_id || filter.run_origin == 0);
}

std::string_view direction(ListOrder order) {
  return order == ListOrder::NewestFirst ? " DESC" : "";
}

}  // namespace

// The later of two rival corrections counts, in any order of arrival and so equally at each end. If
// they were received at one time, their leaves decide.
CurrentCondition::CurrentCondition(std::string_view last)
    : is_not_corrected(
          fmt::format("NOT EXISTS (SELECT 1 FROM measurements c WHERE c.correction_of = m.id AND "
                      "c.id <= {})",
                      last)),
      has_no_later_rival(fmt::format(
          "(m.correction_of IS NULL OR NOT EXISTS (WITH RECURSIVE back(target, at, leaf) AS ("
          "SELECT m.correction_of, m.received_at, m.hash UNION ALL "
          "SELECT b.correction_of, b.received_at, b.hash FROM back JOIN measurements b "
          "ON b.id = back.target WHERE b.correction_of IS NOT NULL) "
          "SELECT 1 FROM back JOIN measurements r ON r.correction_of = back.target "
          "WHERE (r.received_at, r.hash) > (back.at, back.leaf) AND r.id <= {}))",
          last)) {}

Statement last_block_statement(sql::Connection& connection) {
  return {connection, "SELECT max(node) FROM measurement_nodes WHERE level = 0"};
}

std::int64_t indexed_to(Statement& last_block) {
  const auto block = last_block.returning<std::optional<std::int64_t>>();
  return block ? IndexNode{0, *block}.ids().last : 0;
}

MeasurementQuery::MeasurementQuery(sql::Connection& connection, std::string columns)
    : connection_(connection),
      columns_(std::move(columns)),
      most_at_once_(connection.dialect().streams ? kLastId : kRowsAtATime) {}

bool MeasurementQuery::run(const MeasurementFilter& filter, const IdSpan& ids, ListOrder order,
                           const Visitor& visit, const BlockReader& read_block) {
  static const BlockReader none;
  MeasurementFilter all = filter;
  const std::int64_t last = filter.as_of_id.value_or(kLastId);
  all.history = filter.history || corrected_.returning<std::int64_t>(last) == 0;
  return run_current({.filter = all,
                      .order = order,
                      .visit = visit,
                      .read_block = is_said_by_index(all) ? read_block : none,
                      .is_current = asks_for_current(filter)},
                     ids);
}

bool MeasurementQuery::run_each(const MeasurementFilter& filter, std::span<const std::int64_t> ids,
                                const Visitor& visit) {
  if (statements_.size() > kMostKept) statements_.clear();
  Statement& matching = matching_rows(filter, ListOrder::OldestFirst);
  return std::ranges::all_of(ids, [&](std::int64_t id) {
    return scan(matching, {.first = id, .last = id}, ListOrder::OldestFirst, visit);
  });
}

/// Returns whether the filter selects only current rows, which nodes sum up.
bool MeasurementQuery::asks_for_current(const MeasurementFilter& filter) {
  const bool is_now = !filter.as_of_id || *filter.as_of_id >= connection_.measurements().last_id();
  return (is_now && !filter.history) || corrected_.returning<std::int64_t>(kLastId) == 0;
}

bool MeasurementQuery::run_current(const Reading& reading, const IdSpan& ids) {
  if (statements_.size() > kMostKept) statements_.clear();
  const auto& [filter, order, visit, read_block, is_current] = reading;
  const std::int64_t indexed = indexed_to(last_block_);
  const IdSpan all = intersection(ids, {.first = 1, .last = filter.as_of_id.value_or(kLastId)});
  const IdSpan known = intersection(all, {.first = 1, .last = indexed});
  const IdSpan newer = intersection(all, {.first = indexed + 1, .last = kLastId});
  Statement& matching = matching_rows(filter, order);
  if (order == ListOrder::NewestFirst) {
    return scan(matching, newer, order, visit) && run_indexed(reading, matching, known);
  }
  return run_indexed(reading, matching, known) && scan(matching, newer, order, visit);
}

/// The rows between two ids that match, all bound but the ids.
Statement& MeasurementQuery::matching_rows(const MeasurementFilter& filter, ListOrder order) {
  std::string sql =
      fmt::format("SELECT {}, m.id FROM measurements m WHERE m.id BETWEEN ? AND ?", columns_);
  for_each_condition(filter, [&](std::string_view condition, const auto&) {
    sql += " AND ";
    sql += condition;
  });
  Statement& matching = statement(fmt::format("{} ORDER BY m.id{} LIMIT ?", sql, direction(order)));
  int index = 2;
  for_each_condition(filter,
                     [&](std::string_view, const auto& value) { matching.bind(++index, value); });
  matching.bind(++index, most_at_once_);
  return matching;
}

/// If an engine returns all rows of a query at once, requests some at a time.
bool MeasurementQuery::scan(Statement& matching, const IdSpan& ids, ListOrder order,
                            const Visitor& visit) {
  for (IdSpan left = ids; !left.empty();) {
    matching.bind(1, left.first);
    matching.bind(2, left.last);
    std::int64_t count = 0;
    std::int64_t id = 0;
    for (Rows rows = matching.query(); rows.next(); ++count) {
      id = rows.get<std::int64_t>(rows.columns() - 1);
      if (!visit(rows)) return false;
    }
    if (count < most_at_once_) return true;
    if (order == ListOrder::NewestFirst) {
      left.last = id - 1;
    } else {
      left.first = id + 1;
    }
  }
  return true;
}

/// Returns the requested values, first those with probably the fewest rows.
std::vector<FieldValue> MeasurementQuery::postings_of(const MeasurementFilter& filter) {
  std::vector<FieldValue> postings;
  const auto add_text = [&](TextField field) {
    if (const auto& text = filter.text(field)) postings.push_back({number_of(field), *text});
  };
  add_text(TextField::PartId);
  if (filter.run_id)
    postings.push_back({number_of(IndexField::Run), std::to_string(*filter.run_id)});
  for (const TextField field :
       {TextField::Subgroup, TextField::Order, TextField::Characteristic, TextField::Operation,
        TextField::Gauge, TextField::Operator, TextField::Tool}) {
    add_text(field);
  }
  if (filter.designation) {
    postings.push_back(
        {number_of(IndexField::Designation),
         designation_key(filter.designation->nominal_nm, filter.designation->tolerance_class)});
  }
  for (const TextField field :
       {TextField::Machine, TextField::Unit, TextField::Caller, TextField::ToleranceClass}) {
    add_text(field);
  }
  const auto add_code = [&](IndexField field, const auto& code) {
    if (code) postings.push_back({number_of(field), std::to_string(code_of(*code))});
  };
  add_code(IndexField::Verdict, filter.verdict);
  add_code(IndexField::Source, filter.source);
  return postings;
}

/// Sources are compared in the rows, because nearly all rows have the requested one.
bool MeasurementQuery::is_source(const FieldValue& posting) {
  return posting.field == number_of(IndexField::Source);
}

bool MeasurementQuery::run_indexed(const Reading& reading, Statement& matching, const IdSpan& ids) {
  if (ids.empty()) return true;
  const auto& [filter, order, visit, read_block, is_current] = reading;
  if (filter.asks_of_notes()) return run_noted(reading, matching, ids);
  std::vector<FieldValue> postings = postings_of(filter);
  if (postings.empty() && !filter.has_times() && !read_block) {
    return scan(matching, ids, order, visit);
  }
  if (postings.size() > 1 && read_block == nullptr && is_source(postings.back())) {
    postings.pop_back();
  }
  const bool tells_inside = read_block && filter.has_times();
  Statement& blocks = matching_blocks(reading, postings, tells_inside);
  int index = 0;
  const auto bind_time = [&](std::string_view, std::int64_t value) { blocks.bind(++index, value); };
  if (tells_inside) for_each_inside_condition(filter, bind_time);
  for (const FieldValue& posting : postings) {
    blocks.bind(++index, posting.field);
    blocks.bind(++index, std::string_view(posting.value));
  }
  const int first_block = ++index, last_block = ++index;
  for_each_time_condition(filter, bind_time);
  static const BlockReader none;
  const Reading by_rows{filter, order, visit, none};
  const auto first = static_cast<int>(tells_inside) + 1;
  return visit_nodes(reading, postings, ids, [&](const IdSpan& span) {
    blocks.bind(first_block, IndexNode::of(span.first, 0).node);
    blocks.bind(last_block, IndexNode::of(span.last, 0).node);
    for (Rows rows = blocks.query(); rows.next();) {
      RowSet wanted = RowSet::all();
      for (int i = first; i < rows.columns(); ++i)
        wanted &= RowSet::decode(rows.get<Blob>(i).bytes);
      if (wanted.empty()) continue;
      const bool is_inside = !tells_inside || rows.get<bool>(1);
      if (!run_block(is_inside ? reading : by_rows, matching, span, wanted,
                     rows.get<std::int64_t>(0))) {
        return false;
      }
    }
    return true;
  });
}

/// Reads all ids, or, if the nodes of the index can exclude some, only the others. A single value
/// finds its blocks without nodes.
bool MeasurementQuery::visit_nodes(const Reading& reading, std::span<const FieldValue> postings,
                                   const IdSpan& ids, const SpanReader& read) {
  if (postings.size() < 2 && !reading.filter.has_times()) return read(ids);
  IndexNode node = IndexNode::of(ids.first, kLevels - 1);
  IndexNode end = IndexNode::of(ids.last, kLevels - 1);
  const bool newest = reading.order == ListOrder::NewestFirst;
  if (newest) std::swap(node, end);
  while (visit_node(reading, postings, node, ids, read)) {
    if (node.node == end.node) return true;
    node.node += newest ? -1 : 1;
  }
  return false;
}

bool MeasurementQuery::visit_node(const Reading& reading, std::span<const FieldValue> postings,
                                  const IndexNode& node, const IdSpan& ids,
                                  const SpanReader& read) {
  const IdSpan here = intersection(ids, node.ids());
  if (here.empty()) return true;
  const bool is_whole = here.first == node.ids().first && here.last == node.ids().last;
  if (is_whole && has_none(reading, postings, node)) return true;
  if (node.level == kLeastLookedAt) return read(here);
  const bool newest = reading.order == ListOrder::NewestFirst;
  for (std::int64_t i = 0; i < kFanOut; ++i) {
    const IndexNode child = node.child(newest ? kFanOut - 1 - i : i);
    if (!visit_node(reading, postings, child, ids, read)) return false;
  }
  return true;
}

/// Whether it is known that no row of the node matches.
bool MeasurementQuery::has_none(const Reading& reading, std::span<const FieldValue> postings,
                                const IndexNode& node) {
  const auto found = nodes_.find(node, reading.filter);
  return found && (found->times == IndexNodes::Times::Outside ||
                   (reading.is_current && nodes_.lacks(node, postings, reading.filter)));
}

/// Returns the blocks that have all values, with the rows of each value; on request also whether
/// all times of a block match.
Statement& MeasurementQuery::matching_blocks(const Reading& reading,
                                             std::span<const FieldValue> postings,
                                             bool tells_inside) {
  const MeasurementFilter& filter = reading.filter;
  const bool has_nodes = postings.empty() || filter.has_times();
  std::string block = "b.node", columns, tables, conditions;
  if (tells_inside) {
    for_each_inside_condition(filter, [&](std::string_view condition, std::int64_t) {
      columns += columns.empty() ? ", " : " AND ";
      columns += condition;
    });
  }
  for (std::size_t i = 0; i < postings.size(); ++i) {
    columns += fmt::format(", p{}.rows", i);
    tables += fmt::format("{}measurement_postings p{}", i == 0 ? "" : " CROSS JOIN ", i);
    conditions += fmt::format("p{0}.field = ? AND p{0}.value = ? AND ", i);
    if (i > 0) conditions += fmt::format("p{}.block = p0.block AND ", i);
    block = "p0.block";
  }
  if (has_nodes) {
    tables += fmt::format("{}measurement_nodes b", postings.empty() ? "" : " CROSS JOIN ");
    conditions += "b.level = 0 AND ";
    if (!postings.empty()) conditions += "b.node = p0.block AND ";
  }
  conditions += block + " BETWEEN ? AND ?";
  for_each_time_condition(filter, [&](std::string_view condition, std::int64_t) {
    conditions += " AND ";
    conditions += condition;
  });
  return statement(fmt::format("SELECT {0}{1} FROM {2} WHERE {3} ORDER BY {0}{4}", block, columns,
                               tables, conditions, direction(reading.order)));
}

/// Notes are few, as people write them: from one block with some to the next.
bool MeasurementQuery::run_noted(const Reading& reading, Statement& matching, const IdSpan& ids) {
  const MeasurementFilter& filter = reading.filter;
  const std::vector<FieldValue> postings = postings_of(filter);
  const std::string where = fmt::format(
      "FROM notes WHERE measurement BETWEEN ? AND ? AND received_at >= ? AND received_at < ?{}",
      filter.cause ? " AND cause = ?" : "");
  const bool newest = reading.order == ListOrder::NewestFirst;
  Statement& next =
      statement(fmt::format("SELECT {}(measurement) {}", newest ? "max" : "min", where));
  Statement& in_block = statement("SELECT measurement " + where);
  for (Statement* notes : {&next, &in_block}) {
    notes->bind(3, filter.noted_from_ns.value_or(kFirstTime));
    notes->bind(4, filter.noted_to_ns.value_or(kLastTime));
    if (filter.cause) notes->bind(5, std::string_view(*filter.cause));
  }
  for (IdSpan left = ids; !left.empty();) {
    next.bind(1, left.first);
    next.bind(2, left.last);
    const auto found = next.returning<std::optional<std::int64_t>>();
    if (!found) return true;
    const IndexNode block = IndexNode::of(*found, 0);
    const IdSpan whole = block.ids();
    in_block.bind(1, whole.first);
    in_block.bind(2, whole.last);
    RowSet wanted;
    for (Rows rows = in_block.query(); rows.next();)
      wanted.add(rows.get<std::int64_t>(0) - whole.first);
    for (const FieldValue& posting : postings) {
      if (wanted.empty() || is_source(posting)) break;
      wanted &= rows_in_block(posting, block.node);
    }
    if (!run_block(reading, matching, ids, wanted, block.node)) return false;
    if (newest) {
      left.last = whole.first - 1;
    } else {
      left.first = whole.last + 1;
    }
  }
  return true;
}

RowSet MeasurementQuery::rows_in_block(const FieldValue& posting, std::int64_t block) {
  Rows rows = block_rows_.query(posting.field, posting.value, block);
  return rows.next() ? RowSet::decode(rows.get<Blob>(0).bytes) : RowSet();
}

/// Reads adjacent rows of a block at once; excluded rows between them do not match either, and
/// skipping them is cheaper than another request to a server.
bool MeasurementQuery::run_block(const Reading& reading, Statement& matching, const IdSpan& ids,
                                 const RowSet& rows, std::int64_t block) {
  const IdSpan whole = IndexNode{0, block}.ids();
  const IdSpan looked_at = intersection(ids, whole);
  if (reading.read_block) {
    const BlockRead read = reading.read_block(block, rows, looked_at);
    if (read != BlockRead::Passed) return read == BlockRead::Taken;
  }
  std::vector<IdSpan> runs;
  for (std::int64_t id = looked_at.first; id <= looked_at.last; ++id) {
    if (!rows.contains(id - whole.first)) continue;
    if (!runs.empty() && (runs.back().last == id - 1 || !connection_.dialect().streams)) {
      runs.back().last = id;
    } else {
      runs.push_back({id, id});
    }
  }
  if (reading.order == ListOrder::NewestFirst) std::ranges::reverse(runs);
  return std::ranges::all_of(
      runs, [&](const IdSpan& run) { return scan(matching, run, reading.order, reading.visit); });
}

Statement& MeasurementQuery::statement(const std::string& sql) {
  const auto found = statements_.find(sql);
  if (found != statements_.end()) return found->second;
  return statements_.try_emplace(sql, connection_, sql).first->second;
}

}  // namespace fitgauge::store
