#include "cli/commands.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/bash_completion.hpp"
#include "cli/gauge_command.hpp"
#include "cli/limits_commands.hpp"
#include "cli/measure_command.hpp"
#include "cli/nc_commands.hpp"
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

void add_gauge(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<GaugeOptions>();
  CLI::App* gauge = add_command(app, "gauge", "Judge a value: fitgauge gauge 25H7 25.013", chosen,
                                options, run_gauge);
  gauge->add_option("designation", options->designation, "Size and class")->required();
  gauge->add_option("measured", options->measured, "Measured value in mm")->required();
  gauge->add_option("--rule", options->rule, "simple or guard_band");
  gauge->add_option("--uncertainty-um", options->uncertainty_um, "Standard uncertainty in µm");
  gauge->add_option("--coverage-factor", options->coverage_factor, "k of the guard band, else 2");
  const auto record = gauge->add_flag("--record", options->record, "Store the measurement");
  const auto field = [&](const std::string& name, std::string& value, const std::string& help) {
    gauge->add_option(name, value, help)->needs(record);
  };
  field("--part-id", options->part_id, "Part, as its label says");
  field("--characteristic", options->characteristic, "What was measured on it");
  field("--order", options->order, "Work order");
  field("--operation", options->operation, "Operation");
  field("--machine", options->machine, "Machine");
  field("--operator", options->operator_name, "Who measured");
  field("--gauge", options->gauge, "Gauge");
  field("--unit", options->unit, "Production unit");
  field("--measured-at", options->measured_at, "RFC 3339 time, else now");
  field("--temperature-c", options->temperature_c, "Temperature of the part in °C");
  field("--comment", options->comment, "Remark");
}

void add_measure(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<MeasureOptions>();
  CLI::App* measure =
      add_command(app, "measure", "Store the rows of a CSV file", chosen, options, run_measure);
  measure->add_option("file", options->input, "CSV file, or - for standard input")->required();
  measure->add_option("--state", options->state_file, "File that says how far a stopped run was");
  measure->add_option("--chunk", options->chunk_rows, "Rows of one request, else 100000")
      ->check(CLI::Range(1, 100'000));
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

  const auto from = std::make_shared<std::string>();
  const auto to = std::make_shared<std::string>();
  CLI::App* get = nc.add_subcommand("get", "Fetch a file: nc get nc_prog/8255/8255.h");
  get->add_option("path", *from, "Path on the control")->required();
  get->add_option("file", *to, "File it goes to, else its name here; - is standard output");
  get->callback([&chosen, from, to] {
    chosen = [from, to](const Context& context) { return run_nc_get(context, *from, *to); };
  });
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
  completion->add_option("shell", *shell, "bash")->required()->check(CLI::IsMember({"bash"}));
  completion->callback([&chosen, shell] {  // the option writes to it
    chosen = [](const Context& context) -> Outcome<ExitCode> {
      context.print("{}", kBashCompletion);
      return ExitCode::Good;
    };
  });
}

}  // namespace

void add_commands(CLI::App& app, Action& chosen) {
  add_limits(app, chosen);
  add_gauge(app, chosen);
  add_measure(app, chosen);
  CLI::App* nc = app.add_subcommand("nc", "NC programs and the control's files");
  nc->require_subcommand(1);
  add_nc_programs(*nc, chosen);
  add_nc_files(*nc, chosen);
  add_tables(app, chosen);
  add_watch(app, chosen);
  add_about(app, chosen);
}

}  // namespace fitgauge::cli
