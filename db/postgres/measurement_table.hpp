#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>

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

  Connection& connection_;
  sql::Statement make_part_;
  Oid row_type_ = 0;  ///< of the table; 0 until it was asked for
  std::set<std::pair<std::int64_t, std::int64_t>> parts_;  ///< origin and month that are there
};

}  // namespace fitgauge::store::postgres
