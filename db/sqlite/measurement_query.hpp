#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sqlite/statement.hpp"
#include "store/measurement_filter.hpp"
#include "store/measurement_index.hpp"

namespace fitgauge::store {

/// The end of what is indexed: rows up to this id are in blocks. 0 when none is.
std::int64_t indexed_to(sqlite::Statement& last_block);
sqlite::Statement last_block_statement(sqlite::Connection& connection);

/// That no correction takes the place of a row `m`: none names it, and of rivals, which name the
/// same record, none later than it or a correction that it goes back to. @param last the last id
/// that counts, or a parameter, which stands once in each.
struct CurrentCondition {
  std::string is_not_corrected;
  std::string has_no_later_rival;

  explicit CurrentCondition(std::string_view last);
  std::string both() const { return is_not_corrected + " AND " + has_no_later_rival; }
};

/// Finds the measurements that match a filter, in either order: of the indexed blocks those that
/// hold the values asked for, and in the newer rows all.
class MeasurementQuery {
 public:
  /// @param columns what to select of the table `m`.
  MeasurementQuery(sqlite::Connection& connection, std::string columns);

  /// Called for each row; false ends the query.
  using Visitor = std::function<bool(const sqlite::Rows&)>;

  /// Visits the matching rows among `ids`. @returns false when the visitor ended the query.
  bool run(const MeasurementFilter& filter, const IdSpan& ids, ListOrder order,
           const Visitor& visit);

 private:
  /// A value that the index knows the rows of.
  struct Posting {
    int field = 0;
    std::string value;
  };
  static std::vector<Posting> postings_of(const MeasurementFilter& filter);

  sqlite::Statement& matching_rows(const MeasurementFilter& filter, ListOrder order);
  static bool scan(sqlite::Statement& matching, const IdSpan& ids, const Visitor& visit);
  bool run_indexed(const MeasurementFilter& filter, sqlite::Statement& matching, const IdSpan& ids,
                   ListOrder order, const Visitor& visit);
  bool run_block(sqlite::Statement& matching, const IdSpan& ids, const RowSet& rows,
                 std::int64_t block, ListOrder order, const Visitor& visit);
  RowSet rows_in_block(const Posting& posting, std::int64_t block);
  sqlite::Statement& statement(const std::string& sql);

  sqlite::Connection& connection_;
  const std::string columns_;
  sqlite::Statement last_block_;
  sqlite::Statement block_rows_;
  std::map<std::string, sqlite::Statement> statements_;  ///< by their text
};

}  // namespace fitgauge::store
