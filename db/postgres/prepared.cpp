#include "db/postgres/connection.hpp"

#include "db/store/measurement_row.hpp"

namespace fitgauge::store::postgres {
namespace {

/// `?` and `?1` become `$1`; quoted text does not change.
std::string with_numbers(std::string_view sql) {
  std::string made;
  int last = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < sql.size(); ++i) {
    if (sql[i] == '\'') quoted = !quoted;
    if (sql[i] != '?' || quoted) {
      made += sql[i];
      continue;
    }
    int number = 0;
    while (i + 1 < sql.size() && sql[i + 1] >= '0' && sql[i + 1] <= '9') {
      number = 10 * number + (sql[++i] - '0');
    }
    if (number == 0) number = last + 1;
    last = std::max(last, number);
    made += '$' + std::to_string(number);
  }
  return made;
}

Oid type_of(sql::Kind kind) {
  switch (kind) {
    case sql::Kind::Integer: return kInt8;
    case sql::Kind::Text: return kText;
    case sql::Kind::Bytes: return kBytes;
  }
  return kText;
}

/// The month of a time, counted through the years.
std::int64_t month_of(std::int64_t at_ns) {
  using namespace std::chrono;
  const auto day = floor<days>(sys_time<nanoseconds>(nanoseconds(at_ns)));
  const year_month_day date(day);
  return 12 * static_cast<std::int64_t>(static_cast<int>(date.year())) +
         static_cast<std::int64_t>(static_cast<unsigned>(date.month()));
}

constexpr const char* kRowType = "SELECT 'measurements'::regtype::oid::bigint";
constexpr const char* kColumns =
    "SELECT attname::text FROM pg_attribute WHERE attrelid = 'measurements'::regclass AND attnum > "
    "0 "
    "AND NOT attisdropped ORDER BY attnum";

/// Sends rows as one value: an array of rows of the table. As with COPY, several statements run
/// while the next rows are made, but one statement needs no additional exchange with the server.
const std::string& append_sql() {
  static const std::string sql =
      fmt::format("INSERT INTO measurements ({0}) SELECT {0} FROM unnest($1::measurements[])",
                  measurement_columns());
  return sql;
}

template <class Value>
constexpr Oid type_of(const Value& /*value*/) {
  if constexpr (std::is_enum_v<Value>) return kInt2;
  if constexpr (std::is_integral_v<Value>) return kInt8;
  return kText;
}
template <class Value>
constexpr Oid type_of(const std::optional<Value>& /*value*/) {
  return type_of(Value());
}

void append_value(std::string& bytes, std::string_view value) { bytes += value; }
/// The codes are smallint, the numbers bigint.
template <class Value>
void append_value(std::string& bytes,
                  const Value& value) requires(std::is_enum_v<Value> || std::is_integral_v<Value>) {
  if constexpr (std::is_enum_v<Value>) {
    append_number(bytes, static_cast<std::int16_t>(code_of(value)));
  } else {
    append_number(bytes, std::int64_t{value});
  }
}

/// The bytes of a field of a row or an element of an array; -1 is the length of a NULL.
template <class Value>
void append_counted_value(std::string& bytes, const Value& value) {
  append_counted(bytes, [&] { append_value(bytes, value); });
}
template <class Value>
void append_counted_value(std::string& bytes, const std::optional<Value>& value) {
  if (value) return append_counted_value(bytes, *value);
  append_number(bytes, std::int32_t{-1});
}

/// Calls `add(column, type, value)` for all that a row has.
template <class Add>
void for_each_column(const MeasurementRow& row, const Add& add) {
  add("id", kInt8, row.id);
  for_each_field(
      row, [&](std::string_view column, const auto& value) { add(column, type_of(value), value); });
  add("hash", kBytes,
      std::string_view(reinterpret_cast<const char*>(row.hash.data()), row.hash.size()));
}

}  // namespace

Prepared::Prepared(Connection& connection, std::string_view sql)
    : connection_(connection), sql_(with_numbers(sql)), name_(connection.new_name()) {}

void Prepared::bind(int index, const Parameter& value) {
  const auto place = static_cast<std::size_t>(index - 1);
  if (values_.size() <= place) {
    values_.resize(place + 1);
    types_have_changed_ = true;
  }
  types_have_changed_ |= values_[place].type != value.type;
  values_[place] = value;
}

void Prepared::bind_null(int index, sql::Kind kind) { bind(index, {.type = type_of(kind)}); }

void Prepared::bind_integer(int index, std::int64_t value) {
  bind(index, {.type = kInt8, .is_null = false, .integer = value});
}

void Prepared::bind_text(int index, std::string_view value) {
  if (value.find('\0') != std::string_view::npos) {
    throw std::logic_error("PostgreSQL does not store a text with a NUL character");
  }
  bind(index, {.type = kText, .is_null = false, .bytes = value});
}

void Prepared::bind_blob(int index, std::string_view bytes) {
  bind(index, {.type = kBytes, .is_null = false, .bytes = bytes});
}

void Prepared::send() {
  if (types_have_changed_) {
    connection_.forget(name_);
    name_ = connection_.new_name();
    types_have_changed_ = false;
  }
  connection_.send(name_, sql_, values_);
}

bool Prepared::step() {
  if (!result_) {
    send();
    result_ = connection_.wait();
    row_ = -1;
  }
  return ++row_ < PQntuples(result_.get());
}

std::string_view Prepared::text(int column) const {
  return {PQgetvalue(result_.get(), row_, column),
          static_cast<std::size_t>(PQgetlength(result_.get(), row_, column))};
}

/// Migrations append columns, whatever the order of for_each_column.
void MeasurementTable::read_type() {
  row_type_ = static_cast<Oid>(sql::Statement(connection_, kRowType).returning<std::int64_t>());
  std::map<std::string, std::size_t, std::less<>> indices;
  for_each_column(MeasurementRow(), [&](std::string_view column, Oid /*type*/, const auto&) {
    indices.emplace(column, indices.size());
  });
  sql::Statement columns(connection_, kColumns);
  for (sql::Rows rows = columns.query(); rows.next();) {
    order_.push_back(indices.at(rows.get<std::string>(0)));
  }
}

/// The columns as the table has them.
void MeasurementTable::append_row(std::string& bytes, const MeasurementRow& row) {
  values_.clear();
  ends_.assign(1, 0);
  for_each_column(row, [&](std::string_view /*column*/, Oid type, const auto& value) {
    append_number(values_, type);
    append_counted_value(values_, value);
    ends_.push_back(values_.size());
  });
  append_number(bytes, static_cast<std::int32_t>(order_.size()));
  for (const std::size_t i : order_) bytes.append(values_, ends_[i], ends_[i + 1] - ends_[i]);
}

void MeasurementTable::make_parts(std::span<const MeasurementRow> rows) {
  if (std::exchange(connection_.parts_may_be_undone, false)) parts_.clear();
  for (const MeasurementRow& row : rows) {
    const std::pair part(row.origin.value_or(0), month_of(row.received_at_ns));
    if (!parts_.insert(part).second) continue;
    make_part_.run(part.first, row.received_at_ns);
  }
}

/// An array of one dimension, whose first element is numbered 1.
std::string MeasurementTable::begin_array(std::size_t rows) {
  if (row_type_ == 0) read_type();
  std::string bytes;
  append_number(bytes, std::int32_t{1});
  append_number(bytes, std::int32_t{0});  // no NULLs
  append_number(bytes, row_type_);
  append_number(bytes, static_cast<std::int32_t>(rows));
  append_number(bytes, std::int32_t{1});
  return bytes;
}

void MeasurementTable::append(std::span<const MeasurementRow> rows) {
  if (rows.empty()) return;
  make_parts(rows);
  std::string bytes = begin_array(rows.size());
  Head& head = connection_.head;
  MeasurementRow placed;
  for (const MeasurementRow& row : rows) {
    placed = row;
    if (!row.is_forwarded()) {
      placed.origin = 0;
      placed.seq = ++head.own_rows;
    }
    append_counted(bytes, [&] { append_row(bytes, placed); });
  }
  const Parameter array{.type = kAsTheStatementSays, .is_null = false, .bytes = bytes};
  connection_.send("append", append_sql(), std::span(&array, 1));
  head.last_id = rows.back().id;
}

}  // namespace fitgauge::store::postgres
