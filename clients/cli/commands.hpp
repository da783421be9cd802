#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.hpp"
#include "record/fields.hpp"

namespace fitgauge::cli {

/// The request of a command line.
using Action = std::function<Outcome<ExitCode>(const Context&)>;

/// Registers every command. Parsing stores the action of one in `chosen`, which outlives `app`.
void add_commands(CLI::App& app, Action& chosen);

/// completion/fitgauge.bash, from the build.
extern const std::string_view kBashCompletion;

// Each subject registers its commands; add_commands() calls all of them.

void add_limits(CLI::App& app, Action& chosen);      ///< limits, fits, limit gauges, standards
void add_gauge(CLI::App& app, Action& chosen);       ///< gauge
void add_import(CLI::App& app, Action& chosen);      ///< import
void add_statistics(CLI::App& app, Action& chosen);  ///< figures of the values in a file
void add_records(CLI::App& app, Action& chosen);     ///< stored measurements: lists, corrections
void add_figures(CLI::App& app, Action& chosen);     ///< figures of stored measurements
void add_plans(CLI::App& app, Action& chosen);       ///< plan
void add_lsp(CLI::App& nc, Action& chosen);          ///< nc lsp
void add_programs(CLI::App& nc, Action& chosen);     ///< nc check, format and convert
void add_nc(CLI::App& nc, Action& chosen);           ///< nc run, and the files of the control
void add_runs(CLI::App& app, Action& chosen);        ///< runs
void add_control(CLI::App& app, Action& chosen);     ///< control
void add_replay(CLI::App& app, Action& chosen);      ///< replay
void add_stored(CLI::App& app, Action& chosen);      ///< documents and tables of the service
void add_watch(CLI::App& app, Action& chosen);       ///< watch

/// Registers one command whose options outlive the parsing; sets `chosen` to its action.
/// @returns the command and its options
template <class Options>
std::pair<CLI::App*, Options*> add_command(CLI::App& parent, const std::string& name,
                                           const std::string& help, Action& chosen,
                                           Outcome<ExitCode> (*run)(const Context&,
                                                                    const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = parent.add_subcommand(name, help);
  command->callback([&chosen, options, run] {
    chosen = [options, run](const Context& context) { return run(context, *options); };
  });
  return {command, options.get()};
}

/// Adds an option that may be given several times, each with one value.
inline CLI::Option* add_repeated(CLI::App& command, const std::string& name,
                                 std::vector<std::string>& values, const std::string& help) {
  return command.add_option(name, values, help)->expected(1)->take_all();
}

/// The option of a field or query parameter: `--part-expansion` of part_expansion_um_per_m_k.
std::string option_name(std::string_view field);

using Words = std::vector<std::string>;

/// A word after a command, and its help.
struct Word {
  std::string name{};
  std::string help{};
};

/// Registers a command of up to three words, the last of which may be left out.
template <class Run>
CLI::App* add_words(CLI::App& parent, const std::string& name, const std::string& help,
                    Action& chosen, const std::vector<Word>& words, std::size_t required,
                    const Run& run) {
  const auto values = std::make_shared<Words>(words.size());
  CLI::App* command = parent.add_subcommand(name, help);
  for (std::size_t i = 0; i < words.size(); ++i)
    command->add_option(words[i].name, values->at(i), words[i].help)->required(i < required);
  command->callback([&chosen, values, run] {
    chosen = [values, run](const Context& context) { return run(context, *values); };
  });
  return command;
}

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

}  // namespace fitgauge::cli
