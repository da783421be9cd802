#include "cli/commands.hpp"

#include "cli/local_files.hpp"

namespace fitgauge::cli {
namespace {

struct StatisticsOptions {
  std::string figure;       ///< summary, anova, …, or uncertainty
  std::string file;         ///< JSON, or a value a line; - is standard input
  std::string lower{};      ///< of capability
  std::string upper{};      ///< of capability
  std::string reference{};  ///< of type1
  std::string tolerance{};  ///< of type1
};

std::vector<std::string_view> values_of(std::string_view line) {
  constexpr std::string_view kBetween = " \t\r,;";
  std::vector<std::string_view> values;
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBetween);
    if (begin == std::string_view::npos) return values;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(kBetween), line.size());
    values.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

/// Whether a comma in the line may be a decimal comma: between digits, without a point.
bool is_ambiguous(std::string_view line) {
  const auto is_digit = [&](std::size_t i) {
    return i < line.size() && line[i] >= '0' && line[i] <= '9';
  };
  if (line.find('.') != std::string_view::npos) return false;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == ',' && is_digit(i - 1) && is_digit(i + 1)) return true;
  }
  return false;
}

/// Lines as arrays of strings, which keep their digits; empty lines are left out.
/// @param flat whether every line had one value: then they are one array.
Outcome<std::string> arrays_of(std::string_view text, bool& flat) {
  std::string single;
  std::string nested;
  flat = true;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = trim(take_field(text, '\n'));
    if (is_ambiguous(line)) {
      return Failure::of(ExitCode::Usage,
                         "line {}: '{}' may be one number or several: write a decimal "
                         "point, and blanks between values",
                         number, line);
    }
    const auto values = values_of(line);
    if (values.empty()) continue;
    flat = flat && values.size() == 1;
    nested += nested.empty() ? "[" : ",[";
    for (std::size_t i = 0; i < values.size(); ++i)
      nested += fmt::format("{}{}", i == 0 ? "" : ",", json_string(values[i]));
    nested += ']';
    if (flat) single += fmt::format("{}{}", single.empty() ? "" : ",", json_string(values.front()));
  }
  return fmt::format("[{}]", flat ? single : nested);
}

Outcome<std::string> body_of(const StatisticsOptions& options) {
  auto text = TRY(read_file(options.file));
  if (trim(text).starts_with('{')) return text;
  if (options.figure == "grr" || options.figure == "pairing" || options.figure == "uncertainty") {
    return Failure::of(ExitCode::Usage,
                       "{} needs a JSON file: see its members in docs/reference/api.md",
                       options.figure);
  }
  bool flat = true;
  const auto arrays = TRY(arrays_of(text, flat));
  const std::string_view name = options.figure == "anova" ? "groups"
                                : flat                    ? "values"
                                                          : "subgroups";
  const std::string_view chart = options.figure != "chart" ? "" : flat ? "i_mr" : "xbar_r";
  return JsonObject()
      .add_raw(name, arrays)
      .add_given("kind", std::string(chart))
      .add_given("lower", options.lower)
      .add_given("upper", options.upper)
      .add_given("reference", options.reference)
      .add_given("tolerance", options.tolerance)
      .text();
}

/// `cp.value 1.70` for every number, text and truth of the document; of long lists their length.
void print_members(const Context& context, const std::string& name, const JsonValue& value) {
  constexpr std::size_t kShown = 10;
  const std::string prefix = name.empty() ? "" : name + ".";
  switch (value.kind) {
    case JsonValue::Kind::Object:
      for (const auto& [member, inner] : value.members)
        print_members(context, prefix + member, inner);
      break;
    case JsonValue::Kind::Array:
      if (value.items.size() > kShown) {
        context.print("{} {} items: --json shows them\n", name, value.items.size());
        break;
      }
      for (std::size_t i = 0; i < value.items.size(); ++i)
        print_members(context, prefix + std::to_string(i), value.items[i]);
      break;
    case JsonValue::Kind::Boolean:
      context.print("{} {}\n", name, value.boolean ? "true" : "false");
      break;
    case JsonValue::Kind::Null: context.print("{} -\n", name); break;
    case JsonValue::Kind::Number:
    case JsonValue::Kind::String: context.print("{} {}\n", name, value.text); break;
  }
}

/// A number of a document for a line of text, which has no use for 17 digits.
std::string rounded(const JsonValue& of, std::string_view name, int decimals) {
  const std::string text(of.text_of(name));
  return text.empty() || text == "null"
             ? "-"
             : fmt::format("{:.{}f}", std::strtod(text.c_str(), nullptr), decimals);
}

void print_selection(const Context& context, const JsonValue& document) {
  const JsonValue& selection = document.member("selection");
  const std::string_view subgroups = selection.text_of("subgroups");
  const std::string_view lower = selection.text_of("lower_limit_mm");
  const std::string_view upper = selection.text_of("upper_limit_mm");
  context.print("{} values{}, {} to {}, {} mm\n", selection.text_of("count"),
                subgroups == "0" ? "" : fmt::format(" in {} subgroups", subgroups),
                selection.text_of("first_id"), selection.text_of("last_id"),
                lower.empty()   ? fmt::format("upper limit {}", upper)
                : upper.empty() ? fmt::format("lower limit {}", lower)
                                : fmt::format("limits {} to {}", lower, upper));
}

void print_violations(const Context& context, const JsonValue& document) {
  for (const JsonValue& violation : document.member("violations").items) {
    const std::string_view subgroup = violation.text_of("subgroup");
    context.print("    rule {} at {} {} ({})\n", violation.text_of("rule"),
                  subgroup.empty() ? "measurement" : "subgroup",
                  subgroup.empty() ? violation.text_of("id") : subgroup,
                  violation.text_of("chart"));
  }
}

/// `fitgauge statistics summary values.txt`: prints figures that the service computes; nothing is
/// stored. A file that begins with a brace is sent unchanged; in other files each line is a value,
/// or a subgroup of values separated by blanks, tabs, commas or semicolons (for anova a group).
Outcome<ExitCode> run_statistics(const Context& context, const StatisticsOptions& options) {
  const auto body = TRY(body_of(options));
  const std::string target = options.figure == "uncertainty" ? std::string("/v1/uncertainty")
                                                             : "/v1/statistics/" + options.figure;
  const auto answer = context.send(
      {.method = "POST", .target = target, .content_type = "application/json", .body = body});
  return show(context, answer,
              [&](const JsonValue& document) { print_members(context, "", document); });
}

struct CapabilityQuery : RecordQuery {
  std::string target_mm{};
  std::string confidence{};
  std::string subgroups{};  ///< use or ignore
};

/// `fitgauge capability`: the indices with their intervals, and whether the process is stable.
Outcome<ExitCode> run_capability(const Context& context, const CapabilityQuery& query) {
  const std::string target = record_target("/v1/measurements/capability", query,
                                           {{"target_mm", query.target_mm},
                                            {"confidence", query.confidence},
                                            {"subgroups", query.subgroups}});
  return show(context, context.send({.target = target}), [&](const JsonValue& found) {
    print_selection(context, found);
    context.print("mean {} mm, s {} mm within, {} mm overall\n", rounded(found, "mean", 6),
                  rounded(found, "standard_deviation_within", 6),
                  rounded(found, "standard_deviation_overall", 6));
    for (const std::string_view name : {"cp", "cpk", "pp", "ppk", "cpm"}) {
      const JsonValue& index = found.member(name);
      context.print("{:<3} {} ({} to {})\n", name, rounded(index, "value", 3),
                    rounded(index, "lower", 3), rounded(index, "upper", 3));
    }
    if (const JsonValue& fit = found.member("distribution"); fit.kind == JsonValue::Kind::Object) {
      const bool is_tested = fit.member("p").kind == JsonValue::Kind::Number;
      context.print("distribution {}{}\n", fit.text_of("name"),
                    is_tested ? ", p " + rounded(fit, "p", 3) : "");
    }
    if (const JsonValue& reason = found.member("reason"); reason.kind == JsonValue::Kind::String)
      context.print("no figure (-) because {}\n", reason.text);
    const bool stable = found.text_of("stable") == "true";
    context.print("{}\n", stable ? "stable: no rule is broken"
                                 : "NOT STABLE: these figures do not predict the next parts");
    print_violations(context, found);
  });
}

struct ChartQuery : RecordQuery {
  std::string kind{};
  std::string rules{};      ///< 1,2,3,4
  std::string subgroups{};  ///< use or ignore
};

/// `fitgauge chart`: centre and limits of a control chart, and each violation of its rules.
Outcome<ExitCode> run_chart(const Context& context, const ChartQuery& query) {
  const std::string target =
      record_target("/v1/measurements/chart", query,
                    {{"kind", query.kind}, {"rules", query.rules}, {"subgroups", query.subgroups}});
  return show(context, context.send({.target = target}), [&](const JsonValue& found) {
    print_selection(context, found);
    for (const JsonValue& chart : found.member("charts").items) {
      context.print("{:<5} centre {} mm, limits {} to {} mm\n", chart.text_of("name"),
                    rounded(chart, "centre", 6), rounded(chart, "lower_limit", 6),
                    rounded(chart, "upper_limit", 6));
    }
    print_violations(context, found);
    if (found.member("violations").items.empty()) context.print("no rule is broken\n");
    if (const std::string length = rounded(found, "average_run_length", 1); length != "-")
      context.print("a false alarm every {} points on average\n", length);
  });
}

}  // namespace

void add_statistics(CLI::App& app, Action& chosen) {
  const auto [statistics, options] = add_command(
      app, "statistics", "Compute statistics of the values in a file", chosen, run_statistics);
  statistics
      ->add_option("figure", options->figure,
                   "Figure: summary, anova, capability, chart, type1, grr, pairing or uncertainty")
      ->required()
      ->check(CLI::IsMember(
          {"summary", "anova", "capability", "chart", "type1", "grr", "pairing", "uncertainty"}));
  statistics
      ->add_option("file", options->file,
                   "JSON file as in the HTTP API, or a text with one value on each line")
      ->required();
  statistics->add_option("--lower", options->lower, "Lower limit, for capability");
  statistics->add_option("--upper", options->upper, "Upper limit, for capability");
  statistics->add_option("--reference", options->reference, "Size of the master, for type1");
  statistics->add_option("--tolerance", options->tolerance,
                         "Tolerance of the characteristic, for type1");
}

void add_figures(CLI::App& app, Action& chosen) {
  const std::string help = "use: by subgroup; ignore: single values (default: use)";
  const auto [capability, indices] =
      add_command(app, "capability", "Capability of stored measurements", chosen, run_capability);
  add_filters(*capability, *indices);
  capability->add_option("--target-mm", indices->target_mm,
                         "Target of cpm (default: the middle of the limits)");
  capability->add_option("--confidence", indices->confidence,
                         "Confidence level of the intervals (default: 0.95)");
  capability->add_option("--subgroups", indices->subgroups, help)
      ->check(CLI::IsMember({"use", "ignore"}));

  const auto [chart, query] =
      add_command(app, "chart", "Control chart of stored measurements", chosen, run_chart);
  add_filters(*chart, *query);
  chart
      ->add_option("--kind", query->kind,
                   "Kind of chart (default: xbar_r with subgroups, else i_mr)")
      ->check(CLI::IsMember({"i_mr", "xbar_r", "xbar_s", "ewma", "cusum"}));
  chart->add_option("--rules", query->rules,
                    "Western Electric rules to check, such as 1,2,3,4 (default: none)");
  chart->add_option("--subgroups", query->subgroups, help)->check(CLI::IsMember({"use", "ignore"}));
}

}  // namespace fitgauge::cli
