#include "app/measurement_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/mapping.hpp"
#include "app/table_catalog.hpp"
#include "store/database.hpp"

namespace fitgauge::app {
namespace {

store::MeasurementFilter to_store(const MeasurementQuery& query) {
  store::MeasurementFilter filter;
  filter.part_id = query.part_id;
  filter.characteristic = query.characteristic;
  filter.order = query.order;
  filter.machine = query.machine;
  if (query.verdict) filter.verdict = app::to_store(*query.verdict);
  filter.source = query.source ? std::optional(app::to_store(*query.source)) : std::nullopt;
  if (query.from) filter.from_ns = query.from->nanoseconds;
  if (query.to) filter.to_ns = query.to->nanoseconds;
  filter.history = query.history;
  filter.as_of_id = query.as_of;
  return filter;
}

constexpr std::array<std::string_view, 10> kSummaryFields = {
    "part_id",  "characteristic", "order", "operation",       "machine",
    "operator", "gauge",          "unit",  "tolerance_class", "caller"};
static_assert(static_cast<std::size_t>(store::GroupBy::Caller) + 1 == kSummaryFields.size(),
              "the names stand in the order of store::GroupBy");

MeasurementGroup from_store(store::SummaryGroup group) {
  return {.value = std::move(group.value),
          .count = group.count,
          .good = group.verdict_count(store::Verdict::Good),
          .rework = group.verdict_count(store::Verdict::Rework),
          .reject = group.verdict_count(store::Verdict::Reject),
          .indeterminate = group.verdict_count(store::Verdict::Indeterminate),
          .mean_mm = std::move(group.mean_mm),
          .standard_deviation_mm = std::move(group.standard_deviation_mm),
          .min = Length::nanometres(group.min_nm),
          .max = Length::nanometres(group.max_nm)};
}

/// The store knows ids as numbers: this error names them as the outside does.
Error corrected_before(const store::Stores& stores, std::int64_t id) {
  const auto newer = stores.measurements.corrected_by(id);
  return {ErrorCode::MeasurementCorrected,
          fmt::format("measurement {} was corrected by {}: correct that one",
                      measurement_id_text(id), measurement_id_text(newer.value_or(0)))};
}

/// Stores the measurements and gives them their ids.
Result<void> append(store::Stores& stores, std::span<Measurement> measurements,
                    std::optional<std::int64_t> revision) {
  std::vector<store::MeasurementRow> rows;
  rows.reserve(measurements.size());
  for (const Measurement& m : measurements) {
    rows.push_back(app::to_store(m, m.basis == LimitsBasis::Explicit ? std::nullopt : revision));
  }
  const auto ids = stores.measurements.append(rows);
  if (!ids && ids.error().code == ErrorCode::MeasurementCorrected) {
    return corrected_before(stores, *rows.front().correction_of);
  }
  if (!ids) return ids.error();
  std::int64_t id = ids->first;
  for (Measurement& m : measurements) m.id = id++;
  return {};
}

/// The same of a whole request, so many at a time that their rows stay in the cache.
Result<void> append_all(store::Stores& stores, std::span<Measurement> measurements,
                        std::optional<std::int64_t> revision) {
  constexpr std::size_t kAtATime = 128;
  while (!measurements.empty()) {
    const std::size_t count = std::min(measurements.size(), kAtATime);
    if (auto stored = append(stores, measurements.first(count), revision); !stored) return stored;
    measurements = measurements.subspan(count);
  }
  return {};
}

}  // namespace

std::span<const std::string_view> summary_fields() { return kSummaryFields; }

void MeasurementService::find_answer(const IdempotencyScope& scope,
                                     Done<std::optional<Answer>> done) {
  database_.readers().submit(
      [request =
           app::to_store(scope)](const store::Stores& stores) -> Result<std::optional<Answer>> {
        auto found = stores.idempotency.find(request);
        if (!found) return found.error();
        if (!*found) return std::optional<Answer>();
        return std::optional(app::from_store(**std::move(found)));
      },
      std::move(done));
}

void MeasurementService::record(std::vector<Measurement> measurements,
                                const std::optional<IdempotencyScope>& scope, Render render,
                                Done<Answer> done) {
  // The rows of one request are judged by one revision.
  const auto by_tables =
      std::find_if(measurements.begin(), measurements.end(),
                   [](const Measurement& m) { return m.basis != LimitsBasis::Explicit; });
  std::optional<std::int64_t> revision;
  if (by_tables != measurements.end()) {
    revision = tables_.revision_number(by_tables->table_revision);
  }
  auto work = [measurements = std::move(measurements), revision, render = std::move(render)](
                  store::Stores& stores) mutable -> Result<store::StoredAnswer> {
    if (auto stored = append_all(stores, measurements, revision); !stored) return stored.error();
    return app::to_store(render(measurements));
  };
  auto deliver = [done = std::move(done)](Result<store::StoredAnswer> answer) {
    if (!answer) return done(answer.error());
    done(app::from_store(*std::move(answer)));
  };
  if (scope) {
    database_.writer().submit_once(app::to_store(*scope), std::move(work), std::move(deliver));
  } else {
    database_.writer().submit(std::move(work), std::move(deliver));
  }
}

void MeasurementService::find(std::int64_t id, Visitor visit, Done<std::int64_t> done) {
  database_.readers().submit(
      [this, id, visit = std::move(visit)](const store::Stores& stores) -> Result<std::int64_t> {
        const RevisionIds ids = [this](std::int64_t number) { return tables_.revision_id(number); };
        const bool found = stores.measurements.find(id, [&](const store::MeasurementRow& row) {
          Measurement measurement = app::from_store(row, ids);
          measurement.corrected_by = stores.measurements.corrected_by(id);
          visit(measurement);
        });
        if (found) return id;
        return Error{ErrorCode::MeasurementUnknown,
                     "there is no measurement '" + measurement_id_text(id) + "'"};
      },
      std::move(done));
}

void MeasurementService::list(MeasurementQuery query, std::int64_t after, std::size_t limit,
                              Visitor visit, Done<ListPage> done) {
  database_.readers().submit(
      [this, filter = to_store(query), after, limit,
       visit = std::move(visit)](const store::Stores& stores) mutable -> Result<ListPage> {
        if (!filter.as_of_id) filter.as_of_id = stores.measurements.last_id();
        const RevisionIds ids = [this](std::int64_t number) { return tables_.revision_id(number); };
        const auto next = stores.measurements.list(
            filter, after, limit,
            [&](const store::MeasurementRow& row) { visit(app::from_store(row, ids)); });
        return ListPage{.next = next, .as_of = *filter.as_of_id};
      },
      std::move(done));
}

void MeasurementService::summary(MeasurementQuery query, std::string_view group_by,
                                 Done<std::vector<MeasurementGroup>> done) {
  const auto field = std::find(kSummaryFields.begin(), kSummaryFields.end(), group_by);
  if (field == kSummaryFields.end()) {
    return done(Error{ErrorCode::QueryInvalid, "group_by names no field to group by"});
  }
  const auto group = static_cast<store::GroupBy>(field - kSummaryFields.begin());
  database_.readers().submit(
      [filter = to_store(query),
       group](const store::Stores& stores) -> Result<std::vector<MeasurementGroup>> {
        auto groups = stores.measurements.summary(filter, group);
        if (!groups) return groups.error();
        std::vector<MeasurementGroup> mapped;
        mapped.reserve(groups->size());
        for (store::SummaryGroup& found : *groups) mapped.push_back(from_store(std::move(found)));
        return mapped;
      },
      std::move(done));
}

void MeasurementService::run(std::function<void()> work, std::function<void(Error)> refused) {
  database_.readers().submit(
      [work = std::move(work)](const store::Stores&) -> Result<bool> {
        work();
        return true;
      },
      [refused = std::move(refused)](const Result<bool>& ran) {
        if (!ran) refused(ran.error());
      });
}

}  // namespace fitgauge::app
