#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "db/postgres/connection.hpp"
#include "db/sql/measurement_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store::postgres {

/// Appends rows, and makes the part of the table that a row goes to where it is the first.
/// Every row says whose it is and where it stands in that log.
class MeasurementTable final : public sql::MeasurementTable {
 public:
  explicit MeasurementTable(Connection& connection);

  void append(std::span<const MeasurementRow> rows) override;
  /// In a transaction that writes as the head has it; else as it was committed.
  std::int64_t last_id() override { return connection_.head.last_id; }
  std::optional<std::int64_t> own_rows() override { return connection_.head.own_rows; }

 private:
  void make_parts(std::span<const MeasurementRow> rows);
  std::string begin_array(std::size_t rows);
  void read_type();
  void append_row(std::string& bytes, const MeasurementRow& row);

  Connection& connection_;
  sql::Statement make_part_;
  Oid row_type_ = 0;                ///< of the table; 0 until it was asked for
  std::vector<std::size_t> order_;  ///< of the table's columns: their indices in a row
  std::string values_;              ///< of one row, and where each of them ends
  std::vector<std::size_t> ends_;
  std::set<std::pair<std::int64_t, std::int64_t>> parts_;  ///< origin and month that are there
};

}  // namespace fitgauge::store::postgres
