#include "nc/probing/log/measuring_log.hpp"

#include "log_templates.hpp"

namespace fitgauge::probing {
namespace {

using namespace fmt::literals;

constexpr double kMmPerInch = 25.4;

std::string beginning(const CycleHost& host, const HtmlLog& log) {
  return fmt::format(templates::page::beginning, "title"_a = log.title,
                     "style"_a = templates::page::style, "heading"_a = log.heading,
                     "program"_a = escape_html(host.program_path()),
                     "unit"_a = host.log_is_inch() && !log.is_metric ? "inch" : "mm",
                     "note"_a = log.note.empty() ? "" : fmt::format(" {}", log.note));
}

}  // namespace

std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos && text.front() == '-' ? text.substr(1)
                                                                                   : text;
}

std::string log_text(Length value, bool inch) {
  return inch ? fixed(value.to_mm() / kMmPerInch, 6) : fixed(value.to_mm(), 4);
}

MeasuringLog::MeasuringLog(const CycleDescriptor& cycle, const CycleHost& host)
    : inch_(host.log_is_inch()) {
  const CivilTime time = civil_time(host.now());
  text_ =
      fmt::format(templates::measuring::beginning, "cycle"_a = cycle.number, "name"_a = cycle.name,
                  "day"_a = time.day, "month"_a = time.month, "year"_a = time.year,
                  "hour"_a = time.hour, "minute"_a = time.minute, "second"_a = time.second,
                  "program"_a = host.program_path(), "unit"_a = inch_ ? 1 : 0);
}

void MeasuringLog::section(std::string_view title) {
  text_ += fmt::format(templates::measuring::section, "title"_a = title);
}

void MeasuringLog::length(std::string_view label, Length value) {
  line(label, log_text(value, inch_));
}

void MeasuringLog::number(std::string_view label, double value) { line(label, fixed(value, 4)); }

void MeasuringLog::line(std::string_view label, std::string_view value) {
  text_ += fmt::format(templates::measuring::line, "label"_a = fmt::format("{}:", label),
                       "value"_a = value);
}

std::string MeasuringLog::finish() && {
  text_ += templates::measuring::end;
  return std::move(text_);
}

void add_values(MeasuringLog& log, std::span<const MeasuredValue> values) {
  log.section("Nominal values");
  for (const auto& value : values) log.length(value.characteristic, value.nominal);
  if (std::ranges::any_of(values, [](const auto& value) { return value.limits.has_value(); }))
    log.section("Limits");
  for (const auto& value : values) {
    if (!value.limits) continue;
    log.length(fmt::format("{}, maximum", value.characteristic), value.limits->upper);
    log.length(fmt::format("{}, minimum", value.characteristic), value.limits->lower);
  }
  log.section("Actual values");
  for (const auto& value : values) log.length(value.characteristic, value.measured);
  log.section("Deviations");
  for (const auto& value : values) log.length(value.characteristic, value.deviation());
}

CycleResult<void> deliver_log(const CycleContext& context, MeasuringLog log) {
  const int where = context.whole(281);
  if (where == 0) return {};
  const std::string text = std::move(log).finish();
  if (where == 1)
    return context.host.append_log(fmt::format("TCHPR{}.TXT", context.descriptor().number), text);
  if (context.host.memory().fast_probing.interrupts) context.host.show_and_stop(text);
  return {};
}

std::string escape_html(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&': escaped += "&amp;"; break;
      case '<': escaped += "&lt;"; break;
      case '>': escaped += "&gt;"; break;
      case '"': escaped += "&quot;"; break;
      case '\'': escaped += "&#39;"; break;
      default: escaped += c;
    }
  }
  return escaped;
}

std::string date_and_time(const CycleHost& host) {
  const CivilTime time = civil_time(host.now());
  return fmt::format(templates::page::date_and_time, "day"_a = time.day, "month"_a = time.month,
                     "year"_a = time.year, "hour"_a = time.hour, "minute"_a = time.minute,
                     "second"_a = time.second);
}

CycleResult<void> add_section(CycleHost& host, const HtmlLog& log, std::string_view section) {
  const bool is_first = host.memory().begun_logs.emplace(log.file_name, host.program_path()).second;
  if (!is_first) return host.append_log(log.file_name, section);
  return host.write_log(log.file_name, beginning(host, log) + std::string(section));
}

using gauging::Verdict;

iso286::Feature MeasuredValue::feature() const {
  return role == ValueRole::ShaftSize ? iso286::Feature::Shaft : iso286::Feature::Hole;
}

gauging::DecisionRule MeasuredValue::rule() const {
  return uncertainty ? gauging::DecisionRule::guard_band(*uncertainty).value()
                     : gauging::DecisionRule();
}

std::optional<Verdict> MeasuredValue::verdict() const {
  if (!limits) return std::nullopt;
  const auto beyond = role == ValueRole::Position ? gauging::Beyond() : gauging::Beyond(feature());
  return gauging::gauge(beyond, limits->upper, limits->lower, measured, rule()).verdict;
}

int MeasuredValue::error() const {
  if (verdict().value_or(Verdict::Good) == Verdict::Good) return 0;
  return measured > limits->upper ? error_too_large : error_too_small;
}

Length to_length(double mm) { return Length::nearest_mm(mm).value(); }

void set_lengths(CycleHost& host, std::size_t first, std::initializer_list<double> mm) {
  for (const double length : mm)
    host.set_q(static_cast<std::uint16_t>(first++), to_length(length).to_mm(), Unit::Length);
}

double to_angle(double degrees) { return std::round(degrees * 1e7) / 1e7; }

CycleResult<std::optional<Limits>> size_limits(const Arguments& arguments, int max_q, int min_q) {
  const Limits limits{to_length(arguments.number(max_q)), to_length(arguments.number(min_q))};
  if (limits == Limits{}) return std::optional<Limits>{};
  if (limits.upper < limits.lower) {
    return nc_error(1016, "maximum Q{} = {} is less than minimum Q{} = {}", max_q,
                    format_mm(limits.upper), min_q, format_mm(limits.lower));
  }
  return std::optional(limits);
}

std::optional<Limits> position_limits(Length nominal, Length tolerance) {
  if (tolerance == Length{}) return std::nullopt;
  return Limits{nominal + tolerance, nominal - tolerance};
}

void judge_by_uncertainty(MeasuringRecord& record) {
  if (!record.form || !record.form->touch_uncertainty_um) return;
  const auto uncertainty =
      gauging::rounded_up(record.form->diameter_factor * *record.form->touch_uncertainty_um);
  std::optional<Verdict> worst;
  for (MeasuredValue& size : record.sizes) {
    const gauging::Quantity quantity = quantity_of(record.cycle, size.is_position());
    if (size.limits && quantity == gauging::Quantity::Diameter) size.uncertainty = uncertainty;
    if (gauging::severity(worst) < gauging::severity(size.verdict())) worst = size.verdict();
  }
  if (worst) record.verdict = worst;
}

}  // namespace fitgauge::probing
