#include "plant/log_filter.hpp"

#include "plant/settings.hpp"
#include "record/verdict_codec.hpp"

namespace fitgauge::connections {

template <class V>
void members(V& v, LogFilter& filter) {
  for (std::size_t i = 0; i < app::kTextFilters.size(); ++i) {
    v.optional(app::kTextFilters[i], filter.query.texts[i], "The same text");
  }
  v.optional("verdict", filter.verdicts,
             SomeOf{{"good", "rework", "reject", "indeterminate", "unjudged"}}, "One of these");
  using From = LogFilter::From;
  v.optional(
      "source", filter.from,
      Choice<From>{{{"gauge", From::Gauge}, {"simulation", From::Simulation}, {"all", From::All}}},
      "gauge when absent");
}

bool LogFilter::takes(const app::Measurement& measurement) const {
  return verdicts.contains(gauging::word(measurement.result.verdict));
}

std::string FilterForm::schema(api::Side side) const { return api::schema_of<LogFilter>(side); }

bool FilterForm::read(api::FieldReader& fields, std::string_view name, LogFilter& to) const {
  if (!api::Object<LogFilter>{}.read(fields, name, to)) return false;
  to.query.source = std::nullopt;
  if (to.from == LogFilter::From::Gauge) to.query.source = app::Source::Gauge;
  if (to.from == LogFilter::From::Simulation) to.query.source = app::Source::Simulation;
  return true;
}

}  // namespace fitgauge::connections
