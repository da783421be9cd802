#include "service/measurements/measurement_service.hpp"

#include "db/store/database.hpp"
#include "record/measurement.hpp"
#include "service/measurements/measurement_storage.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

Error unknown_cursor() {
  return {ErrorCode::CursorInvalid, "after must be the `next` of an earlier page"};
}

/// Returns the limit; none for an absent one, which is beyond every length. Older versions gave
/// values of cycles without limits the limits of every length.
std::optional<Length> limit_of(std::int64_t nanometres) {
  const Length limit = Length::nanometres(nanometres);
  return -kLongest < limit && limit < kLongest ? std::optional(limit) : std::nullopt;
}

/// Returns the row of the first value in a chain of corrections.
std::int64_t first_row_of(const Stores& stores, const MeasurementRow& row) {
  std::int64_t first = row.id;
  for (auto of = row.correction_of; of;) {
    first = *std::exchange(of, std::nullopt);
    stores.measurements.find(
        first, [&of](const MeasurementRow& corrected) { of = corrected.correction_of; });
  }
  return first;
}

bool is_in_conflict(const Stores& stores, const MeasurementRow& row) {
  return row.correction_of && stores.measurements.has_rivals(*row.correction_of);
}

}  // namespace

void MeasurementService::find(const RecordName& name, Visitor visit, Done<std::int64_t> done) {
  database_.readers().submit(
      [this, name, visit = std::move(visit)](const Stores& stores) -> Result<std::int64_t> {
        const RowNames names = row_names(tables_, origins_);
        const auto row = row_of(stores, name);
        const auto newer = row ? stores.measurements.corrected_by(*row) : std::nullopt;
        std::optional<Measurement> correction;
        if (newer) {
          stores.measurements.find(
              *newer, [&](const MeasurementRow& found) { correction = from_store(found, names); });
        }
        const bool found =
            row && stores.measurements.find(*row, [&](const MeasurementRow& original) {
              Measurement measurement = from_store(original, names);
              if (correction) {
                measurement.corrected_by = correction->id;
                measurement.corrected_by_origin = correction->origin;
              }
              measurement.conflict = is_in_conflict(stores, original);
              visit(measurement);
            });
        if (found) return *row;
        return unknown_measurement(name, origins_);
      },
      std::move(done));
}

void MeasurementService::list_notes(const RecordName& name, Done<std::vector<Note>> done) {
  database_.readers().submit(
      [this, name](const Stores& stores) -> Result<std::vector<Note>> {
        const auto row = TRY(existing_row_of(stores, name, origins_));
        return notes_of(stores, row,
                        measurement_id_text(name.number, origins_.digits(name.origin, name.number)),
                        origins_);
      },
      std::move(done));
}

void MeasurementService::list(const MeasurementQuery& query, std::int64_t after, std::size_t limit,
                              Visitor visit, Done<ListPage> done) {
  database_.readers().submit(
      [this, filter = static_cast<const store::MeasurementFilter&>(query), after, limit,
       last = query.last, behind = query.after, shows_notes = query.shows_notes,
       shows_first_rows = query.shows_first_rows,
       order = query.newest_first ? store::ListOrder::NewestFirst : store::ListOrder::OldestFirst,
       visit = std::move(visit)](const Stores& stores) mutable -> Result<ListPage> {
        if (!filter.as_of_id) filter.as_of_id = stores.measurements.last_id();
        if (behind) {
          const auto row = row_of(stores, *behind);
          if (!row) return unknown_cursor();
          after = *row;
        }
        if (last) {
          limit = *last;
          const auto first = stores.measurements.first_of_newest(filter, limit);
          if (!first) return ListPage{.next = std::nullopt, .as_of = *filter.as_of_id};
          if (order == store::ListOrder::OldestFirst) after = *first - 1;
        }
        const RowNames names = row_names(tables_, origins_);
        const auto next = stores.measurements.list(
            filter, after, limit,
            [&](const MeasurementRow& row) {
              Measurement measurement = from_store(row, names);
              if (shows_first_rows) measurement.first_row = first_row_of(stores, row);
              measurement.conflict = is_in_conflict(stores, row);
              std::vector<Note> notes;
              if (shows_notes) {
                notes = notes_of(stores, row.id,
                                 measurement_id_text(measurement.id, measurement.origin), origins_);
              }
              measurement.notes = notes;
              visit(measurement);
            },
            order);
        return ListPage{.next = last ? std::nullopt : next, .as_of = *filter.as_of_id};
      },
      std::move(done));
}

Result<ReadValues> MeasurementService::read_values(const MeasurementQuery& query,
                                                   const RunVisitor& visit) {
  constexpr std::size_t kRowsAJob = 20'000;  // other readers get their turn between two jobs
  store::MeasurementFilter filter = query;
  std::optional<std::int64_t> after = 0;
  std::string newest = measurement_id_text(query.as_of_id.value_or(0), origins_.own());
  CorrectedPlaces places;
  std::vector<MeasuredRun::Value> values;
  while (after) {
    auto next = TRY(
        database_.readers().wait([&](const Stores& stores) -> Result<std::optional<std::int64_t>> {
          if (!filter.as_of_id) {
            filter.as_of_id = stores.measurements.last_id();
            stores.measurements.find(*filter.as_of_id, [&](const MeasurementRow& row) {
              newest =
                  measurement_id_text(row.public_number(),
                                      origins_.digits(row.origin.value_or(0), row.public_number()));
            });
            stores.measurements.list_corrections(
                *filter.as_of_id, [&](std::int64_t id, std::int64_t of) { places.add(id, of); });
            places.finish_adding();
            if (query.last) {
              const auto first = stores.measurements.first_of_newest(filter, *query.last);
              if (!first) return std::optional<std::int64_t>();
              after = *first - 1;
            }
          }
          Result<void> taken;
          const auto more = stores.measurements.list_values(
              filter, *after, kRowsAJob, [&](const store::MeasuredRun& run) {
                if (!taken) return;
                values.clear();
                for (const auto& value : run.values) {
                  places.pass(value.id);
                  values.push_back({value.number, Length::nanometres(value.measured_nm)});
                }
                // At the end of a history of this folder, another origin begins.
                for (std::span<const MeasuredRun::Value> rest(values); taken && !rest.empty();) {
                  const auto digits = origins_.digits(run.origin, rest.front().id);
                  const auto last = origins_.last_with(digits, run.origin);
                  const auto end = std::partition_point(
                      rest.begin(), rest.end(),
                      [last](const MeasuredRun::Value& value) { return value.id <= last; });
                  const auto count = static_cast<std::size_t>(end - rest.begin());
                  taken = visit({.origin = digits,
                                 .lower_limit = limit_of(run.lower_limit_nm),
                                 .upper_limit = limit_of(run.upper_limit_nm),
                                 .subgroup = run.subgroup,
                                 .values = rest.first(count)});
                  rest = rest.subspan(count);
                }
              });
          if (!taken) return taken.error();
          return more;
        }));
    after = next;
  }
  return ReadValues{.as_of = std::move(newest), .moves = places.moves()};
}

void MeasurementService::summary(const MeasurementQuery& query, std::string_view group_by,
                                 Done<std::vector<MeasurementGroup>> done) {
  const auto field = std::ranges::find(kTextFilters, group_by);
  if (field == kTextFilters.end()) {
    return done(Error{ErrorCode::QueryInvalid, "group_by must name one field or more"});
  }
  const auto number = static_cast<std::size_t>(field - kTextFilters.begin());
  const store::TextField group = store::kTextColumns.at(number).field;
  database_.readers().submit(
      [filter = static_cast<const store::MeasurementFilter&>(query), group](const Stores& stores) {
        return stores.measurements.summary(filter, group);
      },
      std::move(done));
}

}  // namespace fitgauge::app
