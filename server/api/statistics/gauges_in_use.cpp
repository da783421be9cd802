#include "api/statistics/gauges_in_use.hpp"

#include <cmath>
#include <future>

#include "api/statistics/uncertainty_resource.hpp"
#include "app/service/document_service.hpp"
#include "base/json_value.hpp"

namespace fitgauge::api {
namespace {

using Documents = std::vector<app::NamedDocument>;

std::string text_of(const JsonValue& body, std::string_view name) {
  const JsonValue* value = body.find(name);
  return value == nullptr ? std::string() : std::string(value->text);
}

// Documents were checked before they were stored; one that cannot be read was altered since, and is
// as if it were not there.

std::map<std::string, double> combined_of(const Documents& budgets) {
  std::map<std::string, double> combined;
  for (const app::NamedDocument& document : budgets) {
    const auto body = parse_json(document.text);
    if (!body) continue;
    const auto found = combined_standard_uncertainty(*body);
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
      gauge.standard_uncertainty = rounded_up(found->second);
    }
    book.emplace(document.name, std::move(gauge));
  }
  return book;
}

}  // namespace

std::optional<Timestamp> parse_due(std::string_view text) {
  const auto time = parse_rfc3339(text);
  if (time) return *time;
  const auto end = parse_rfc3339(std::string(text) + "T23:59:59.999999999Z");
  return end ? std::optional(*end) : std::nullopt;
}

std::optional<Length> rounded_up(double micrometres) {
  constexpr double kNanometres = 1e3;
  constexpr double kNoise = 1e6;  // binary fractions of decimals are not rounded up
  constexpr double kMost = 1e9;
  const double nanometres = std::ceil(std::round(micrometres * kNanometres * kNoise) / kNoise);
  if (!(nanometres >= 0 && nanometres <= kMost)) return std::nullopt;
  return Length::nanometres(static_cast<std::int64_t>(nanometres));
}

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
