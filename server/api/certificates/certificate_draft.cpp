#include "api/certificates/certificate_draft.hpp"

#include <sstream>

#include "api/measurements/measurements.hpp"
#include "record/record.hpp"
#include "record/verdict_codec.hpp"

namespace fitgauge::api {
namespace {

/// Returns the size as text: `25 H7`, `M10-6H`; for limits of a drawing `25 hole` or `-50
/// position`; without limits `diameter`.
std::string size_text(const app::Measurement& m) {
  std::string text;
  if (m.class_name) {
    standards::append_designation(text, m.nominal_size, *m.class_name);
  } else {
    if (m.has_nominal()) text = format_mm(m.nominal_size) + ' ';
    text += m.has_feature() ? word(m.feature) : word(*m.quantity);
  }
  return m.envelope ? text + " (E)" : text;
}

/// Millimetres with three decimals or more, so that the eye compares the numbers of a line.
std::string mm_text(Length length) {
  constexpr std::size_t kDecimals = 3;
  std::string text = format_mm(length);
  if (text.find('.') == text.npos) text += '.';
  const std::size_t decimals = text.size() - text.find('.') - 1;
  if (decimals < kDecimals) text.append(kDecimals - decimals, '0');
  return text;
}

std::string limits_text(const app::Measurement& m) {
  if (!m.is_judged()) return "no limits";
  if (!m.has_lower_limit()) return fmt::format("up to {}", mm_text(m.upper_limit()));
  if (!m.has_upper_limit()) return fmt::format("from {}", mm_text(m.lower_limit()));
  return fmt::format("{} to {}", mm_text(m.lower_limit()), mm_text(m.upper_limit()));
}

/// ` at 25 °C, steel`, ` at 25 °C, 11.5 µm/(m·K)`.
std::string body_text(const std::optional<std::int64_t>& temperature,
                      const std::optional<std::int64_t>& expansion,
                      const std::optional<std::string_view>& material) {
  const auto text = [](std::int64_t value) {
    return format_decimal(value, app::kTemperatureDecimals);
  };
  constexpr std::int64_t kReference = 20'000'000;
  std::string out = fmt::format(" at {} \u00b0C", text(temperature.value_or(kReference)));
  if (material) return fmt::format("{}, {}", out, *material);
  return fmt::format("{}, {} \u00b5m/(m\u00b7K)", out, text(expansion.value_or(0)));
}

/// The size at 20 °C with the reading and its temperatures.
std::string measured_text(const app::Measurement& m) {
  if (!m.corrected) return mm_text(m.measured);
  std::string text = fmt::format("{} (read {})", mm_text(*m.corrected), mm_text(m.measured));
  text += body_text(m.temperature, m.part_expansion, m.part_material);
  if (m.scale_expansion || m.scale_material)
    text += "; scale" + body_text(m.scale_temperature, m.scale_expansion, m.scale_material);
  if (m.added_uncertainty) {
    text += fmt::format(", adds u {} \u00b5m",
                        format_decimal(*m.added_uncertainty, app::kPicometreDecimals));
  }
  return text;
}

/// `; GG, 4 points from 22.5°, form 2.1 µm, factor 1; envelope verified`: the method of measuring.
std::string taken_text(const app::Measurement& m) {
  std::string text = m.inside_corner ? "; inside corner" : "";
  if (m.size_operator && m.size_operator != app::kTwoPoint)
    text += fmt::format("; {}", *m.size_operator);
  if (m.points) text += fmt::format(", {} points", *m.points);
  if (m.start_angle) text += fmt::format(" from {}\u00b0", format_decimal(*m.start_angle, 6));
  if (m.form) text += fmt::format(", form {} \u00b5m", format_um(Length::nanometres(*m.form)));
  if (m.diameter_factor) text += fmt::format(", factor {}", format_decimal(*m.diameter_factor, 6));
  const char* const found = m.has_failed_envelope() ? "failed" : "verified";
  if (m.envelope) text += fmt::format("; envelope {}", m.go_gauge ? found : "not verified");
  return text;
}

/// The rule in words, with its standard.
std::string rule_text(const gauging::DecisionRule& rule) {
  switch (rule.kind()) {
    case gauging::DecisionRule::Kind::Simple:
      return "simple acceptance. Good: the value lies within the limits; its uncertainty does not "
             "count (JCGM 106:2012, 8.2).";
    case gauging::DecisionRule::Kind::GuardBand:
      return "guard band. Good: the value lies inside both limits by U at least. Rework or reject: "
             "outside by more than U. Else indeterminate (ISO 14253-1:2017; JCGM 106:2012, 8.3).";
    case gauging::DecisionRule::Kind::Conformance: break;
  }
  return fmt::format(
      "conformance. Good: the true value lies within the limits with a probability p of {} at "
      "least. Rework or reject: outside with that probability. Else indeterminate (ISO "
      "14253-1:2017; JCGM 106:2012, 7).",
      format(rule.probability()));
}

/// Writes `1.6 (k 2, 95.45 %)`: the expanded uncertainty with its factor and coverage. A record
/// without a factor gets the factor for 95.45 %.
std::string uncertainty_text(const app::Measurement& m) {
  const gauging::KnownUncertainty known = known_uncertainty(m);
  const Length u = known.u;
  if (u == Length()) return "";
  constexpr std::int64_t kOne = 1'000'000;
  const std::int64_t k = m.coverage_factor.value_or(default_coverage(known)).millionths();
  const double covered =
      gauging::conformance_probability({Length::nanometres(k), Length::nanometres(-k)}, Length(),
                                       {Length::nanometres(kOne), known.degrees_of_freedom});
  constexpr double kCounted = 9e12;  // nm: beyond it the product does not fit
  const double about = static_cast<double>(u.count()) * static_cast<double>(k) / 1e6;
  return fmt::format("{} (k {:.4g}, {:.2f} %)",
                     about < kCounted
                         ? format_um(Length::nanometres((u.count() * k + kOne - 1) / kOne))
                         : fmt::format("{:.6g}", about / 1e3),
                     static_cast<double>(k) / 1e6, covered * 100);
}

/// Position of a value between the limits: 0 is the lower one, 1 the upper one.
std::optional<double> place_of(const app::Measurement& m) {
  if (!m.is_judged() || !m.has_lower_limit() || !m.has_upper_limit() ||
      m.upper_limit() == m.lower_limit())
    return {};
  return (m.decisive() - m.lower_limit()).to_mm() / (m.upper_limit() - m.lower_limit()).to_mm();
}

/// `2026-11-22 08:00:00`, UTC
std::string time_text(Timestamp time) {
  return format_rfc3339(time).substr(0, 19).replace(10, 1, " ");
}

template <typename... Texts>
std::string listed(const Texts&... texts) {
  std::string out;
  for (const std::string_view text : {std::string_view(texts)...}) {
    if (!text.empty()) out.append(out.empty() ? "" : ", ").append(text);
  }
  return out;
}

constexpr std::array kWeights = {certificate::Weight::Plain, certificate::Weight::Noted,
                                 certificate::Weight::Marked, certificate::Weight::Noted,
                                 certificate::Weight::Plain};

}  // namespace

void CertificateDraft::add(const app::Measurement& m) {
  ++verdicts_.at(static_cast<std::size_t>(m.result.verdict));
  count(m);
  std::string gauge(m.gauge.value_or(""));
  const std::string due(m.calibration_due.value_or(""));
  if (m.part_id) parts_.emplace(*m.part_id);
  if (m.gauge) {
    const std::string budget(m.uncertainty_budget.value_or(""));
    gauges_.insert({gauge, budget, budget.empty() ? std::nullopt : m.standard_uncertainty, due,
                    std::string(m.calibration_certificate.value_or("")),
                    std::string(m.calibration_laboratory.value_or("")),
                    m.gauge_blocked.has_value()});
  }
  if (!due.empty()) gauge += "; OVERDUE when measured: " + due;
  if (m.gauge_blocked) gauge += "; BLOCKED when measured";
  if (!m.table_revision.empty()) ++revisions_[std::string(m.table_revision)];
  std::string record;
  app::append_record(record, m);
  bytes_ += record.size();
  if (order_.as_json) {
    if (!records_.empty()) records_ += ',';
    records_ += record;
    return;
  }
  std::string rule;
  if (m.is_judged())
    rule =
        fmt::format("R{}", rules_.try_emplace(rule_text(m.rule), rules_.size() + 1).first->second);
  if (m.conformance) rule += fmt::format(", p {}", format_decimal(m.conformance->probability, 9));
  const Length deviation = m.decisive() - m.nominal_size;
  const std::optional<double> place = place_of(m);
  lines_.push_back(
      {.part = std::string(m.part_id.value_or("")),
       .characteristic = std::string(m.characteristic.value_or("")),
       .size = size_text(m),
       .limits = limits_text(m),
       .measured =
           measured_text(m) + taken_text(m) +
           (m.correction_reason ? fmt::format("; corrected: {}", *m.correction_reason) : ""),
       .deviation = m.has_nominal() ? (Length() < deviation ? "+" : "") + format_um(deviation) : "",
       .verdict = std::string(word(m.result.verdict)),
       .rule = rule,
       .uncertainty = uncertainty_text(m),
       .gauge = listed(gauge, m.machine.value_or(""), m.operator_id.value_or("")),
       .measured_at = time_text(m.measured_at),
       .place = place ? std::optional(static_cast<float>(*place)) : std::nullopt,
       .weight = kWeights.at(static_cast<std::size_t>(m.result.verdict))});
}

void CertificateDraft::count(const app::Measurement& m) {
  const std::optional<double> place = place_of(m);
  const Length above = m.decisive() - m.upper_limit();
  const Length below = m.lower_limit() - m.decisive();
  const bool is_upper = m.has_upper_limit() && (!m.has_lower_limit() || below <= above);
  values_.push_back(
      {.candidate = candidate_of(m),
       .id = app::measurement_id_text(m.id, m.origin),
       .verdict = m.result.verdict,
       .badness = {gauging::severity(m.result.verdict), place ? std::abs(2 * *place - 1) : 0},
       .decisive = m.decisive(),
       .beyond = is_upper ? above : below,
       .is_upper = is_upper});
}

const CertificateDraft::Counted* CertificateDraft::worst() const {
  const auto worst = std::ranges::max_element(values_, {}, [](const Counted& value) {
    return std::pair(value.candidate.counts, value.badness);
  });
  return worst->verdict == gauging::Verdict::Unjudged ? nullptr : &*worst;
}

/// `W3, bore, 25 H7: 24.999 mm, 1 µm below the lower limit`.
std::string CertificateDraft::text_of(const Counted& value, const certificate::Line& line) {
  const Length beyond = value.beyond;
  return fmt::format(
      "{}: {} mm, {} \u00b5m {} the {} limit{}", listed(line.part, line.characteristic, line.size),
      mm_text(value.decisive), format_um(beyond < Length() ? -beyond : beyond),
      beyond <= Length() ? "inside"
      : value.is_upper   ? "above"
                         : "below",
      value.is_upper ? "upper" : "lower",
      value.candidate.go_passes.value_or(true) ? "" : ", the GO gauge does not pass");
}

std::size_t CertificateDraft::measured_again() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(values_, [](const Counted& value) { return !value.candidate.counts; }));
}

std::string CertificateDraft::json(Timestamp made_at, const std::string& checkpoint) {
  choose(values_);
  return json_object([&](JsonWriter& json) {
    for (const auto& [name, value] : order_.of) json.member(name, value);
    json.member("title", order_.title);
    if (!order_.company.empty()) json.member("company", order_.company);
    if (!order_.customer.empty()) json.member("customer", order_.customer);
    json.member("made_at", format_rfc3339(made_at)).member("count", std::uint64_t{count()});
    write_verdict_counts(json, verdicts_);
    json.member("parts", std::uint64_t{parts_.size()});
    if (worst() != nullptr) json.member("worst_id", worst()->id);
    if (has_verdict()) json.member("verdict", word(worst()->verdict));
    if (measured_again() > 0) {
      json.list("measured_again", values_, [&](const Counted& value) {
        if (!value.candidate.counts) json.value(value.id);
      });
    }
    if (plan_) {
      if (plan_->plan) json.member("plan", *plan_->plan);
      json.list("missing", plan_->missing);
    }
    json.list("gauges", gauges_, [&](const UsedGauge& gauge) {
      json.begin_object().member("name", gauge.name);
      if (!gauge.overdue_since.empty()) json.member("calibration_due", gauge.overdue_since);
      if (!gauge.certificate.empty()) json.member("calibration_certificate", gauge.certificate);
      if (!gauge.laboratory.empty()) json.member("calibration_laboratory", gauge.laboratory);
      if (gauge.is_blocked) json.member("gauge_blocked", true);
      if (!gauge.budget.empty()) json.member("uncertainty", gauge.budget);
      if (gauge.standard_uncertainty) json.member_um("uncertainty_um", *gauge.standard_uncertainty);
      json.end_object();
    });
    json.member("checkpoint", checkpoint);
    json.key("measurements").raw("[" + records_ + "]");
  });
}

std::string CertificateDraft::summary() const {
  std::string text = fmt::format("{} measured value{}", count(), count() == 1 ? "" : "s");
  if (!parts_.empty())
    text += fmt::format(" of {} part{}", parts_.size(), parts_.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < verdicts_.size(); ++i) {
    const auto verdict = static_cast<gauging::Verdict>(i);
    if (verdict == gauging::Verdict::Unjudged && verdicts_[i] == 0) continue;
    text += fmt::format("{} {} {}", i == 0 ? ":" : ",", verdicts_[i], word(verdict));
  }
  text += '.';
  if (measured_again() > 0) {
    text += fmt::format(
        " Measured again: {}; of each characteristic of a part the value measured last counts, and "
        "a GO gauge that does not pass until it passes.",
        measured_again());
  }
  return text;
}

bool CertificateDraft::has_verdict() const {
  const bool lacks = plan_ && !plan_->missing.empty();
  return worst() != nullptr && !(lacks && worst()->verdict == gauging::Verdict::Good);
}

std::string CertificateDraft::pdf(Timestamp made_at, const std::string& checkpoint,
                                  const certificate::Letterhead& letterhead) {
  choose(values_);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (!values_[i].candidate.counts) lines_[i].measured += "; measured again";
  }
  certificate::Certificate paper{
      .title = order_.title,
      .letterhead = letterhead,
      .summary = {summary()},
      .statements = std::vector<std::string>(rules_.size()),
      .lines = std::move(lines_),
      .code = fmt::format("{}/v1/measurements/{}/proof", order_.own_origin, values_.front().id),
      .signatures = {"Inspector", "Quality", "Date"}};
  if (const Counted* const value = worst()) {
    const certificate::Line& line = paper.lines[static_cast<std::size_t>(value - values_.data())];
    paper.summary.push_back(fmt::format("Worst value: {}.", text_of(*value, line)));
    if (has_verdict()) paper.worst = line;
  }
  if (plan_) {
    paper.summary.push_back(plan_->plan ? fmt::format("Checked against plan {}.", *plan_->plan)
                                        : "Not checked against a plan.");
  }
  if (plan_ && !plan_->missing.empty()) {
    paper.summary.push_back(
        fmt::format("Missing of the plan: {}.", fmt::join(plan_->missing, ", ")));
  }
  if (!order_.company.empty()) paper.facts.push_back(order_.company);
  if (!order_.customer.empty()) paper.facts.push_back("Customer: " + order_.customer);
  for (const auto& [name, value] : order_.of)
    paper.facts.push_back(fmt::format("{}: {}", name == "order" ? "Order" : "Part", value));
  for (const auto& [words, number] : rules_)
    paper.statements[number - 1] = fmt::format("R{}: {}", number, words);
  paper.statements.emplace_back(
      "U: expanded uncertainty k\u00b7u with its coverage factor and coverage probability, as the "
      "record has it. The results relate to the values listed here alone; a size is at 20 \u00b0C "
      "(ISO 1) if the temperature stands beside it. Its operator (ISO 14405-1) stands beside it "
      "unless that is LP.");
  std::set<std::string> calibrations;
  for (const UsedGauge& gauge : gauges_) {
    if (gauge.certificate.empty() && gauge.laboratory.empty()) continue;
    calibrations.insert(fmt::format("Gauge {}: calibration {}", gauge.name,
                                    listed(gauge.certificate, gauge.laboratory)));
  }
  paper.statements.insert(paper.statements.end(), calibrations.begin(), calibrations.end());
  std::string made = fmt::format("Made {} UTC by fitgauge {}", time_text(made_at), kVersion);
  for (const auto& [revision, uses] : revisions_) made += ", tables " + revision;
  paper.facts.push_back(made);
  paper.proof.emplace_back("Every value stands in the log whose signed head is:");
  std::istringstream note(checkpoint);
  for (std::string line; std::getline(note, line);) paper.proof.push_back(line);
  paper.proof.push_back("Proof of the first value: " + paper.code);
  return certificate::to_pdf(paper, order_.paper);
}

}  // namespace fitgauge::api
