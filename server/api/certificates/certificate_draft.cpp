#include "api/certificates/certificate_draft.hpp"

#include <fmt/format.h>

#include <sstream>

#include "api/measurements/measurement_codec.hpp"
#include "api/services.hpp"
#include "base/json/json_writer.hpp"
#include "base/length.hpp"
#include "record/record.hpp"
#include "tables/standards/designated_limits.hpp"

namespace fitgauge::api {
namespace {

/// `25 H7`, `M10-6H`, of a drawing's own limits `25 hole`, `-50 position`, without them `diameter`.
std::string size_text(const app::Measurement& m) {
  std::string text;
  if (m.class_name) {
    standards::append_designation(text, m.nominal_size, *m.class_name);
  } else {
    if (m.has_nominal) text = format_mm(m.nominal_size) + ' ';
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

/// The size at 20 °C with the reading and what it was corrected for.
std::string measured_text(const app::Measurement& m) {
  if (!m.corrected) return mm_text(m.measured);
  std::string text = fmt::format("{} (read {})", mm_text(*m.corrected), mm_text(m.measured));
  text += body_text(m.temperature, m.part_expansion, m.part_material);
  if (m.scale_expansion || m.scale_material) {
    text += "; scale" + body_text(m.scale_temperature, m.scale_expansion, m.scale_material);
  }
  if (m.added_uncertainty) {
    text += fmt::format(", adds u {} \u00b5m",
                        format_decimal(*m.added_uncertainty, app::kPicometreDecimals));
  }
  return text;
}

std::string rule_text(const app::Measurement& m) {
  const Length u = m.rule.standard_uncertainty();
  const std::string degrees =
      m.degrees_of_freedom ? fmt::format(", \u03bd {}", format_decimal(*m.degrees_of_freedom, 6))
                           : "";
  switch (m.rule.kind()) {
    case gauging::DecisionRule::Kind::Simple: return "";
    case gauging::DecisionRule::Kind::GuardBand:
      return fmt::format("guard band, u {} \u00b5m, k {}{}", format_um(u),
                         format(m.rule.coverage_factor()), degrees);
    case gauging::DecisionRule::Kind::Conformance: break;
  }
  const std::int64_t found = m.conformance ? m.conformance->probability : 0;
  return fmt::format("conformance {}, found {}, u {} \u00b5m{}", format(m.rule.probability()),
                     format_decimal(found, 9), format_um(u), degrees);
}

/// `2026-11-22 08:00:00Z`
std::string time_text(Timestamp time) {
  std::string text = format_rfc3339(time);
  if (const std::size_t point = text.find('.'); point != text.npos) text.erase(point) += 'Z';
  return text.replace(text.find('T'), 1, " ");
}

}  // namespace

void CertificateDraft::add(const app::Measurement& m) {
  ++count_;
  ++verdicts_.at(static_cast<std::size_t>(m.result.verdict));
  last_id_ = app::measurement_id_text(m.id, m.origin);
  if (first_id_.empty()) first_id_ = last_id_;
  const std::string gauge(m.gauge.value_or(""));
  const std::string due(m.calibration_due.value_or(""));
  if (m.gauge) {
    const std::string budget(m.uncertainty_budget.value_or(""));
    gauges_.insert({gauge, budget, budget.empty() ? std::nullopt : m.standard_uncertainty, due});
  }
  if (!m.table_revision.empty()) ++revisions_[std::string(m.table_revision)];
  std::string record;
  app::append_record(record, m);
  bytes_ += record.size();
  if (order_.as_json) {
    if (!records_.empty()) records_ += ',';
    records_ += record;
    return;
  }
  lines_.push_back({.part = std::string(m.part_id.value_or("")),
                    .characteristic = std::string(m.characteristic.value_or("")),
                    .size = size_text(m),
                    .limits = limits_text(m),
                    .measured = measured_text(m),
                    .deviation = m.has_nominal ? format_um(m.decisive() - m.nominal_size) : "",
                    .verdict = std::string(word(m.result.verdict)),
                    .rule = rule_text(m),
                    .gauge = due.empty() ? gauge : gauge + "; OVERDUE when measured: " + due,
                    .measured_at = time_text(m.measured_at)});
}

std::string CertificateDraft::json(Timestamp made_at, const std::string& checkpoint) const {
  return json_object([&](JsonWriter& json) {
    for (const auto& [name, value] : order_.of) json.member(name, value);
    json.member("title", order_.title);
    if (!order_.company.empty()) json.member("company", order_.company);
    if (!order_.customer.empty()) json.member("customer", order_.customer);
    json.member("made_at", format_rfc3339(made_at)).member("count", std::uint64_t{count_});
    write_verdict_counts(json, verdicts_);
    json.key("gauges").begin_array();
    for (const UsedGauge& gauge : gauges_) {
      json.begin_object().member("name", gauge.name);
      if (!gauge.overdue_since.empty()) json.member("calibration_due", gauge.overdue_since);
      if (!gauge.budget.empty()) json.member("uncertainty", gauge.budget);
      if (gauge.standard_uncertainty) json.member_um("uncertainty_um", *gauge.standard_uncertainty);
      json.end_object();
    }
    json.end_array().member("checkpoint", checkpoint);
    json.key("measurements").raw("[" + records_ + "]");
  });
}

std::string CertificateDraft::summary() const {
  std::string text = fmt::format("{} measured values", count_);
  for (std::size_t i = 0; i < verdicts_.size(); ++i) {
    const auto verdict = static_cast<gauging::Verdict>(i);
    if (verdict == gauging::Verdict::Unjudged && verdicts_[i] == 0) continue;
    text += fmt::format("{} {} {}", i == 0 ? ":" : ",", verdicts_[i], word(verdict));
  }
  return text + '.';
}

std::string CertificateDraft::pdf(Timestamp made_at, const std::string& checkpoint) const {
  certificate::Certificate paper{
      .title = order_.title,
      .lines = lines_,
      .summary = summary(),
      .code = fmt::format("{}/v1/measurements/{}/proof", order_.own_origin, first_id_),
      .signatures = {"Inspector", "Quality", "Date"}};
  if (!order_.company.empty()) paper.facts.push_back(order_.company);
  if (!order_.customer.empty()) paper.facts.push_back("Customer: " + order_.customer);
  for (const auto& [name, value] : order_.of) {
    paper.facts.push_back(fmt::format("{}: {}", name == "order" ? "Order" : "Part", value));
  }
  std::string made = fmt::format("Made {} by fitgauge {}", time_text(made_at), kVersion);
  for (const auto& [revision, uses] : revisions_) made += ", tables " + revision;
  paper.facts.push_back(made);
  paper.proof.emplace_back("Every value stands in the log whose signed head is:");
  std::istringstream note(checkpoint);
  for (std::string line; std::getline(note, line);) paper.proof.push_back(line);
  paper.proof.push_back("Proof of the first value: " + paper.code);
  return certificate::to_pdf(paper, order_.paper);
}

}  // namespace fitgauge::api
