#include "store/measurement_insert.hpp"

#include <fmt/format.h>

#include "store/measurement_fields.hpp"

namespace fitgauge::store {
namespace {

constexpr std::size_t kRowsPerStatement = 32;

std::string insert_sql(std::size_t rows) {
  const std::string columns = measurement_columns();
  std::string values = "(?";
  for (const char c : columns) {
    if (c == ',') values += ",?";
  }
  values += ')';
  std::string sql = fmt::format("INSERT INTO measurements ({}) VALUES {}", columns, values);
  for (std::size_t i = 1; i < rows; ++i) sql += ',' + values;
  return sql;
}

}  // namespace

MeasurementInsert::MeasurementInsert(sqlite::Connection& connection)
    : many_(connection, insert_sql(kRowsPerStatement)),
      one_(connection, insert_sql(1)),
      hashes_(kRowsPerStatement) {}

MeasurementInsert::Place MeasurementInsert::append(Place last,
                                                   std::span<const MeasurementRow> rows) {
  for (; rows.size() >= kRowsPerStatement; rows = rows.subspan(kRowsPerStatement)) {
    bind_and_run(many_, rows.first(kRowsPerStatement), last);
  }
  for (; !rows.empty(); rows = rows.subspan(1)) bind_and_run(one_, rows.first(1), last);
  return last;
}

void MeasurementInsert::bind_and_run(sqlite::Statement& statement,
                                     std::span<const MeasurementRow> rows, Place& last) {
  int index = 0;
  const auto bind = [&](const char*, const auto& value) { statement.bind(++index, value); };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ++last.id;
    last.hash = hashes_[i] = hasher_(last.hash, last.id, rows[i]);
    bind("id", last.id);
    for_each_field(rows[i], bind);
    bind("hash", hashes_[i]);
  }
  statement.run();
}

}  // namespace fitgauge::store
