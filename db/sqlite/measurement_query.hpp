#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "sqlite/statement.hpp"
#include "store/measurement_filter.hpp"

namespace fitgauge::store {

/// Finds the measurements that match a filter, in storage order: first those the lookup tables know
/// (by the value of a text field, or in the blocks that hold the time range), then the newer ones
/// by a scan.
class MeasurementQuery {
 public:
  /// @param columns what to select of the table `m`.
  MeasurementQuery(sqlite::Connection& connection, std::string_view columns);

  /// Called for each row; false ends the query.
  using Visitor = std::function<bool(const sqlite::Rows&)>;

  /// Visits the rows after the id `after`.
  void run(const MeasurementFilter& filter, std::int64_t after, const Visitor& visit);

 private:
  sqlite::Statement scan_;
  sqlite::Statement lookup_;
  sqlite::Statement last_block_;
  sqlite::Statement blocks_in_range_;
};

/// Fills the lookup tables, a block of rows at a time.
class MeasurementLookup {
 public:
  explicit MeasurementLookup(sqlite::Connection& connection);

  /// @returns whether there was a whole block to take in.
  bool take_in_block();

 private:
  sqlite::Statement next_block_;
  sqlite::Statement insert_block_;
  sqlite::Statement insert_values_;
};

}  // namespace fitgauge::store
