#include "api/measurements/measurement_answer.hpp"

#include <fmt/format.h>

#include "api/measurements/measurement_codec.hpp"

namespace fitgauge::api {

std::vector<Warning> warnings_of(const app::Measurement& m) {
  using Kind = gauging::DecisionRule::Kind;
  std::vector<Warning> warnings;
  const bool has_tolerance = m.has_upper_limit() && m.has_lower_limit();
  const Length tolerance = m.deviations.upper - m.deviations.lower;
  if (has_tolerance) warn_of_no_acceptance(m.rule, tolerance, warnings);
  if (has_tolerance && m.rule.kind() == Kind::Simple && m.standard_uncertainty &&
      *m.standard_uncertainty * 10 > tolerance) {
    warnings.push_back({"uncertainty.large",
                        fmt::format("uncertainty_um of {} is above a tenth of the tolerance of {} "
                                    "um, and rule simple does not see it: use guard_band or "
                                    "conformance",
                                    format_um(*m.standard_uncertainty), format_um(tolerance))});
  }
  if (m.has_unknown_gauge) {
    warnings.push_back(
        {"gauge.unknown", fmt::format("gauge '{}' is not among the gauges in use: register it, or "
                                      "correct its name",
                                      m.gauge.value_or(""))});
  }
  if (m.has_blocked_gauge) {
    warnings.push_back(
        {"gauge.blocked", fmt::format("gauge '{}' was blocked when it measured this: measure again "
                                      "with another, or record its calibration",
                                      m.gauge.value_or(""))});
  }
  if (m.calibration_due) {
    warnings.push_back(
        {"gauge.overdue", fmt::format("the calibration of gauge '{}' was due {}: record the next "
                                      "one, or measure again",
                                      m.gauge.value_or(""), *m.calibration_due)});
  }
  return warnings;
}

void MeasurementAnswer::expect(std::size_t body_size) {
  constexpr std::size_t kRecordPerRow = 4;  // a record is seldom longer than so many rows
  if (wanted_ == Preference::Representation) answer_.body.reserve(kRecordPerRow * body_size);
}

void MeasurementAnswer::add(std::span<const app::Measurement> measurements,
                            std::string_view records) {
  const auto id_of = [](const app::Measurement& m) {
    return app::measurement_id_text(m.id, m.origin);
  };
  if (count_ == 0) first_id_ = id_of(measurements.front());
  if (!single_) last_id_ = id_of(measurements.back());
  if (lists_records()) {
    answer_.body += count_ == 0 ? R"({"measurements":[)" : ",";
    answer_.body += records;
  } else if (single_ && wanted_ != Preference::Minimal) {
    answer_.body += records;
  }
  count_ += static_cast<std::int64_t>(measurements.size());
  for (const app::Measurement& m : measurements) {
    ++verdicts_.at(static_cast<std::size_t>(m.result.verdict));
    warn_of(m);
  }
}

/// Of a list the first ones alone, each with the id of its record.
void MeasurementAnswer::warn_of(const app::Measurement& m) {
  constexpr std::size_t kMost = 20;
  for (Warning& warning : warnings_of(m)) {
    if (warnings_.size() == kMost) return;
    if (!single_) {
      warning.detail =
          fmt::format("{}: {}", app::measurement_id_text(m.id, m.origin), warning.detail);
    }
    warnings_.push_back(std::move(warning));
  }
}

void MeasurementAnswer::end_with_warnings() {
  if (!warnings_.empty()) {
    answer_.body += ',';
    std::string members;
    JsonWriter json(members);
    json.begin_object();
    write_warnings(json, warnings_);
    answer_.body.append(members, 1);
  }
  answer_.body += '}';
}

app::Answer MeasurementAnswer::finish() {
  if (single_) answer_.location = "/v1/measurements/" + first_id_;
  if (wanted_ == Preference::Minimal) {
    answer_.content_type.clear();
  } else if (lists_records()) {
    answer_.body += ']';
    end_with_warnings();
  } else if (!single_) {
    JsonWriter json(answer_.body);
    json.begin_object()
        .member("accepted", count_)
        .member("first_id", first_id_)
        .member("last_id", last_id_);
    write_verdict_counts(json, verdicts_);
    write_warnings(json, warnings_);
    json.end_object();
  } else if (!warnings_.empty()) {
    answer_.body.pop_back();
    end_with_warnings();
  }
  return std::move(answer_);
}

}  // namespace fitgauge::api
