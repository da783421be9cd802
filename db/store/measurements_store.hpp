#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "store/measurement_chain.hpp"
#include "store/measurement_filter.hpp"
#include "store/measurement_row.hpp"
#include "store/measurement_summary.hpp"

namespace fitgauge::store {

namespace sqlite {
class Connection;
}

/// A run of ids: first to last, both included.
struct IdRange {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

/// Measurements, kept for ever: the database refuses UPDATE and DELETE. Rows carry a chain of
/// SHA-256 hashes (MeasurementChain).
class MeasurementsStore {
 public:
  explicit MeasurementsStore(sqlite::Connection& connection);
  ~MeasurementsStore();

  /// Appends rows in the order given. A row with `correction_of` must name the current row of its
  /// chain.
  /// @errors MeasurementUnknown when it names no row; MeasurementCorrected when that one was
  ///   corrected before.
  Result<IdRange> append(std::span<MeasurementRow> rows);

  /// The same of rows that a MeasurementChain has linked to chain_end() in the same transaction, on
  /// another thread it may be: hashing takes a sixth of the time of appending.
  Result<void> append_linked(std::span<const MeasurementRow> rows);

  MeasurementChain::End chain_end() const;

  using Visitor = std::function<void(const MeasurementRow&)>;

  /// @returns whether there is such a row; `visit` was called with it if so.
  bool find(std::int64_t id, const Visitor& visit) const;

  /// The id of the row that corrects `id`, if one does.
  std::optional<std::int64_t> corrected_by(std::int64_t id) const;

  /// Visits up to `limit` rows that match, in storage order, those after `after` (0: from the
  /// first). @returns the cursor for the next page, or none when this was the last.
  std::optional<std::int64_t> list(const MeasurementFilter& filter, std::int64_t after,
                                   std::size_t limit, const Visitor& visit) const;

  /// The newest id, 0 when there is none.
  std::int64_t last_id() const;

  /// @errors QueryInvalid when there are more than `max_groups` groups.
  Result<std::vector<SummaryGroup>> summary(const MeasurementFilter& filter, GroupBy group_by,
                                            std::size_t max_groups = 10'000) const;

  /// Takes the next block of rows into the tables that make filters fast; for idle times.
  /// @returns whether there was a whole block.
  bool index_block();

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
