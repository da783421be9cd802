#include "cli/limits_commands.hpp"

#include "base/length.hpp"
#include "cli/address.hpp"
#include "cli/local_files.hpp"
#include "cli/problem.hpp"
#include "cli/tolerance_zones.hpp"

namespace fitgauge::cli {
namespace {

bool is_hole(const JsonValue& limits) { return limits.text_of("feature") == "hole"; }

/// A deviation of the document, exactly.
Length deviation(const JsonValue& limits, std::string_view member) {
  return parse_length_um(limits.text_of(member)).value();
}

ToleranceZone zone_of(const JsonValue& limits) {
  const bool hole = is_hole(limits);
  return {
      .heading = fmt::format("{} {}", limits.text_of("feature"), limits.text_of("tolerance_class")),
      .upper_name = hole ? "ES" : "es",
      .lower_name = hole ? "EI" : "ei",
      .upper = deviation(limits, "upper_deviation_um"),
      .lower = deviation(limits, "lower_deviation_um"),
      .colour = hole ? Colour::Cyan : Colour::Yellow};
}

/// The clearance between hole and shaft; interference is negative clearance.
std::string clearances(const JsonValue& fit, std::string_view unit) {
  const Length most = parse_length_um(fit.text_of("max_clearance_um")).value();
  const Length least = parse_length_um(fit.text_of("min_clearance_um")).value();
  if (least >= Length()) {
    return fmt::format("clearance {} to {} {}", format_um(least), format_um(most), unit);
  }
  if (most <= Length()) {
    return fmt::format("interference {} to {} {}", format_um(-most), format_um(-least), unit);
  }
  return fmt::format("clearance up to {} {unit}, interference up to {} {unit}", format_um(most),
                     format_um(-least), fmt::arg("unit", unit));
}

Outcome<Answer> get(const Context& context, const std::string& target) {
  return expect_ok(context.client.send({.target = target}), context.client.url());
}

std::string format_limit_gauge(const JsonValue& gauge, const Terminal& /*terminal*/) {
  const JsonValue& go = gauge.member("go");
  const JsonValue& no_go = gauge.member("no_go");
  return fmt::format(
      "{}  {} gauge, {}\nGO     {} to {} mm new, worn out at {} mm\nNO-GO  {} to {} mm\n",
      gauge.text_of("designation"), gauge.text_of("kind"), gauge.text_of("scheme"),
      go.text_of("lower_mm"), go.text_of("upper_mm"), go.text_of("wear_limit_mm"),
      no_go.text_of("lower_mm"), no_go.text_of("upper_mm"));
}

std::string format_fits(const JsonValue& found, const Terminal& terminal) {
  std::string text;
  for (const JsonValue& fit : found.member("fits").items) {
    text += fmt::format("{:<14} {}{}\n", fit.text_of("designation"),
                        clearances(fit, terminal.micrometre()),
                        fit.text_of("preferred") == "true" ? "  preferred" : "");
  }
  return text +
         fmt::format("{} of {} fits\n", found.member("fits").items.size(), found.text_of("total"));
}

std::string format_standards(const JsonValue& found, const Terminal& /*terminal*/) {
  std::string text;
  for (const JsonValue& standard : found.member("standards").items) {
    text += fmt::format("{:<10} {}: {}\n", standard.text_of("name"), standard.text_of("edition"),
                        standard.text_of("title"));
  }
  return text;
}

/// `linear  over 6 up to 30 mm  m upper 200 lower -200`
std::string format_standard(const JsonValue& standard, const Terminal& /*terminal*/) {
  std::string text =
      fmt::format("{}: {}\n", standard.text_of("edition"), standard.text_of("title"));
  for (const JsonValue& row : standard.member("rows").items) {
    text += row.text_of("table");
    for (const auto& [name, value] : row.members) {
      if (value.is(JsonValue::Kind::Number)) text += fmt::format("  {} {}", name, value.text);
    }
    text += '\n';
    for (const auto& [item, numbers] : row.member("limits").members) {
      text += fmt::format("    {:<12}", item);
      for (const auto& [name, number] : numbers.members) {
        text += fmt::format("  {} {}", name, number.text);
      }
      text += '\n';
    }
  }
  return text;
}

/// Requests a document and prints it, or the text that `format` makes from it.
template <class Format>
Outcome<ExitCode> show(const Context& context, const std::string& target, const Format& format) {
  const auto answer = get(context, target);
  return show(context, answer, [&](const JsonValue& document) {
    context.print("{}", format(document, context.out));
  });
}

/// The path and query of a table in the form that is wanted.
Outcome<std::string> table_target(const TableOptions& options, const std::string& format) {
  const std::string table = "/v1/tables/" + percent_encoded(options.feature);
  if (format == "tab") {
    if (options.classes.empty() && options.revision.empty()) return table + ".tab";
    return Failure{ExitCode::Usage,
                   "--classes and --revision need --format csv or json: the table for the control "
                   "has every class"};
  }
  std::string target = table + "?format=" + format;
  if (!options.classes.empty()) target += "&classes=" + percent_encoded(options.classes);
  if (!options.revision.empty()) target += "&revision=" + percent_encoded(options.revision);
  return target;
}

}  // namespace

std::string signed_text(std::string_view number) {
  const bool is_positive = number != "0" && !number.starts_with('-');
  return (is_positive ? "+" : "") + std::string(number);
}

std::string format_limits(const JsonValue& limits, const Terminal& terminal) {
  const ToleranceZone zone = zone_of(limits);
  const std::string_view unit = terminal.micrometre();
  const std::array sizes{fmt::format("{} mm", limits.text_of("upper_limit_mm")),
                         fmt::format("{} mm", limits.text_of("lower_limit_mm")),
                         fmt::format("{} {}", limits.text_of("tolerance_um"), unit)};
  std::size_t width = 0;
  for (const std::string& size : sizes) width = std::max(width, size.size());
  const JsonValue& range = limits.member("size_range_mm");
  std::string text =
      fmt::format("{}  {}{}\n", limits.text_of("designation"), limits.text_of("feature"),
                  limits.text_of("basis") == "custom" ? ", custom tolerance class" : "");
  text += fmt::format("upper limit  {:{}}  {} {} {}\n", sizes[0], width, zone.upper_name,
                      signed_text(limits.text_of("upper_deviation_um")), unit);
  text += fmt::format("lower limit  {:{}}  {} {} {}\n", sizes[1], width, zone.lower_name,
                      signed_text(limits.text_of("lower_deviation_um")), unit);
  text += fmt::format("tolerance    {:{}}  ", sizes[2], width);
  text += range.members.empty() ? fmt::format("{}\n", limits.text_of("table_revision"))
                                : fmt::format("sizes over {} up to {} mm\n", range.text_of("over"),
                                              range.text_of("up_to"));
  return text;
}

namespace {

/// Figures of stored values; absent if the caller did not ask for them.
std::string measured_clearance(const JsonValue& stored, const Terminal& terminal) {
  if (!stored.is(JsonValue::Kind::Object)) return "";
  const auto number = [](const JsonValue& of, std::string_view name) {
    return std::strtod(std::string(of.text_of(name)).c_str(), nullptr);
  };
  const auto count = [&stored](std::string_view side) {
    return stored.member(side).member("selection").text_of("count");
  };
  return fmt::format(
      "measured: {} holes, {} shafts; clearance {:.3f} {unit}, s {:.3f} {unit}; interference with "
      "a probability of {:.3g}\n{}",
      count("hole"), count("shaft"), number(stored, "mean_clearance_um"),
      number(stored, "standard_deviation_um"), number(stored, "probability_of_interference"),
      stored.text_of("stable") == "true"
          ? ""
          : "NOT STABLE: these figures do not predict the next parts\n",
      fmt::arg("unit", terminal.micrometre()));
}

}  // namespace

std::string format_fit(const JsonValue& fit, const Terminal& terminal) {
  const JsonValue& hole = fit.member("hole");
  const JsonValue& shaft = fit.member("shaft");
  const std::array zones{zone_of(hole), zone_of(shaft)};
  std::string text = fmt::format("{}  {} fit, {}\n\n", fit.text_of("designation"),
                                 fit.text_of("type"), clearances(fit, terminal.micrometre()));
  text += draw_zones(zones, fmt::format("{} mm", hole.text_of("nominal_mm")), terminal);
  text += '\n';
  for (const JsonValue* part : {&hole, &shaft}) {
    text += fmt::format("{:5}  {} to {} mm\n", part->text_of("feature"),
                        part->text_of("lower_limit_mm"), part->text_of("upper_limit_mm"));
  }
  return text + measured_clearance(fit.member("statistical").member("stored"), terminal);
}

Outcome<ExitCode> run_limits(const Context& context, const std::string& designation) {
  return show(context, "/v1/limits/" + percent_encoded(designation), format_limits);
}

Outcome<ExitCode> run_fit(const Context& context, const FitQuery& query) {
  std::string target = "/v1/fits/" + percent_encoded(query.designation);
  char separator = '?';
  const auto add = [&](std::string_view side, const std::vector<std::string>& filters) {
    for (const std::string& filter : filters) {
      const std::size_t equals = std::min(filter.find('='), filter.size());
      const std::string value = filter.substr(std::min(equals + 1, filter.size()));
      target += fmt::format("{}{}_{}={}", separator, side,
                            percent_encoded(filter.substr(0, equals)), percent_encoded(value));
      separator = '&';
    }
  };
  add("hole", query.holes);
  add("shaft", query.shafts);
  if (!query.subgroups.empty()) target += fmt::format("{}subgroups={}", separator, query.subgroups);
  return show(context, target, format_fit);
}

Outcome<ExitCode> run_limit_gauge(const Context& context, const std::string& designation) {
  return show(context, "/v1/gauges/" + percent_encoded(designation), format_limit_gauge);
}

Outcome<ExitCode> run_fits(const Context& context, const FitSearch& search) {
  return show(
      context,
      fmt::format("/v1/fits?nominal_mm={}&min_clearance_um={}&max_clearance_um={}&limit={}",
                  percent_encoded(search.nominal_mm), percent_encoded(search.min_clearance_um),
                  percent_encoded(search.max_clearance_um), search.limit),
      format_fits);
}

Outcome<ExitCode> run_standards(const Context& context, const StandardQuery& query) {
  if (query.name.empty()) return show(context, "/v1/standards", format_standards);
  std::string target = "/v1/standards/" + percent_encoded(query.name);
  if (!query.size_mm.empty()) target += "?size_mm=" + percent_encoded(query.size_mm);
  return show(context, target, format_standard);
}

Outcome<ExitCode> run_tables_export(const Context& context, const TableOptions& options) {
  std::string format = options.format;
  if (format.empty()) format = context.json ? "json" : "csv";
  const auto target = TRY(table_target(options, format));
  const auto answer = TRY(get(context, target));
  const auto written = write_file(options.output, answer.body);
  return written ? Outcome<ExitCode>(ExitCode::Good) : written.error();
}

Outcome<ExitCode> run_version(const Context& context) {
  if (!context.json) context.print("fitgauge {}\n", FITGAUGE_VERSION);
  const auto answer = TRY(get(context, "/openapi.json"));
  const auto document = TRY(read_document(answer, context.client.url()));
  const std::string_view service = document.member("info").text_of("version");
  if (context.json) {
    context.print_document(JsonObject()
                               .add("fitgauge", FITGAUGE_VERSION)
                               .add("fitgauged", service)
                               .add("server", context.client.url())
                               .text());
  } else {
    context.print("fitgauged {} at {}\n", service, context.client.url());
  }
  return ExitCode::Good;
}

}  // namespace fitgauge::cli
