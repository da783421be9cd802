#include "plant/log_filter.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "record/verdict_codec.hpp"

namespace fitgauge::connections {
namespace {

using api::FieldErrors;
using api::FieldReader;
using gauging::Verdict;

constexpr std::array kVerdicts = {Verdict::Good, Verdict::Rework, Verdict::Reject,
                                  Verdict::Indeterminate};

void read_verdicts(FieldReader& fields, LogFilter& filter) {
  if (!fields.has("verdict")) return;
  const JsonValue* const list = fields.array("verdict");
  if (list == nullptr) return;
  filter.verdicts = {};
  for (const JsonValue& item : list->items) {
    const auto found = std::find_if(kVerdicts.begin(), kVerdicts.end(), [&](Verdict verdict) {
      return item.is(JsonValue::Kind::String) && item.text == gauging::word(verdict);
    });
    if (found == kVerdicts.end()) {
      fields.report(ErrorCode::FieldInvalid, "verdict",
                    "verdict is a list of good, rework, reject, indeterminate");
      return;
    }
    filter.verdicts[static_cast<std::size_t>(found - kVerdicts.begin())] = true;
  }
  if (list->items.empty()) {
    fields.report(ErrorCode::FieldInvalid, "verdict", "an empty list lets nothing through");
  }
}

void read_source(FieldReader& fields, LogFilter& filter) {
  const auto word = fields.optional_text("source");
  if (!word) return;
  filter.query.source = app::source_from_word(*word);
  if (!filter.query.source && *word != "all") {
    fields.report(ErrorCode::FieldInvalid, "source", "source is gauge, simulation or all");
  }
}

}  // namespace

bool LogFilter::takes(const app::Measurement& measurement) const {
  const auto at = std::find(kVerdicts.begin(), kVerdicts.end(), measurement.result.verdict);
  return verdicts.at(static_cast<std::size_t>(at - kVerdicts.begin()));
}

LogFilter read_filter(FieldReader& fields, FieldErrors& errors) {
  LogFilter filter;
  filter.query.history = true;
  if (!fields.has("filter")) return filter;
  const JsonValue* const object = fields.object("filter");
  if (object == nullptr) return filter;
  FieldReader members(*object, fields.at("filter"), errors);
  for (std::size_t i = 0; i < app::kTextFilters.size(); ++i) {
    filter.query.texts[i] = members.optional_text(app::kTextFilters[i]);
  }
  read_verdicts(members, filter);
  read_source(members, filter);
  members.refuse_unknown();
  return filter;
}

}  // namespace fitgauge::connections
