#include "service/measurements/gauges_in_use.hpp"

#include <future>

#include "base/json/json_value.hpp"
#include "record/fields.hpp"
#include "service/documents/document_service.hpp"
#include "service/measurements/uncertainty_budget.hpp"

namespace fitgauge::api {
namespace {

using Documents = std::vector<app::NamedDocument>;

std::string text_of(const JsonValue& body, std::string_view name) {
  const JsonValue* value = body.find(name);
  return value == nullptr ? std::string() : std::string(value->text);
}

// Documents were checked before they were stored; one that cannot be read was altered since, and is
// as if it were not there.

std::map<std::string, metrology::CombinedUncertainty> combined_of(const Documents& budgets) {
  std::map<std::string, metrology::CombinedUncertainty> combined;
  for (const app::NamedDocument& document : budgets) {
    const auto body = parse_json(document.text);
    if (!body) continue;
    const auto found = combined_uncertainty(*body);
    if (found) combined.emplace(document.name, *found);
  }
  return combined;
}

GaugeBook book_of(const Documents& gauges, const Documents& budgets) {
  const auto combined = combined_of(budgets);
  GaugeBook book;
  for (const app::NamedDocument& document : gauges) {
    const auto body = parse_json(document.text);
    if (!body) continue;
    GaugeInUse gauge{.budget = text_of(*body, "uncertainty"),
                     .calibration_due = text_of(*body, "calibration_due")};
    const auto due = parse_due(gauge.calibration_due);
    if (!due) continue;
    gauge.due = *due;
    if (const auto found = combined.find(gauge.budget); found != combined.end()) {
      gauge.standard_uncertainty = rounded_up(found->second.combined);
      const double degrees = found->second.degrees_of_freedom * 1e6;
      if (degrees <= static_cast<double>(app::kDegreesOfFreedom.most)) {
        gauge.degrees_of_freedom = static_cast<std::int64_t>(degrees);
      }
    }
    book.emplace(document.name, std::move(gauge));
  }
  return book;
}

}  // namespace

void GaugesInUse::reload(std::function<void(Result<void>)> done) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++begun_;
  }
  const auto shared = std::make_shared<std::function<void(Result<void>)>>(std::move(done));
  documents_.list(
      app::DocumentKind::Uncertainty, [this, number, shared](Result<Documents> budgets) {
        if (!budgets) return (*shared)(budgets.error());
        documents_.list(
            app::DocumentKind::GaugeInUse,
            [this, number, shared, budgets = *std::move(budgets)](const Result<Documents>& gauges) {
              if (!gauges) return (*shared)(gauges.error());
              show(number, book_of(*gauges, budgets));
              (*shared)({});
            });
      });
}

Result<void> GaugesInUse::load() {
  std::promise<Result<void>> promise;
  auto future = promise.get_future();
  reload([&promise](Result<void> done) { promise.set_value(std::move(done)); });
  return future.get();
}

void GaugesInUse::show(std::uint64_t number, GaugeBook book) {
  const std::lock_guard lock(mutex_);
  if (number < shown_) return;
  shown_ = number;
  book_.set(std::make_shared<const GaugeBook>(std::move(book)));
}

}  // namespace fitgauge::api
