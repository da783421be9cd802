#include "cli/commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/bash_completion.hpp"
#include "cli/completion_scripts.hpp"
#include "cli/control_commands.hpp"
#include "cli/figure_commands.hpp"
#include "cli/gauge_command.hpp"
#include "cli/limits_commands.hpp"
#include "cli/measure_command.hpp"
#include "cli/nc_commands.hpp"
#include "cli/record_commands.hpp"
#include "cli/replay_command.hpp"
#include "cli/statistics_command.hpp"
#include "cli/stored_commands.hpp"
#include "cli/watch_command.hpp"

namespace fitgauge::cli {
namespace {

/// Registers one command whose options outlive the parsing; `chosen` becomes what it does.
template <class Options>
CLI::App* add_command(CLI::App& parent, const std::string& name, const std::string& help,
                      Action& chosen, const std::shared_ptr<Options>& options,
                      Outcome<ExitCode> (*run)(const Context&, const Options&)) {
  CLI::App* command = parent.add_subcommand(name, help);
  command->callback([&chosen, options, run] {
    chosen = [options, run](const Context& context) { return run(context, *options); };
  });
  return command;
}

void add_limits(CLI::App& app, Action& chosen) {
  const auto designation = std::make_shared<std::string>();
  add_command<std::string>(app, "limits", "Limits of size: fitgauge limits 25H7", chosen,
                           designation, run_limits)
      ->add_option("designation", *designation, "Size and class")
      ->required();
  const auto fit = std::make_shared<std::string>();
  add_command<std::string>(app, "fit", "A fit with its zones: fitgauge fit 25H7/g6", chosen, fit,
                           run_fit)
      ->add_option("fit", *fit, "Size, class of the hole, class of the shaft")
      ->required();
}

void add_tools(CLI::App& app, Action& chosen) {
  const auto designation = std::make_shared<std::string>();
  add_command<std::string>(app, "limit-gauge", "GO and NO-GO sizes: fitgauge limit-gauge 25H7",
                           chosen, designation, run_limit_gauge)
      ->add_option("designation", *designation, "Size and class")
      ->required();
  const auto search = std::make_shared<FitSearch>();
  CLI::App* fits = add_command(app, "fits", "Fits whose clearances lie between two bounds", chosen,
                               search, run_fits);
  fits->add_option("nominal", search->nominal_mm, "Nominal size in mm")->required();
  fits->add_option("--min-um", search->min_clearance_um, "Least clearance; interference is below 0")
      ->required();
  fits->add_option("--max-um", search->max_clearance_um, "Greatest clearance")->required();
  fits->add_option("--limit", search->limit, "Most fits, else 20")->check(CLI::Range(1, 1000));
  const auto standard = std::make_shared<StandardQuery>();
  CLI::App* standards = add_command(app, "standards", "Numbers of other standards than ISO 286",
                                    chosen, standard, run_standards);
  standards->add_option("name", standard->name, "iso2768-1, iso965-1, din6885-1 or iso492");
  standards->add_option("--size-mm", standard->size_mm, "Only what holds for this size");
}

void add_statistics(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<StatisticsOptions>();
  CLI::App* statistics = add_command(app, "statistics", "Figures of values in a file", chosen,
                                     options, run_statistics);
  statistics
      ->add_option("figure", options->figure,
                   "summary, anova, capability, chart, type1, grr, pairing or uncertainty")
      ->required()
      ->check(CLI::IsMember(
          {"summary", "anova", "capability", "chart", "type1", "grr", "pairing", "uncertainty"}));
  statistics->add_option("file", options->file, "JSON as the HTTP API takes it, or a value a line")
      ->required();
  statistics->add_option("--lower", options->lower, "Lower limit of capability");
  statistics->add_option("--upper", options->upper, "Upper limit of capability");
  statistics->add_option("--reference", options->reference, "Size of the master of type1");
  statistics->add_option("--tolerance", options->tolerance, "Of what the gauge of type1 is for");
}

void add_gauge(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<GaugeOptions>();
  CLI::App* gauge = add_command(app, "gauge", "Judge a value: fitgauge gauge 25H7 25.013", chosen,
                                options, run_gauge);
  gauge->add_option("designation", options->designation, "Size and class, or the nominal size")
      ->required();
  const auto measured = gauge->add_option("measured", options->measured, "Measured value in mm");
  const auto serial = gauge->add_option("--serial", options->serial, "Port whose lines are values")
                          ->excludes(measured);
  gauge->add_option("--baud", options->baud, "Of the port, else 9600")->needs(serial);
  gauge->add_option("--pattern", options->pattern, "Regular expression of a whole line")
      ->needs(serial);
  gauge->add_option("--rule", options->rule, "simple, guard_band or conformance");
  gauge->add_option("--uncertainty-um", options->uncertainty_um, "Standard uncertainty in µm");
  gauge->add_option("--coverage-factor", options->coverage_factor, "k of the guard band, else 2");
  gauge->add_option("--probability", options->probability, "Of conformance, else 0.95");
  gauge->add_option("--temperature-c", options->temperature_c, "Temperature of the part in °C");
  gauge->add_option("--part-material", options->part_material, "steel: corrects to 20 °C");
  gauge->add_option("--part-expansion", options->part_expansion, "The same in µm/(m·K)");
  gauge->add_option("--scale-temperature-c", options->scale_temperature_c,
                    "Temperature of what it was read on, else 20");
  gauge->add_option("--scale-material", options->scale_material, "Of what it was read on");
  gauge->add_option("--scale-expansion", options->scale_expansion, "The same in µm/(m·K)");
  const auto record = gauge->add_flag("--record", options->record, "Store the measurement");
  const auto field = [&](const std::string& name, std::string& value, const std::string& help) {
    gauge->add_option(name, value, help)->needs(record);
  };
  const auto feature =
      gauge->add_option("--feature", options->feature, "hole or shaft, with a drawing's own limits")
          ->needs(record)
          ->check(CLI::IsMember({"hole", "shaft"}));
  const auto upper = gauge->add_option("--upper-um", options->upper_um, "Upper deviation in µm");
  const auto lower = gauge->add_option("--lower-um", options->lower_um, "Lower deviation in µm");
  upper->needs(feature);
  lower->needs(feature);
  field("--part-id", options->part_id, "Part, as its label says");
  field("--characteristic", options->characteristic, "What was measured on it");
  field("--order", options->order, "Work order");
  field("--operation", options->operation, "Operation");
  field("--machine", options->machine, "Machine");
  field("--operator", options->operator_name, "Who measured");
  field("--gauge", options->gauge, "Gauge");
  field("--unit", options->unit, "Production unit");
  gauge->add_option("--measured-at", options->measured_at, "RFC 3339 time, else now")
      ->needs(record)
      ->excludes(serial);
  field("--comment", options->comment, "Remark");
}

void add_measure(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<MeasureOptions>();
  CLI::App* measure =
      add_command(app, "measure", "Store the rows of a CSV file, or the values of a DFQ", chosen,
                  options, run_measure);
  measure->add_option("file", options->input, "CSV file or DFQ, or - for standard input")
      ->required();
  measure->add_option("--state", options->state_file, "File that says how far a stopped run was");
  measure->add_option("--chunk", options->chunk_rows, "Rows of one request, else 100000")
      ->check(CLI::Range(1, 100'000));
  measure
      ->add_option("--map", options->columns,
                   "Column and field: Istwert=measured_mm; also date and time, or none")
      ->allow_extra_args(false);
  measure->add_option("--set", options->constants, "Field and value of all rows: machine=M3")
      ->allow_extra_args(false);
  measure->add_option("--time-zone", options->time_zone, "Of times without an offset");
  measure->add_option("--length-unit", options->length_unit, "Of a DFQ that names none: mm, inch");
  measure->add_option("--encoding", options->encoding, "auto, utf-8, utf-16 or windows-1252");
  measure->add_flag("--leave-out-others", options->leave_out_others,
                    "Columns that are no field are left out");
  measure->add_flag("--again", options->again, "Store rows that were stored before once more");
  measure->add_flag("--exit-verdict", options->exit_verdict, "The exit code is the worst verdict");
}

void add_nc_files(CLI::App& nc, Action& chosen) {
  const auto prefix = std::make_shared<std::string>();
  add_command<std::string>(nc, "ls", "List the control's files", chosen, prefix, run_nc_ls)
      ->add_option("prefix", *prefix, "Only paths that begin so");

  const auto paths = std::make_shared<std::vector<std::string>>();
  CLI::App* put = nc.add_subcommand("put", "Store files: nc put 8255.h nc_prog/8255/");
  put->add_option("paths", *paths, "Files, then the path or the folder/ they get")
      ->required()
      ->expected(2, CLI::detail::expected_max_vector_size);
  put->callback([&chosen, paths] {
    chosen = [paths](const Context& context) {
      return run_nc_put(context, {paths->begin(), paths->end() - 1}, paths->back());
    };
  });

  const auto options = std::make_shared<GetOptions>();
  CLI::App* get = add_command(nc, "get", "Fetch a file: nc get nc_prog/8255/8255.h", chosen,
                              options, run_nc_get);
  get->add_option("path", options->path, "Path on the control")->required();
  get->add_option("file", options->file,
                  "File it goes to, else its name here; - is standard output");
  get->add_flag("--force", options->force, "Replace a file that is there");
}

void add_nc_programs(CLI::App& nc, Action& chosen) {
  const auto path = std::make_shared<std::string>();
  add_command<std::string>(nc, "check", "Check a program, a mask or a table", chosen, path,
                           run_nc_check)
      ->add_option("path", *path, "Path on the control")
      ->required();

  const auto options = std::make_shared<RunOptions>();
  CLI::App* run =
      add_command(nc, "run", "Run a program on a simulated machine", chosen, options, run_nc_run);
  run->add_option("program", options->program, "Path on the control")->required();
  const auto setup = run->add_option("--setup", options->setup, "Name of a stored setup");
  run->add_option("--setup-file", options->setup_file, "JSON file with a setup")->excludes(setup);
  run->add_option("--set", options->parameters, "Parameter before block 0: Q1=25, QS1=H7")
      ->expected(1)
      ->take_all();
  run->add_option("--on-stop", options->on_stop, "At STOP: continue or end");
  run->add_option("--language", options->language, "Of masks: english, german, dutch, italian");
  run->add_flag("--block-skip", options->block_skip, "Pass over blocks that begin with /");
}

void add_replay(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App* replay =
      add_command(app, "replay", "Compare a machine's log with the same contacts here", chosen,
                  options, run_replay);
  replay->add_option("program", options->run.program, "Path on the control")->required();
  replay->add_option("file", options->log, "Measuring log of the machine")->required();
  replay->add_option("--contacts", options->contacts, "JSON file: [[X, Y, Z], null, …]")
      ->required();
  const auto setup = replay->add_option("--setup", options->run.setup, "Name of a stored setup");
  replay->add_option("--setup-file", options->run.setup_file, "JSON file with a setup")
      ->excludes(setup);
}

void add_filters(CLI::App& command, const std::shared_ptr<RecordQuery>& query) {
  for (std::size_t i = 0; i < kRecordFilters.size(); ++i) {
    const RecordFilter& filter = kRecordFilters.at(i);
    command.add_option(std::string(filter.option), query->filters.at(i), std::string(filter.help));
  }
}

void add_figures(CLI::App& app, Action& chosen) {
  const std::string help = "use, or ignore to take the values one by one";
  const auto indices = std::make_shared<CapabilityQuery>();
  CLI::App* capability = add_command(app, "capability", "Capability of what is stored", chosen,
                                     indices, run_capability);
  add_filters(*capability, indices);
  capability->add_option("--target-mm", indices->target_mm, "Of cpm, else the middle");
  capability->add_option("--confidence", indices->confidence, "Of the intervals, else 0.95");
  capability->add_option("--subgroups", indices->subgroups, help)
      ->check(CLI::IsMember({"use", "ignore"}));

  const auto query = std::make_shared<ChartQuery>();
  CLI::App* chart =
      add_command(app, "chart", "Control chart of what is stored", chosen, query, run_chart);
  add_filters(*chart, query);
  chart->add_option("--kind", query->kind, "xbar_r with subgroups, else i_mr, when not given")
      ->check(CLI::IsMember({"i_mr", "xbar_r", "xbar_s", "ewma", "cusum"}));
  chart->add_option("--rules", query->rules, "Of Western Electric: 1,2,3,4");
  chart->add_option("--subgroups", query->subgroups, help)->check(CLI::IsMember({"use", "ignore"}));
}

void add_records(CLI::App& app, Action& chosen) {
  auto query = std::make_shared<RecordQuery>();
  CLI::App* list = add_command(app, "list", "Print stored measurements", chosen, query, run_list);
  add_filters(*list, query);
  list->add_option("--limit", query->limit, "Most records, else 100")->check(CLI::Range(1, 1000));
  list->add_option("--after", query->after, "Begin where the page before ended");

  query = std::make_shared<RecordQuery>();
  CLI::App* out = add_command(app, "export", "Write all stored measurements that match", chosen,
                              query, run_export);
  add_filters(*out, query);
  out->add_option("--format", query->format, "csv, ndjson, dfq of Q-DAS, qif or xlsx")
      ->check(CLI::IsMember({"csv", "ndjson", "dfq", "qif", "xlsx"}));
  out->add_option("--time-zone", query->time_zone,
                  "Of the times of dfq and xlsx: Europe/Berlin; else UTC");
  out->add_option("--output,-o", query->output, "File, else standard output");

  query = std::make_shared<RecordQuery>();
  CLI::App* summary = add_command(app, "summary", "Count, mean and scatter of each group", chosen,
                                  query, run_summary);
  add_filters(*summary, query);
  summary->add_option("--group-by", query->group_by, "Field of the groups, else characteristic");

  const auto options = std::make_shared<CorrectOptions>();
  CLI::App* correct = add_command(app, "correct", "Correct a record: fitgauge correct m17 25.0131",
                                  chosen, options, run_correct);
  correct->add_option("id", options->id, "The record")->required();
  correct->add_option("measured", options->measured, "Right value in mm")->required();
  correct->add_option("--reason", options->reason, "Why it is corrected")->required();

  const auto said = std::make_shared<NoteOptions>();
  CLI::App* note = add_command(
      app, "note", "Note a cause or measure beside a record; without one, show its notes", chosen,
      said, run_note);
  note->add_option("id", said->id, "The record")->required();
  note->add_option("--cause", said->cause, "Why the value is what it is");
  note->add_option("--measure", said->measure, "What was done about it");
  note->add_option("--text", said->text, "Whatever else");
  note->add_option("--operator", said->operator_name, "Who says so");
}

/// Registers a command of up to three words, the last of which may be left out.
template <class Run>
CLI::App* add_words(CLI::App& parent, const std::string& name, const std::string& help,
                    Action& chosen, const std::vector<std::string>& words, std::size_t required,
                    const Run& run) {
  const auto values = std::make_shared<std::vector<std::string>>(words.size());
  CLI::App* command = parent.add_subcommand(name, help);
  for (std::size_t i = 0; i < words.size(); ++i) {
    command->add_option(words[i], values->at(i))->required(i < required);
  }
  command->callback([&chosen, values, run] {
    chosen = [values, run](const Context& context) { return run(context, *values); };
  });
  return command;
}

using Words = std::vector<std::string>;

void add_stored(CLI::App& app, Action& chosen, const StoredKind& kind) {
  CLI::App* stored = app.add_subcommand(std::string(kind.command), std::string(kind.help));
  stored->require_subcommand(1);
  add_words(*stored, "ls", "List their names", chosen, {}, 0,
            [&kind](const Context& context, const Words&) { return run_stored_ls(context, kind); });
  add_words(*stored, "put", fmt::format("Store {}: {} put m3 m3.json", kind.what, kind.command),
            chosen, {"name", "file"}, 2, [&kind](const Context& context, const Words& words) {
              return run_stored_put(context, kind, words[0], words[1]);
            });
  add_words(*stored, "get", fmt::format("Print {}, or write it into a file", kind.what), chosen,
            {"name", "file"}, 1, [&kind](const Context& context, const Words& words) {
              return run_stored_get(context, kind, words[0], words[1]);
            });
  add_words(*stored, "rm", fmt::format("Delete {}", kind.what), chosen, {"name"}, 1,
            [&kind](const Context& context, const Words& words) {
              return run_stored_rm(context, kind, words[0]);
            });
}

void add_control(CLI::App& app, Action& chosen) {
  CLI::App* control = app.add_subcommand("control", "A HEIDENHAIN control over LSV-2");
  control->require_subcommand(1);
  add_words(*control, "ls", "List a folder of a control", chosen, {"address", "directory"}, 1,
            [](const Context& context, const Words& words) {
              return run_control_ls(context, words[0], words[1]);
            });
  const auto got = std::make_shared<ControlGetOptions>();
  CLI::App* get = add_command(*control, "get", "Fetch a file: control get tnc TNC:/log.txt", chosen,
                              got, run_control_get);
  get->add_option("address", got->address, "The control: HOST or HOST:PORT")->required();
  get->add_option("path", got->path, "Path on the control")->required();
  get->add_option("file", got->file, "File it goes to, else its name here; - is standard output");
  get->add_flag("--force", got->force, "Replace a file that is there");
  const auto put = std::make_shared<ControlPutOptions>();
  CLI::App* send = add_command(*control, "put", "Send files: control put tnc part.h TNC:/nc_prog/",
                               chosen, put, run_control_put);
  send->add_option("paths", put->words, "The control, files, then the path or the folder/ they get")
      ->required()
      ->expected(3, CLI::detail::expected_max_vector_size);
  send->add_flag("--force", put->force, "Replace a file that is on the control");
  add_words(*control, "run", "Run a program of a virtual control", chosen, {"address", "program"},
            2, [](const Context& context, const Words& words) {
              return run_control_run(context, words[0], words[1]);
            });
  add_words(*control, "state", "Mode, program, axes and errors of a control", chosen, {"address"},
            1, [](const Context& context, const Words& words) {
              return run_control_state(context, words[0]);
            });
}

void add_runs(CLI::App& app, Action& chosen) {
  CLI::App* runs = app.add_subcommand("runs", "The runs of NC programs");
  runs->require_subcommand(1);
  const auto query = std::make_shared<RunsQuery>();
  CLI::App* list =
      add_command(*runs, "ls", "List the runs, the newest first", chosen, query, run_runs_ls);
  list->add_option("--status", query->status, "queued, running, completed, stopped, failed, …");
  list->add_option("--program", query->program, "Only this program");
  list->add_option("--limit", query->limit, "Most runs, else 100")->check(CLI::Range(1, 1000));
  list->add_option("--after", query->after, "Begin where the page before ended");
  add_words(
      *runs, "show", "Screen, messages and files of a run", chosen, {"id"}, 1,
      [](const Context& context, const Words& words) { return run_runs_show(context, words[0]); });
  add_words(*runs, "get", "Print a file a run has written", chosen, {"id", "name", "file"}, 2,
            [](const Context& context, const Words& words) {
              return run_runs_get(context, words[0], words[1], words[2]);
            });
  add_words(*runs, "cancel", "Cancel a run that is queued or under way", chosen, {"id"}, 1,
            [](const Context& context, const Words& words) {
              return run_runs_cancel(context, words[0]);
            });
}

void add_tables(CLI::App& app, Action& chosen) {
  CLI::App* tables = app.add_subcommand("tables", "The tolerance tables");
  tables->require_subcommand(1);
  const auto options = std::make_shared<TableOptions>();
  CLI::App* out = add_command(*tables, "export", "Write a table: tables export hole", chosen,
                              options, run_tables_export);
  out->add_option("feature", options->feature, "hole or shaft")
      ->required()
      ->check(CLI::IsMember({"hole", "shaft"}));
  out->add_option("--format", options->format, "csv, json, or tab for the control")
      ->check(CLI::IsMember({"csv", "json", "tab"}));
  out->add_option("--classes", options->classes, "Only these classes: H7,JS7");
  out->add_option("--revision", options->revision, "As the tables were");
  out->add_option("--output,-o", options->output, "File, else standard output");
}

void add_watch(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<WatchOptions>();
  CLI::App* watch =
      add_command(app, "watch", "Print what happens as it happens", chosen, options, run_watch);
  watch->add_option("--source", options->source, "gauge, simulation or all; gauge when absent")
      ->check(CLI::IsMember({"gauge", "simulation", "all"}));
  watch->add_option("--after", options->after, "Begin behind the event of this id");
  watch->add_option("--count", options->count, "End after so many events");
}

void add_about(CLI::App& app, Action& chosen) {
  app.add_subcommand("version", "Version of this program and of the service")->callback([&chosen] {
    chosen = run_version;
  });
  const auto shell = std::make_shared<std::string>();
  CLI::App* completion = app.add_subcommand("completion", "Print the completion script");
  completion->add_option("shell", *shell, "bash, fish or zsh")
      ->required()
      ->check(CLI::IsMember({"bash", "fish", "zsh"}));
  completion->callback([&app, &chosen, shell] {
    chosen = [&app, shell](const Context& context) -> Outcome<ExitCode> {
      context.print("{}", *shell == "fish"  ? fish_completion(app)
                          : *shell == "zsh" ? zsh_completion(app)
                                            : std::string(kBashCompletion));
      return ExitCode::Good;
    };
  });
}

}  // namespace

void add_commands(CLI::App& app, Action& chosen) {
  add_limits(app, chosen);
  add_tools(app, chosen);
  add_gauge(app, chosen);
  add_measure(app, chosen);
  CLI::App* nc = app.add_subcommand("nc", "NC programs and the control's files");
  nc->require_subcommand(1);
  add_nc_programs(*nc, chosen);
  add_nc_files(*nc, chosen);
  add_records(app, chosen);
  add_figures(app, chosen);
  add_statistics(app, chosen);
  for (const StoredKind& kind : kStoredKinds) add_stored(app, chosen, kind);
  add_runs(app, chosen);
  add_control(app, chosen);
  add_replay(app, chosen);
  add_tables(app, chosen);
  add_watch(app, chosen);
  add_about(app, chosen);
}

}  // namespace fitgauge::cli
