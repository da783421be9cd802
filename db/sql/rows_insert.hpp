#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "db/sql/connection.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store::sql {

/// Inserts many rows: with few statements where each is a message to a server. A file takes a row
/// at a time as quickly.
class RowsInsert {
 public:
  /// @param into what stands before the rows: `INSERT INTO t VALUES `. @param row `(?, ?)`.
  RowsInsert(Connection& connection, std::string into, std::string row)
      : connection_(connection),
        into_(std::move(into)),
        row_(std::move(row)),
        most_rows_(connection.dialect().is_shared ? kMostRows : 1) {}

  /// @param bind called with each row and a function that takes its values, as Statement::run does;
  ///   texts live until all rows are inserted.
  template <class Many, class Bind>
  void run(const Many& rows, const Bind& bind) {
    auto row = rows.begin();
    for (std::size_t left = rows.size(); left > 0;) {
      // Powers of two: few statements fit every number of rows.
      const std::size_t count = std::min(std::bit_floor(left), most_rows_);
      Statement& statement = statement_for(count);
      int index = 0;
      for (std::size_t i = 0; i < count; ++i, ++row) {
        bind(*row, [&](const auto&... values) { (statement.bind(++index, values), ...); });
      }
      statement.run();
      left -= count;
    }
  }

 private:
  static constexpr std::size_t kMostRows = 32;

  Statement& statement_for(std::size_t rows) {
    const auto found = statements_.find(rows);
    if (found != statements_.end()) return found->second;
    std::string sql = into_ + row_;
    for (std::size_t i = 1; i < rows; ++i) sql += ", " + row_;
    return statements_.try_emplace(rows, connection_, std::move(sql)).first->second;
  }

  Connection& connection_;
  const std::string into_;
  const std::string row_;
  const std::size_t most_rows_;
  std::map<std::size_t, Statement> statements_;
};

}  // namespace fitgauge::store::sql
