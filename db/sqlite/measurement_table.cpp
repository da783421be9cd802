#include "db/sqlite/connection.hpp"

#include "db/sql/statement.hpp"
#include "db/store/measurement_row.hpp"

namespace fitgauge::store::sqlite {
namespace {

constexpr std::size_t kMostRowsPerStatement = 32;
/// Number of cached statements, one for each combination of fields; other combinations use the
/// statement with all columns.
constexpr std::size_t kMostStatements = 64;

template <class T>
bool is_given(const T&) {
  return true;
}
template <class T>
bool is_given(const std::optional<T>& value) {
  return value.has_value();
}

constexpr unsigned kFields = [] {
  unsigned count = 0;
  for_each_field(MeasurementRow(), [&count](std::string_view, const auto&) { ++count; });
  return count;
}();

}  // namespace

MeasurementTable::MeasurementTable(Connection& connection)
    : connection_(connection),
      newest_(connection, "SELECT id FROM measurements ORDER BY id DESC LIMIT 1") {}

std::int64_t MeasurementTable::last_id() {
  return read_first<std::int64_t>(newest_.query()).value_or(0);
}

void MeasurementTable::append(std::span<const MeasurementRow> rows) {
  while (!rows.empty()) {
    // Powers of two: few statements fit every number of rows.
    const std::size_t count = std::min(std::bit_floor(rows.size()), kMostRowsPerStatement);
    insert(rows.first(count));
    rows = rows.subspan(count);
  }
}

MeasurementTable::Fields MeasurementTable::fields_of(std::span<const MeasurementRow> rows) {
  static_assert(kFields <= 8 * sizeof(Fields));
  Fields fields = 0;
  for (const MeasurementRow& row : rows) {
    unsigned bit = 0;
    for_each_field(row, [&](std::string_view /*column*/, const auto& value) {
      fields |= Fields{is_given(value)} << bit++;
    });
  }
  return fields;
}

std::string MeasurementTable::insert_sql(const Shape& shape) {
  std::string columns;
  std::string values = "(";
  unsigned bit = 0;
  for_each_field(MeasurementRow(), [&](std::string_view column, const auto&) {
    if (!contains(shape.fields, bit++)) return;
    columns += fmt::format("{}, ", column);
    values += "?,";
  });
  values += "?)";
  std::string sql = fmt::format("INSERT INTO measurements ({}hash) VALUES {}", columns, values);
  for (std::size_t i = 1; i < shape.rows; ++i) sql += ',' + values;
  return sql;
}

std::pair<const MeasurementTable::Shape, Prepared>& MeasurementTable::statement_for(
    const Shape& shape) {
  const auto found = statements_.find(shape);
  if (found != statements_.end()) return *found;
  const Shape made = statements_.size() < kMostStatements ? shape : Shape{kAllFields, shape.rows};
  return *statements_.try_emplace(made, connection_, insert_sql(made)).first;
}

void MeasurementTable::insert(std::span<const MeasurementRow> rows) {
  auto& made = statement_for({fields_of(rows), rows.size()});
  const Fields fields = made.first.fields;
  Prepared& statement = made.second;
  int index = 0;
  for (const MeasurementRow& row : rows) {
    unsigned bit = 0;
    for_each_field(row, [&](std::string_view /*column*/, const auto& value) {
      if (contains(fields, bit++)) sql::bind_value(statement, ++index, value);
    });
    sql::bind_value(statement, ++index, row.hash);
  }
  statement.run();
  // SQLite finds the end of the table without a search if it assigns the ids.
  if (const std::int64_t id = rows.back().id; connection_.last_inserted_id() != id) {
    throw std::logic_error(fmt::format("measurement {} was stored with another id", id));
  }
}

}  // namespace fitgauge::store::sqlite
