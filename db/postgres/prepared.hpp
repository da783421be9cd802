#pragma once

#include "db/postgres/connection.hpp"
#include "db/sql/connection.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store::postgres {

/// Adds a number as PostgreSQL's binary formats write it: the highest byte first.
template <class Integer>
void append_number(std::string& bytes, Integer value) {
  std::array<char, sizeof(Integer)> written{};
  auto rest = static_cast<std::uint64_t>(value);
  for (auto byte = written.rbegin(); byte != written.rend(); ++byte, rest >>= 8U) {
    *byte = static_cast<char>(rest);
  }
  bytes.append(written.data(), written.size());
}

/// Adds the bytes that `make` adds, with their number before them.
template <class Make>
void append_counted(std::string& bytes, const Make& make) {
  const std::size_t place = bytes.size();
  bytes.append(sizeof(std::int32_t), '\0');
  make();
  std::string count;
  append_number(count, static_cast<std::int32_t>(bytes.size() - place - sizeof(std::int32_t)));
  bytes.replace(place, count.size(), count);
}

/// A signed number of one to eight bytes.
inline std::int64_t read_number(std::string_view bytes) {
  if (bytes.empty()) return 0;
  auto value =
      static_cast<std::uint64_t>(static_cast<std::int64_t>(static_cast<signed char>(bytes[0])));
  for (const char byte : bytes.substr(1)) value = value << 8U | static_cast<unsigned char>(byte);
  return static_cast<std::int64_t>(value);
}

/// A statement of a connection, prepared on the server at its first run with the types of its
/// parameters. A query fetches all rows at once.
class Prepared final : public sql::Prepared {
 public:
  Prepared(Connection& connection, std::string_view sql);
  ~Prepared() override { connection_.forget(name_); }

  void bind_null(int index, sql::Kind kind) override;
  void bind_integer(int index, std::int64_t value) override;
  void bind_text(int index, std::string_view value) override;
  void bind_blob(int index, std::string_view bytes) override;

  void run() override { send(); }
  bool step() override;
  void reset() noexcept override { result_.reset(); }

  int columns() const override { return PQnfields(result_.get()); }
  bool is_null(int column) const override { return PQgetisnull(result_.get(), row_, column) != 0; }
  std::int64_t integer(int column) const override { return read_number(text(column)); }
  std::string_view text(int column) const override;
  std::string_view blob(int column) const override { return text(column); }

 private:
  void bind(int index, const Parameter& value);
  void send();

  Connection& connection_;
  std::string sql_;
  std::string name_;
  std::vector<Parameter> values_;
  bool types_have_changed_ = false;
  ResultPtr result_;
  int row_ = -1;
};

/// Appends rows, and makes the partition of the table for its first row. Every row has its origin
/// and its place in that log.
class MeasurementTable final : public sql::MeasurementTable {
 public:
  explicit MeasurementTable(Connection& connection) : connection_(connection) {}

  void append(std::span<const MeasurementRow> rows) override;
  /// Returns the head's last id in a transaction that writes, and the committed one in others.
  std::int64_t last_id() override { return connection_.head.last_id; }
  std::optional<std::int64_t> own_rows() override { return connection_.head.own_rows; }

 private:
  void make_parts(std::span<const MeasurementRow> rows);
  std::string begin_array(std::size_t rows);
  void read_type();
  void append_row(std::string& bytes, const MeasurementRow& row);

  Connection& connection_;
  sql::Statement make_part_{connection_, "SELECT make_measurement_part(?, ?)"};
  Oid row_type_ = 0;                ///< of the table; 0 until it was asked for
  std::vector<std::size_t> order_;  ///< of the table's columns: their indices in a row
  std::string values_;              ///< of one row, and the end of each
  std::vector<std::size_t> ends_;
  std::set<std::pair<std::int64_t, std::int64_t>> parts_;  ///< origin and month that are there
};

}  // namespace fitgauge::store::postgres
