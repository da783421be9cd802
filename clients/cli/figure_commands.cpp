#include "cli/figure_commands.hpp"

#include <cstdlib>

#include "cli/json_object.hpp"

namespace fitgauge::cli {
namespace {

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
  context.print("{} values{}, {} to {}, limits {} to {} mm\n", selection.text_of("count"),
                subgroups == "0" ? "" : fmt::format(" in {} subgroups", subgroups),
                selection.text_of("first_id"), selection.text_of("last_id"),
                selection.text_of("lower_limit_mm"), selection.text_of("upper_limit_mm"));
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

}  // namespace

Outcome<ExitCode> run_capability(const Context& context, const CapabilityQuery& query) {
  const auto found = get_document(context, record_target("/v1/measurements/capability", query,
                                                         {{"target_mm", query.target_mm},
                                                          {"confidence", query.confidence},
                                                          {"subgroups", query.subgroups}}));
  if (!found) return found.error();
  if (context.json) return ExitCode::Good;
  print_selection(context, *found);
  context.print("mean {} mm, s {} mm within, {} mm overall\n", rounded(*found, "mean", 6),
                rounded(*found, "standard_deviation_within", 6),
                rounded(*found, "standard_deviation_overall", 6));
  for (const std::string_view name : {"cp", "cpk", "pp", "ppk", "cpm"}) {
    const JsonValue& index = found->member(name);
    context.print("{:<3} {} ({} to {})\n", name, rounded(index, "value", 3),
                  rounded(index, "lower", 3), rounded(index, "upper", 3));
  }
  const bool stable = found->text_of("stable") == "true";
  context.print("{}\n", stable ? "stable: no rule is broken"
                               : "NOT STABLE: what the process makes next, these do not say");
  print_violations(context, *found);
  return ExitCode::Good;
}

Outcome<ExitCode> run_chart(const Context& context, const ChartQuery& query) {
  const auto found = get_document(
      context, record_target(
                   "/v1/measurements/chart", query,
                   {{"kind", query.kind}, {"rules", query.rules}, {"subgroups", query.subgroups}}));
  if (!found) return found.error();
  if (context.json) return ExitCode::Good;
  print_selection(context, *found);
  for (const JsonValue& chart : found->member("charts").items) {
    context.print("{:<5} centre {} mm, limits {} to {} mm\n", chart.text_of("name"),
                  rounded(chart, "centre", 6), rounded(chart, "lower_limit", 6),
                  rounded(chart, "upper_limit", 6));
  }
  print_violations(context, *found);
  if (found->member("violations").items.empty()) context.print("no rule is broken\n");
  if (const std::string length = rounded(*found, "average_run_length", 1); length != "-") {
    context.print("a false alarm every {} points on average\n", length);
  }
  return ExitCode::Good;
}

}  // namespace fitgauge::cli
