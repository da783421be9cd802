#pragma once

#include "cli/context.hpp"
#include "cli/json_object.hpp"

namespace fitgauge::cli {

/// `fitgauge limits 25H7`
Outcome<ExitCode> run_limits(const Context& context, const std::string& designation);

struct FitQuery {
  std::string designation;
  std::vector<std::string> holes{};  ///< filters of stored values: `characteristic=bore`
  std::vector<std::string> shafts{};
  std::string subgroups{};  ///< use or ignore
};
/// `fitgauge fit 25H7/g6`, with the tolerance zones drawn, and the clearance of stored values.
Outcome<ExitCode> run_fit(const Context& context, const FitQuery& query);

/// `fitgauge limit-gauge 25H7`: the sizes of its limit gauges.
Outcome<ExitCode> run_limit_gauge(const Context& context, const std::string& designation);

struct FitSearch {
  std::string nominal_mm;
  std::string min_clearance_um{};
  std::string max_clearance_um{};
  int limit = 20;
};
/// `fitgauge fits 25 --min-um 5 --max-um 45`: the fits with clearances between two bounds.
Outcome<ExitCode> run_fits(const Context& context, const FitSearch& search);

struct StandardQuery {
  std::string name{};
  std::string size_mm{};
};
/// `fitgauge standards`: which there are; with a name, its numbers.
Outcome<ExitCode> run_standards(const Context& context, const StandardQuery& query);

struct TableOptions {
  std::string feature;   ///< hole or shaft
  std::string format{};  ///< json, csv, tab
  std::string classes{};
  std::string revision{};
  std::string output = "-";
};

/// `fitgauge tables export hole`
Outcome<ExitCode> run_tables_export(const Context& context, const TableOptions& options);

/// `fitgauge version`: of this program, and of the service with the revision of its tables.
Outcome<ExitCode> run_version(const Context& context);

/// Returns the text of a limits document. @param terminal that shows it
std::string format_limits(const JsonValue& limits, const Terminal& terminal);

/// The text of a fit document.
std::string format_fit(const JsonValue& fit, const Terminal& terminal);

/// `+21`, `0`, `-7` from the document's number.
std::string signed_text(std::string_view number);

}  // namespace fitgauge::cli
