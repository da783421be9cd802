#pragma once

#include "cli/context.hpp"
#include "cli/json_object.hpp"
#include "record/fields.hpp"

namespace fitgauge::cli {

/// A query parameter of the service that chooses records.
struct RecordFilter {
  std::string_view name;
  std::string_view help{};  ///< none: exactly this text
};
inline constexpr auto kRecordFilters = [] {
  std::array<RecordFilter, app::kTextFilters.size() + 6> filters = {{
      {"designation", "Size and tolerance class, such as 25H7"},
      {"verdict", "Verdict: good, rework, reject or indeterminate"},
      {"source", "Source: gauge, simulation or all (default: gauge)"},
      {"from", "Measured at this time or later"},
      {"to", "Measured before this time"},
      {"history", "all: also corrected measurements"},
  }};
  std::ranges::transform(app::kTextFilters, filters.begin() + 6,
                         [](std::string_view name) { return RecordFilter{name}; });
  return filters;
}();

/// The command lines of list, export and summary. A filter that was not given is empty.
struct RecordQuery {
  std::array<std::string, kRecordFilters.size()> filters{};
  std::uint64_t limit = 100;  ///< of list
  std::string after{};        ///< of list: end of the previous page
  std::string format{};       ///< of export: csv, ndjson, dfq, qif or xlsx
  std::string time_zone{};    ///< of export: of the times of dfq and xlsx
  std::string output{};       ///< of export: a file; - or empty is standard output
  std::string group_by{};     ///< of summary
};

/// Returns a path with the given filters and the other values that are not empty.
std::string record_target(
    std::string path, const RecordQuery& query,
    std::initializer_list<std::pair<std::string_view, std::string>> others = {});

/// The answer of a GET; --json prints it unchanged.
Outcome<JsonValue> get_document(const Context& context, const std::string& target);

/// `fitgauge list`: a page of records, one a line, and on standard error how to get the next.
Outcome<ExitCode> run_list(const Context& context, const RecordQuery& query);

/// `fitgauge export`: writes every matching record as it arrives.
Outcome<ExitCode> run_export(const Context& context, const RecordQuery& query);

/// `fitgauge summary`: count, verdicts, mean and scatter of each group.
Outcome<ExitCode> run_summary(const Context& context, const RecordQuery& query);

struct CorrectOptions {
  std::string id;
  std::string measured;  ///< mm, with a point or a comma
  std::string reason;
};

/// `fitgauge correct m17 25.0131 --reason …`: a new record in place of a wrong one, which stays.
/// The exit code is the new verdict.
Outcome<ExitCode> run_correct(const Context& context, const CorrectOptions& options);

struct NoteOptions {
  std::string id;
  std::string cause;
  std::string measure;
  std::string text;
  std::string operator_name;
};

/// `fitgauge note m17 --cause … --measure …`: adds a note to a measurement; without options prints
/// its notes.
Outcome<ExitCode> run_note(const Context& context, const NoteOptions& options);

struct PlanOptions {
  std::string file;
  std::string part{};  ///< the part whose plan it becomes; empty: it is printed
};

/// `fitgauge plan from FILE`: reads a STEP file of any size without the service, and prints its
/// sizes and its other content, or with `--part` stores the plan. Classes are those of the
/// standard. @errors LocalFile for an unreadable file, with its line.
Outcome<ExitCode> run_plan_from(const Context& context, const PlanOptions& options);

struct StatisticsOptions {
  std::string figure;       ///< summary, anova, …, or uncertainty
  std::string file;         ///< JSON, or a value a line; - is standard input
  std::string lower{};      ///< of capability
  std::string upper{};      ///< of capability
  std::string reference{};  ///< of type1
  std::string tolerance{};  ///< of type1
};

/// `fitgauge statistics summary values.txt`: prints figures that the service computes; nothing is
/// stored. A file that begins with a brace is sent unchanged; in other files each line is a value,
/// or a subgroup of values separated by blanks, tabs, commas or semicolons (for anova a group).
Outcome<ExitCode> run_statistics(const Context& context, const StatisticsOptions& options);

// `fitgauge capability` and `fitgauge chart`: figures of stored measurements.

struct CapabilityQuery : RecordQuery {
  std::string target_mm{};
  std::string confidence{};
  std::string subgroups{};  ///< use or ignore
};

/// `fitgauge capability`: the indices with their intervals, and whether the process is stable.
Outcome<ExitCode> run_capability(const Context& context, const CapabilityQuery& query);

struct ChartQuery : RecordQuery {
  std::string kind{};
  std::string rules{};      ///< 1,2,3,4
  std::string subgroups{};  ///< use or ignore
};

/// `fitgauge chart`: centre and limits of a control chart, and each violation of its rules.
Outcome<ExitCode> run_chart(const Context& context, const ChartQuery& query);

}  // namespace fitgauge::cli
