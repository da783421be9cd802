#include "postgres/measurement_table.hpp"

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <type_traits>

#include "postgres/wire.hpp"
#include "store/measurement_fields.hpp"

namespace fitgauge::store::postgres {
namespace {

/// The month of a time, counted through the years.
std::int64_t month_of(std::int64_t at_ns) {
  using namespace std::chrono;
  const auto day = floor<days>(sys_time<nanoseconds>(nanoseconds(at_ns)));
  const year_month_day date(day);
  return 12 * static_cast<std::int64_t>(static_cast<int>(date.year())) +
         static_cast<std::int64_t>(static_cast<unsigned>(date.month()));
}

void append_field(std::string& bytes, std::string_view value) {
  append_number(bytes, static_cast<std::int32_t>(value.size()));
  bytes += value;
}

/// The codes are smallint, the numbers bigint.
template <class Value>
void append_field(std::string& bytes,
                  const Value& value) requires(std::is_enum_v<Value> || std::is_integral_v<Value>) {
  using Stored = std::conditional_t<std::is_enum_v<Value>, std::int16_t, std::int64_t>;
  append_number(bytes, static_cast<std::int32_t>(sizeof(Stored)));
  append_number(bytes, static_cast<Stored>(value));
}

template <class Value>
void append_field(std::string& bytes, const std::optional<Value>& value) {
  if (value) return append_field(bytes, *value);
  append_number(bytes, std::int32_t{-1});
}

const std::string& copy_sql() {
  static const std::string sql =
      fmt::format("COPY measurements ({}) FROM STDIN (FORMAT binary)", measurement_columns());
  return sql;
}

void append_row(std::string& bytes, const MeasurementRow& row) {
  std::int16_t fields = 2;
  for_each_field(row, [&](const char*, const auto&) { ++fields; });
  append_number(bytes, fields);
  append_field(bytes, row.id);
  for_each_field(row, [&](const char*, const auto& value) { append_field(bytes, value); });
  append_field(bytes,
               std::string_view(reinterpret_cast<const char*>(row.hash.data()), row.hash.size()));
}

}  // namespace

MeasurementTable::MeasurementTable(Connection& connection)
    : connection_(connection), make_part_(connection, "SELECT make_measurement_part(?, ?)") {}

void MeasurementTable::make_parts(std::span<const MeasurementRow> rows) {
  if (std::exchange(connection_.parts_may_be_undone, false)) parts_.clear();
  for (const MeasurementRow& row : rows) {
    const std::pair part(row.origin.value_or(0), month_of(row.received_at_ns));
    if (!parts_.insert(part).second) continue;
    make_part_.run(part.first, row.received_at_ns);
  }
}

void MeasurementTable::append(std::span<const MeasurementRow> rows) {
  if (rows.empty()) return;
  make_parts(rows);
  std::string bytes;
  Head& head = connection_.head;
  MeasurementRow placed;
  for (const MeasurementRow& row : rows) {
    placed = row;
    if (!row.is_forwarded()) {
      placed.origin = 0;
      placed.seq = ++head.own_rows;
    }
    append_row(bytes, placed);
  }
  connection_.copy(copy_sql(), bytes);
  head.last_id = rows.back().id;
}

}  // namespace fitgauge::store::postgres
