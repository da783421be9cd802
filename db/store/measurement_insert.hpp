#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "store/measurement_hash.hpp"
#include "store/sqlite/statement.hpp"

namespace fitgauge::store {

/// Inserts measurements at the end of the chain, many rows a statement: stepping a statement for
/// every row takes twice as long.
class MeasurementInsert {
 public:
  explicit MeasurementInsert(sqlite::Connection& connection);

  /// The place a row gets: the one after `last`.
  struct Place {
    std::int64_t id = 0;
    Digest hash{};
  };
  /// @returns the place of the last row.
  Place append(Place last, std::span<const MeasurementRow> rows);

 private:
  void bind_and_run(sqlite::Statement& statement, std::span<const MeasurementRow> rows,
                    Place& last);

  sqlite::Statement many_;
  sqlite::Statement one_;
  MeasurementHasher hasher_;
  std::vector<Digest> hashes_;  ///< bound without a copy while a statement runs
};

}  // namespace fitgauge::store
