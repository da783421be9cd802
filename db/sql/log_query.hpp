#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string_view>

#include "db/sql/statement.hpp"
#include "db/store/measurement_index.hpp"

namespace fitgauge::store {

/// A query for a part of a log: in a folder with its own rows alone, and up to the first row of
/// another, a row's place is its id; behind that, by its origin and place.
struct LogQuery {
  LogQuery(sql::Connection& c, std::string_view columns)
      : by_id(c, fmt::format("SELECT {} FROM measurements WHERE id > ? AND id <= ? ORDER BY id "
                             "LIMIT ?",
                             columns)),
        by_place(c, fmt::format("SELECT {} FROM measurements WHERE origin = ? AND seq > ? ORDER BY "
                                "seq LIMIT ?",
                                columns)) {}

  /// @param alone up to this id all rows are of this folder. @returns how many there were.
  template <class Visit>
  std::int64_t run(std::int64_t origin, std::int64_t alone, std::int64_t after, std::int64_t limit,
                   const Visit& visit) {
    std::int64_t count = 0;
    if (origin == 0 && after < alone) {
      for (sql::Rows rows = by_id.query(after, alone, limit); rows.next(); ++count) visit(rows);
      after += count;
    }
    if (count == limit || (origin == 0 && alone == kLastId)) return count;
    for (sql::Rows rows = by_place.query(origin, after, limit - count); rows.next(); ++count) {
      visit(rows);
    }
    return count;
  }

  sql::Statement by_id;
  sql::Statement by_place;
};

}  // namespace fitgauge::store
