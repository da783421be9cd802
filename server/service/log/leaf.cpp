#include "service/log/leaf.hpp"

#include "record/record.hpp"

namespace fitgauge::app {
namespace {

/// Checks of the store for rows that no version of the service has written.
std::string_view refusal_of(const Measurement& m) {
  const Length u = m.standard_uncertainty.value_or(Length());
  for (const auto& uncertainty :
       {m.temperature_uncertainty, m.scale_temperature_uncertainty, m.part_expansion_uncertainty,
        m.scale_expansion_uncertainty, m.added_uncertainty, std::optional(u.count())}) {
    if (uncertainty.value_or(0) < 0) return "has an uncertainty below 0";
  }
  if (m.added_uncertainty && !m.corrected)
    return "has the uncertainty of a correction that it lacks";
  if (m.conformance && (m.conformance->probability < 0 || m.conformance->guard_band < 0 ||
                        m.conformance->probability > 1'000'000'000)) {
    return "has a probability out of range";
  }
  if (!m.cycle && m.measured <= Length() && !(m.quantity && gauging::is_signed(*m.quantity))) {
    return "has no size";
  }
  if (m.deviations.upper < m.deviations.lower) return "has its upper limit below its lower limit";
  const bool is_of_class = m.basis != LimitsBasis::Explicit && m.is_judged();
  if (is_of_class != m.class_name.has_value() || is_of_class == m.table_revision.empty()) {
    return "has two sources of its limits";
  }
  if (m.correction_of.has_value() != m.correction_reason.has_value()) {
    return "is a correction without its measurement or reason";
  }
  if (m.conformance.has_value() != (m.rule.kind() == gauging::DecisionRule::Kind::Conformance)) {
    return "has figures of another rule";
  }
  if (!m.is_judged() && m.standard_uncertainty) return "has an uncertainty without limits";
  if (m.rule.kind() == gauging::DecisionRule::Kind::GuardBand && !m.coverage_factor) {
    return "has no coverage factor";
  }
  Measurement again = m;
  judge(again);
  return again.result.verdict == m.result.verdict ? ""
                                                  : "has a verdict that its limits do not give";
}

}  // namespace

std::span<const tlog::Hash> LeafMaker::operator()(std::span<const Measurement> measurements) {
  records_.clear();
  leaves_.clear();
  begins_.clear();
  RecordWriter writer(records_);
  for (const Measurement& measurement : measurements) {
    if (!leaves_.empty()) records_ += ',';
    begins_.push_back(records_.size());
    writer.append(measurement);
    leaves_.push_back(hasher_.leaf(std::string_view(records_).substr(begins_.back())));
  }
  begins_.push_back(records_.size() + 1);  // after a comma that is absent
  return leaves_;
}

std::string_view finding_in(const Measurement& measurement, std::string_view text) {
  if (const std::string_view refusal = refusal_of(measurement); !refusal.empty()) return refusal;
  std::string written;
  append_record(written, measurement);
  if (written == text) return "";
  return "has members that this version does not know: update the centre before its stations";
}

}  // namespace fitgauge::app
