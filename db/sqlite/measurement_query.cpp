#include "sqlite/measurement_query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace fitgauge::store {
namespace {

using sqlite::Rows;

constexpr std::int64_t kBlock = 1024;  ///< rows; the rest is scanned by every query
constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();

/// ?1 and ?2 are the ids between which to look, ?3 the newest id that counts.
constexpr std::string_view kMatches =
    "m.id > ?1 AND m.id <= ?2 AND (?4 IS NULL OR m.part_id = ?4) "
    "AND (?5 IS NULL OR m.work_order = ?5) AND (?6 IS NULL OR m.characteristic = ?6) "
    "AND (?7 IS NULL OR m.machine = ?7) AND (?8 IS NULL OR m.verdict = ?8) "
    "AND (?9 IS NULL OR m.source = ?9) AND (?10 IS NULL OR m.measured_at >= ?10) "
    "AND (?11 IS NULL OR m.measured_at < ?11) AND (?12 OR NOT EXISTS "
    "(SELECT 1 FROM measurements c WHERE c.correction_of = m.id AND c.id <= ?3))";

/// The ids after `after` up to and including `last`.
struct Span {
  std::int64_t after = 0;
  std::int64_t last = 0;
};

/// A field of the lookup table, by its number there, with the value asked for.
struct LookupValue {
  int field = 0;
  std::string_view value;
};

/// The field that is likely to have the fewest rows for a value.
std::optional<LookupValue> lookup_value(const MeasurementFilter& filter) {
  if (filter.part_id) return LookupValue{1, *filter.part_id};
  if (filter.order) return LookupValue{2, *filter.order};
  if (filter.characteristic) return LookupValue{3, *filter.characteristic};
  if (filter.machine) return LookupValue{4, *filter.machine};
  return std::nullopt;
}

template <class... More>
Rows query(sqlite::Statement& statement, const MeasurementFilter& filter, Span span,
           const More&... more) {
  return statement.query(span.after, span.last, filter.as_of_id.value_or(kEnd), filter.part_id,
                         filter.order, filter.characteristic, filter.machine, filter.verdict,
                         filter.source, filter.from_ns, filter.to_ns, filter.history, more...);
}

/// @returns false when the visitor ended the query.
bool visit_all(Rows rows, const MeasurementQuery::Visitor& visit) {
  while (rows.next()) {
    if (!visit(rows)) return false;
  }
  return true;
}

}  // namespace

MeasurementQuery::MeasurementQuery(sqlite::Connection& connection, std::string_view columns)
    : scan_(connection,
            fmt::format("SELECT {} FROM measurements m WHERE {} ORDER BY m.id", columns, kMatches)),
      lookup_(connection,
              fmt::format("SELECT {} FROM measurement_lookup l CROSS JOIN measurements m "
                          "ON m.id = l.measurement WHERE l.field = ?13 AND l.value = ?14 "
                          "AND l.measurement > ?1 AND l.measurement <= ?2 AND {} "
                          "ORDER BY l.measurement",
                          columns, kMatches)),
      last_block_(connection, "SELECT coalesce(max(last_id), 0) FROM measurement_blocks"),
      blocks_in_range_(connection,
                       "SELECT min(first_id), max(last_id) FROM measurement_blocks WHERE "
                       "(?1 IS NULL OR max_measured_at >= ?1) AND "
                       "(?2 IS NULL OR min_measured_at < ?2)") {}

void MeasurementQuery::run(const MeasurementFilter& filter, std::int64_t after,
                           const Visitor& visit) {
  const std::int64_t last = filter.as_of_id.value_or(kEnd);
  const auto last_block = last_block_.returning<std::int64_t>();
  Span known{after, std::min(last, last_block)};
  if (filter.from_ns || filter.to_ns) {
    Rows blocks = blocks_in_range_.query(filter.from_ns, filter.to_ns);
    blocks.next();
    known.after = std::max(known.after, blocks.get<std::int64_t>(0) - 1);
    known.last = std::min(known.last, blocks.get<std::int64_t>(1));
  }
  if (known.after < known.last) {
    const std::optional<LookupValue> wanted = lookup_value(filter);
    const bool more =
        wanted ? visit_all(query(lookup_, filter, known, wanted->field, wanted->value), visit)
               : visit_all(query(scan_, filter, known), visit);
    if (!more) return;
  }
  visit_all(query(scan_, filter, {std::max(after, last_block), last}), visit);
}

MeasurementLookup::MeasurementLookup(sqlite::Connection& connection)
    : next_block_(connection,
                  "SELECT min(id), max(id), min(measured_at), max(measured_at) FROM (SELECT id, "
                  "measured_at "
                  "FROM measurements WHERE id > (SELECT coalesce(max(last_id), 0) "
                  "FROM measurement_blocks) ORDER BY id LIMIT ?) HAVING count(*) = ?1"),
      insert_block_(connection, "INSERT INTO measurement_blocks VALUES (?, ?, ?, ?)"),
      // The four fields side by side: each row of the block is read once for all of them.
      insert_values_(connection,
                     "INSERT INTO measurement_lookup "
                     "SELECT f.field, CASE f.field WHEN 1 THEN m.part_id WHEN 2 THEN m.work_order "
                     "WHEN 3 THEN m.characteristic ELSE m.machine END AS value, m.id "
                     "FROM measurements m CROSS JOIN "
                     "(SELECT 1 AS field UNION ALL SELECT 2 UNION ALL SELECT 3 UNION ALL SELECT 4) "
                     "f WHERE m.id BETWEEN ?1 AND ?2 AND value IS NOT NULL "
                     "ORDER BY f.field, value, m.id") {}

bool MeasurementLookup::take_in_block() {
  Rows block = next_block_.query(kBlock);
  if (!block.next()) return false;
  const auto first = block.get<std::int64_t>(0);
  const auto last = block.get<std::int64_t>(1);
  insert_block_.run(first, last, block.get<std::int64_t>(2), block.get<std::int64_t>(3));
  insert_values_.run(first, last);
  return true;
}

}  // namespace fitgauge::store
