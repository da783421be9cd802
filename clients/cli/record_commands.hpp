#pragma once

#include "cli/commands.hpp"
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

/// Declares the options of the filters.
void add_filters(CLI::App& command, RecordQuery& query);

/// Returns a path with the given filters and the other values that are not empty.
std::string record_target(
    std::string path, const RecordQuery& query,
    std::initializer_list<std::pair<std::string_view, std::string>> others = {});

/// The answer of a GET; --json prints it unchanged.
Outcome<JsonValue> get_document(const Context& context, const std::string& target);

}  // namespace fitgauge::cli
