#include "cli/answers.hpp"

#include "cli/commands.hpp"

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
  if (least >= Length())
    return fmt::format("clearance {} to {} {}", format_um(least), format_um(most), unit);
  if (most <= Length())
    return fmt::format("interference {} to {} {}", format_um(-most), format_um(-least), unit);
  return fmt::format("clearance up to {} {unit}, interference up to {} {unit}", format_um(most),
                     format_um(-least), fmt::arg("unit", unit));
}

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
      for (const auto& [name, number] : numbers.members)
        text += fmt::format("  {} {}", name, number.text);
      text += '\n';
    }
  }
  return text;
}

/// Requests a document and prints it, or the text that `format` makes from it.
template <class Format>
Outcome<ExitCode> show(const Context& context, const std::string& target, const Format& format) {
  return show(context, context.send({.target = target}), [&](const JsonValue& document) {
    context.print("{}", format(document, context.out));
  });
}

/// `fitgauge limits 25H7`
Outcome<ExitCode> run_limits(const Context& context, const std::string& designation) {
  return show(context, "/v1/limits/" + percent_encoded(designation), format_limits);
}

struct FitQuery {
  std::string designation;
  std::vector<std::string> holes{};  ///< filters of stored values: `characteristic=bore`
  std::vector<std::string> shafts{};
  std::string subgroups{};  ///< use or ignore
};
/// `fitgauge fit 25H7/g6`, with the tolerance zones drawn, and the clearance of stored values.
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

/// `fitgauge limit-gauge 25H7`: the sizes of its limit gauges.
Outcome<ExitCode> run_limit_gauge(const Context& context, const std::string& designation) {
  return show(context, "/v1/gauges/" + percent_encoded(designation), format_limit_gauge);
}

struct FitSearch {
  std::string nominal_mm;
  std::string min_clearance_um{};
  std::string max_clearance_um{};
  int limit = 20;
};
/// `fitgauge fits 25 --min-um 5 --max-um 45`: the fits with clearances between two bounds.
Outcome<ExitCode> run_fits(const Context& context, const FitSearch& search) {
  return show(
      context,
      fmt::format("/v1/fits?nominal_mm={}&min_clearance_um={}&max_clearance_um={}&limit={}",
                  percent_encoded(search.nominal_mm), percent_encoded(search.min_clearance_um),
                  percent_encoded(search.max_clearance_um), search.limit),
      format_fits);
}

struct StandardQuery {
  std::string name{};
  std::string size_mm{};
};
/// `fitgauge standards`: which there are; with a name, its numbers.
Outcome<ExitCode> run_standards(const Context& context, const StandardQuery& query) {
  if (query.name.empty()) return show(context, "/v1/standards", format_standards);
  std::string target = "/v1/standards/" + percent_encoded(query.name);
  if (!query.size_mm.empty()) target += "?size_mm=" + percent_encoded(query.size_mm);
  return show(context, target, format_standard);
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

void add_limits(CLI::App& app, Action& chosen) {
  const std::string size_and_class = "Size and tolerance class, such as 25H7";
  const auto [limits, size] =
      add_command(app, "limits", "Limits of size: fitgauge limits 25H7", chosen, run_limits);
  limits->add_option("designation", *size, size_and_class)->required();
  const auto [fit, query] = add_command(
      app, "fit", "Clearances and tolerance zones of a fit: fitgauge fit 25H7/g6", chosen, run_fit);
  fit->add_option("fit", query->designation,
                  "Size, class of the hole and class of the shaft, such as 25H7/g6")
      ->required();
  add_repeated(*fit, "--hole", query->holes,
               "Filter of the stored holes, such as characteristic=bore");
  add_repeated(*fit, "--shaft", query->shafts,
               "Filter of the stored shafts, such as characteristic=pin");
  fit->add_option("--subgroups", query->subgroups,
                  "use: by subgroup; ignore: single values (default: use)")
      ->check(CLI::IsMember({"use", "ignore"}));
  const auto [gauge, gauged] = add_command(
      app, "limit-gauge", "GO and NO-GO sizes: fitgauge limit-gauge 25H7", chosen, run_limit_gauge);
  gauge->add_option("designation", *gauged, size_and_class)->required();
  const auto [fits, search] =
      add_command(app, "fits", "Find fits with clearances between two bounds", chosen, run_fits);
  fits->add_option("nominal", search->nominal_mm, "Nominal size in mm")->required();
  fits->add_option("--min-um", search->min_clearance_um,
                   "Smallest clearance in µm; negative for interference")
      ->required();
  fits->add_option("--max-um", search->max_clearance_um, "Greatest clearance in µm")->required();
  fits->add_option("--limit", search->limit, "Maximum number of fits (default: 20)")
      ->check(CLI::Range(1, 1000));
  const auto [standards, standard] =
      add_command(app, "standards", "Tables of other standards, such as iso965-1 for threads",
                  chosen, run_standards);
  standards->add_option("name", standard->name,
                        "Standard: iso2768-1, iso965-1, din6885-1 or iso492");
  standards->add_option("--size-mm", standard->size_mm, "Only the rows for this size in mm");
}

}  // namespace fitgauge::cli
