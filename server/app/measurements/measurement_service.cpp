#include "app/measurements/measurement_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/measurements/mapping.hpp"
#include "app/tables/table_catalog.hpp"
#include "store/database.hpp"

namespace fitgauge::app {
namespace {

store::MeasurementFilter measurement_filter(const MeasurementQuery& query) {
  store::MeasurementFilter filter;
  filter.part_id = query.part_id;
  filter.characteristic = query.characteristic;
  filter.order = query.order;
  filter.machine = query.machine;
  if (query.verdict) filter.verdict = to_store(*query.verdict);
  filter.source = query.source ? std::optional(to_store(*query.source)) : std::nullopt;
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

MeasurementGroup measurement_group(store::SummaryGroup group) {
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

}  // namespace

std::span<const std::string_view> summary_fields() { return kSummaryFields; }

void MeasurementService::find(std::int64_t id, Visitor visit, Done<std::int64_t> done) {
  database_.readers().submit(
      [this, id, visit = std::move(visit)](const store::Stores& stores) -> Result<std::int64_t> {
        const RevisionIds ids = [this](std::int64_t number) { return tables_.revision_id(number); };
        const bool found = stores.measurements.find(id, [&](const store::MeasurementRow& row) {
          Measurement measurement = from_store(row, ids);
          measurement.corrected_by = stores.measurements.corrected_by(id);
          visit(measurement);
        });
        if (found) return id;
        return Error{ErrorCode::MeasurementUnknown,
                     "there is no measurement '" + measurement_id_text(id) + "'"};
      },
      std::move(done));
}

void MeasurementService::list(const MeasurementQuery& query, std::int64_t after, std::size_t limit,
                              Visitor visit, Done<ListPage> done) {
  database_.readers().submit(
      [this, filter = measurement_filter(query), after, limit,
       visit = std::move(visit)](const store::Stores& stores) mutable -> Result<ListPage> {
        if (!filter.as_of_id) filter.as_of_id = stores.measurements.last_id();
        const RevisionIds ids = [this](std::int64_t number) { return tables_.revision_id(number); };
        const auto next = stores.measurements.list(
            filter, after, limit,
            [&](const store::MeasurementRow& row) { visit(from_store(row, ids)); });
        return ListPage{.next = next, .as_of = *filter.as_of_id};
      },
      std::move(done));
}

void MeasurementService::summary(const MeasurementQuery& query, std::string_view group_by,
                                 Done<std::vector<MeasurementGroup>> done) {
  const auto field = std::find(kSummaryFields.begin(), kSummaryFields.end(), group_by);
  if (field == kSummaryFields.end()) {
    return done(Error{ErrorCode::QueryInvalid, "group_by names no field to group by"});
  }
  const auto group = static_cast<store::GroupBy>(field - kSummaryFields.begin());
  database_.readers().submit(
      [filter = measurement_filter(query),
       group](const store::Stores& stores) -> Result<std::vector<MeasurementGroup>> {
        auto groups = stores.measurements.summary(filter, group);
        if (!groups) return groups.error();
        std::vector<MeasurementGroup> mapped;
        mapped.reserve(groups->size());
        for (store::SummaryGroup& found : *groups) {
          mapped.push_back(measurement_group(std::move(found)));
        }
        return mapped;
      },
      std::move(done));
}

}  // namespace fitgauge::app
