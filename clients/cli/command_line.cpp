#include "cli/command_line.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <memory>

#include "base/text.hpp"
#include "cli/address.hpp"
#include "cli/bash_completion.hpp"
#include "cli/gauge_command.hpp"
#include "cli/input_file.hpp"
#include "cli/limits_commands.hpp"
#include "cli/measure_command.hpp"
#include "cli/nc_commands.hpp"
#include "cli/watch_command.hpp"

namespace fitgauge::cli {
namespace {

constexpr std::string_view kDefaultServer = "http://127.0.0.1:8286";
constexpr int kMeasureRetrySeconds = 60;

using Action = std::function<Outcome<ExitCode>(const Context&)>;

/// What every command takes.
struct CommonOptions {
  std::string server{};
  std::string key_file{};
  std::string authority_file{};
  std::string certificate_file{};
  std::string certificate_key_file{};
  bool json = false;
  int retry_seconds = 0;
};

void add_common(CLI::App& app, CommonOptions& common) {
  app.add_option(
      "--server", common.server,
      "Address of the service, else FITGAUGE_SERVER, else " + std::string(kDefaultServer));
  app.add_option("--key-file", common.key_file, "File with the API key, else FITGAUGE_KEY");
  app.add_option("--ca", common.authority_file, "Authorities to trust (PEM)");
  app.add_option("--cert", common.certificate_file, "Certificate of this client (PEM)");
  app.add_option("--cert-key", common.certificate_key_file, "Private key of --cert (PEM)");
  app.add_flag("--json", common.json, "Print the documents of the service");
  app.add_option("--retry", common.retry_seconds,
                 "Seconds a write waits for the service in all; measure: 60, others: 0")
      ->check(CLI::Range(0, 86'400));
}

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

/// The key of --key-file, else of FITGAUGE_KEY: never on the command line, where others see it.
Outcome<std::string> read_key(const CommonOptions& common) {
  std::string text = environment_variable("FITGAUGE_KEY");
  if (!common.key_file.empty()) {
    auto file = read_file(common.key_file);
    if (!file) return file;
    text = *std::move(file);
  }
  const std::string_view key = trim(std::string_view(text).substr(0, text.find_first_of("\r\n")));
  const bool printable =
      std::all_of(key.begin(), key.end(), [](char c) { return c > ' ' && c < '\x7F'; });
  if (printable) return std::string(key);
  return Failure{ExitCode::Usage, "the API key has a character that no key has: copy it again"};
}

Outcome<Connection> connection_of(const CommonOptions& common) {
  std::string server = common.server;
  if (server.empty()) server = environment_variable("FITGAUGE_SERVER");
  if (server.empty()) server = kDefaultServer;
  auto url = service_url(server);
  if (!url) return url.error();
  auto key = read_key(common);
  if (!key) return key.error();
  return Connection{.url = *std::move(url),
                    .key = *std::move(key),
                    .authority_file = common.authority_file,
                    .certificate_file = common.certificate_file,
                    .certificate_key_file = common.certificate_key_file};
}

Outcome<ExitCode> run_action(const Action& action, const CommonOptions& common) {
  auto connection = connection_of(common);
  if (!connection) return connection.error();
  HttpClient client(*std::move(connection));
  return action({.client = client,
                 .out = terminal_of(STDOUT_FILENO),
                 .err = terminal_of(STDERR_FILENO),
                 .json = common.json,
                 .retry_budget = std::chrono::seconds(common.retry_seconds)});
}

int end_with(ExitCode code) { return static_cast<int>(code); }

int complain(const Failure& failure, bool json) {
  if (json && !failure.document.empty()) {
    fmt::print(stderr, "{}\n", failure.document);
  } else {
    fmt::print(stderr, "fitgauge: {}\n", failure.message);
  }
  return end_with(failure.exit_code);
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app(
      "fitgauge asks and feeds the fitgauge service: ISO 286 limits, fits, verdicts, "
      "measurements, NC programs.",
      "fitgauge");
  CommonOptions common;
  Action action;
  app.require_subcommand(1);
  app.fallthrough();  // common options may stand behind the command
  app.set_version_flag("--version", "fitgauge " FITGAUGE_VERSION);
  add_common(app, common);
  add_limits(app, action);
  add_gauge(app, action);
  add_measure(app, action);
  CLI::App* nc = app.add_subcommand("nc", "NC programs and the control's files");
  nc->require_subcommand(1);
  add_nc_programs(*nc, action);
  add_nc_files(*nc, action);
  add_tables(app, action);
  add_watch(app, action);
  add_about(app, action);
  try {
    app.parse(argc, argv);
    if (app.got_subcommand("measure") && app.count("--retry") == 0) {
      common.retry_seconds = kMeasureRetrySeconds;
    }
    for (int i = 1; i < argc; ++i) {
      if (!is_utf8(argv[i])) {
        return complain({ExitCode::Usage, "an argument is not UTF-8"}, false);
      }
    }
    const auto done = run_action(action, common);
    if (!done) return complain(done.error(), common.json);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      return complain({ExitCode::LocalFile, "standard output cannot be written"}, false);
    }
    return end_with(*done);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return complain({ExitCode::Usage, std::string(error.what()) + "; see fitgauge --help"}, false);
  } catch (const std::exception& defect) {
    return complain({ExitCode::Defect, std::string("internal error: ") + defect.what()}, false);
  }
}

}  // namespace fitgauge::cli
