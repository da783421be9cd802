#pragma once

#include "base/clock.hpp"
#include "db/store/measurement_index.hpp"
#include "db/store/measurement_row.hpp"
#include "db/store/on_connection.hpp"

namespace fitgauge::store {

/// Measurements, kept for ever: the database refuses UPDATE and DELETE.
class MeasurementsStore : public OnConnection<MeasurementsStore> {
 public:
  /// Appends rows, which have their hash and the ids from last_id() + 1 on. `correction_of` must
  /// name a row without a correction; if that row is a record of a station, the correction is
  /// numbered for that station (RevisionsStore).
  /// @errors MeasurementUnknown if it names no row; MeasurementCorrected if that row was corrected.
  Result<void> append(std::span<const MeasurementRow> rows);

  /// Appends rows of another folder, with their origin and their place in its log; otherwise as
  /// append(). Their targets may already have a correction.
  void append_forwarded(std::span<const MeasurementRow> rows);

  /// The id of the row that is called `number` at its origin, if it is here.
  std::optional<std::int64_t> find_forwarded(std::int64_t origin, std::int64_t number) const;

  using Visitor = std::function<void(const MeasurementRow&)>;

  /// @returns whether there is such a row; then `visit` was called with it.
  bool find(std::int64_t id, const Visitor& visit) const;

  /// Returns the id of the row that corrects `id`, if there is one. Of several corrections that
  /// were made apart, the one that was received last.
  std::optional<std::int64_t> corrected_by(std::int64_t id) const;

  /// Returns corrected_by(); for a correction with a later rival, the rival.
  std::optional<std::int64_t> replaced_by(std::int64_t id) const;

  /// Whether several corrections of that row were made apart from each other.
  bool has_rivals(std::int64_t correction_of) const;

  /// Visits up to `limit` rows of an origin (0: this folder) that come after the place `after` in
  /// its log, in the log's order.
  void list_log(std::int64_t origin, std::int64_t after, std::int64_t limit,
                const Visitor& visit) const;
  /// Receives the hashes of those rows. @returns their number.
  using HashVisitor = std::function<void(const Digest&)>;
  std::int64_t log_hashes(std::int64_t origin, std::int64_t after, std::int64_t limit,
                          const HashVisitor& visit) const;

  /// Visits up to `limit` matching rows, in storage order or newest first. Starts after the row
  /// `after` in that order (0: at the beginning). @returns the cursor for the next page; none after
  /// the last page.
  std::optional<std::int64_t> list(const MeasurementFilter& filter, std::int64_t after,
                                   std::size_t limit, const Visitor& visit,
                                   ListOrder order = ListOrder::OldestFirst) const;

  /// Lists only the values that figures need, oldest first: several times as fast as list().
  using RunVisitor = std::function<void(const MeasuredRun&)>;
  std::optional<std::int64_t> list_values(const MeasurementFilter& filter, std::int64_t after,
                                          std::size_t limit, const RunVisitor& visit) const;

  /// Calls `visit` with every correction up to `last` and the row that it corrects, in any order.
  using CorrectionVisitor = std::function<void(std::int64_t id, std::int64_t correction_of)>;
  void list_corrections(std::int64_t last, const CorrectionVisitor& visit) const;

  /// Returns the oldest of the newest `count` matching rows; none if no row matches.
  std::optional<std::int64_t> first_of_newest(const MeasurementFilter& filter,
                                              std::size_t count) const;

  /// Returns the number of rows that this folder itself recorded.
  std::int64_t log_size() const;

  /// The newest id, 0 when there is none.
  std::int64_t last_id() const;
  /// Returns the time of the newest record.
  std::optional<Timestamp> newest_received_at() const;

  /// @errors QueryInvalid when there are more than `max_groups` groups.
  Result<std::vector<SummaryGroup>> summary(const MeasurementFilter& filter, TextField group_by,
                                            std::size_t max_groups = 10'000) const;

  /// Adds the next block of rows to the index that makes filters and summaries fast, or repairs a
  /// part of it that a correction has made stale. @returns whether there was something to do.
  bool index_step();
  /// Derives the index again. @param note receives each difference, as a sentence.
  void verify_index(const std::function<void(std::string)>& note) const;
};

}  // namespace fitgauge::store
