#include "daemon/parts.hpp"

#include <unistd.h>
#include <CLI/CLI.hpp>

#include <csignal>
#include <iostream>

#include "daemon/log.hpp"

namespace fitgauge::daemon {
namespace {

using Steady = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kBetweenGlances{100};
constexpr seconds kBetweenLines{2};
constexpr seconds kCentrePatience{60};
constexpr seconds kRefusalPatience{5};

/// Writes the service's log lines to the terminal.
void print(std::string_view event, const std::string& detail) {
  std::cerr << fmt::format("fitgauged: {}: {}\n", event, detail);
}

/// `fitgauged forward --all`: forwards the whole log of the folder to the centre and ends; 1 if the
/// centre refuses it, or cannot be reached for a minute. A repeat continues at the end.
Result<int> run_forward_all(const Config& config) {
  if (config.forward_to.empty())
    return config_error("forward --all needs forward-to, the centre's address");
  const SystemClock clock;
  app::ApplicationOptions options = application_options(config);
  options.log_told = print;
  const auto opened = TRY(app::Application::open(options, clock));
  app::Application& app = *opened;
  const auto forwarder = start_forwarder(config, app, print);

  auto told = Steady::now();
  auto went_on = told;
  auto held = told;  // a centre knows a new key after two seconds
  std::int64_t fewest = -1;
  while (true) {
    const auto state = forwarder->state();
    const auto now = Steady::now();
    if (fewest < 0 || state.rows < fewest) {
      fewest = state.rows;
      went_on = now;
    }
    if (state.rows == 0 && state.failure.empty() && !state.sends) break;
    if (!state.is_refused) held = now;
    if (now > held + kRefusalPatience || now > went_on + kCentrePatience) {
      std::cout << fmt::format("{} measurements have not reached {}: {}\n", state.rows,
                               config.forward_to, state.failure);
      return 1;
    }
    if (now > told + kBetweenLines) {
      told = now;
      std::cout << fmt::format("{} measurements to go\n", state.rows) << std::flush;
    }
    std::this_thread::sleep_for(kBetweenGlances);
  }
  std::cout << fmt::format("all measurements of {} have reached {}\n", app.log().head_text(),
                           config.forward_to);
  return 0;
}

constexpr int kFailed = 1;
constexpr int kUsage = 2;

/// Settings of the command line, before they override the other sources.
struct Arguments {
  std::string config_file;
  std::string port_file;
  bool check_config = false;
  bool print_config = false;
  bool healthcheck = false;
  std::map<std::string_view, std::vector<std::string>> settings;
};

int complain(const Error& error) {
  std::cerr << "fitgauged: " << error.message << '\n';
  return error.code == ErrorCode::ConfigInvalid ? kUsage : kFailed;
}

std::vector<std::string> environment() {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable)
    variables.emplace_back(*variable);
  return variables;
}

/// Names the first unknown option or command and the nearest known one; else returns `fallback`.
std::string usage_text(const CLI::App& app, std::string fallback) {
  const std::vector<std::string> words = app.remaining(true);
  const auto option =
      std::ranges::find_if(words, [](const auto& word) { return word.starts_with('-'); });
  if (words.empty()) return fallback + ';';
  const bool is_option = option != words.end();
  const std::string word = is_option ? option->substr(0, option->find('=')) : words.front();
  SpellingHint hint(word);
  if (!is_option) {
    for (const CLI::App* known : app.get_subcommands({})) hint.consider(known->get_name());
  }
  for (const CLI::App* each = &app; is_option && each != nullptr;) {
    for (const CLI::Option* known : each->get_options()) hint.consider(known->get_name());
    each = each->get_subcommands().empty() ? nullptr : each->get_subcommands().front();
  }
  const std::string nearest = hint.text();
  return fmt::format("unknown {} '{}'{}", is_option ? "option" : "command", word,
                     nearest.empty() ? ";" : nearest);
}

void add_options(CLI::App& app, Arguments& arguments) {
  app.add_option("--config", arguments.config_file, "TOML file with these settings")
      ->type_name("FILE")
      ->envname("FITGAUGE_CONFIG");
  for (const Setting& setting : settings()) {
    auto& values = arguments.settings[setting.name];
    if (setting.flag != nullptr) {
      app.add_flag_callback(
          "--" + std::string(setting.name), [&values] { values = {"true"}; }, help_text(setting));
      continue;
    }
    std::string help = help_text(setting);
    if (const auto value = default_text(setting); !value.empty())
      help += fmt::format(" (default: {})", value);
    auto* option = app.add_option("--" + std::string(setting.name), values, help)
                       ->type_name(std::string(setting.kind));
    if (setting.texts == nullptr) option->expected(1);
  }
  app.add_option("--port-file", arguments.port_file,
                 "File that receives the port when the service listens")
      ->type_name("FILE");
  app.add_flag("--check-config", arguments.check_config, "Check the configuration and exit");
  app.add_flag("--print-config", arguments.print_config, "Print the configuration and exit");
  app.add_flag("--healthcheck", arguments.healthcheck,
               "Check if the running service is ready, and exit");
  app.set_version_flag("--version", "fitgauged " + std::string(api::kVersion));
}

/// Defaults < file < environment < flags.
Result<Config> configuration(const Arguments& arguments) {
  Config config;
  if (!arguments.config_file.empty()) TRY(read_toml(arguments.config_file, config));
  TRY(read_environment(environment(), config));
  for (const Setting& setting : settings()) {
    const auto& values = arguments.settings.at(setting.name);
    if (values.empty()) continue;
    const std::string text = fmt::format("{}", fmt::join(values, ","));
    TRY(assign(setting, text, config));
  }
  TRY(check(config));
  return config;
}

/// The subcommands and their functions.
struct Commands {
  explicit Commands(CLI::App& app) {
    app.require_subcommand(0, 1);
    // Settings are accepted before and after the command: `fitgauged verify --data DIR`.
    app.fallthrough();
    backup = app.add_subcommand("backup",
                                "Write a consistent copy of the database; the service may run");
    backup->add_option("file", file, "New file for the copy")->type_name("FILE")->required();
    verify = app.add_subcommand("verify",
                                "Check the database, the tables, the log and every stored verdict");
    verify
        ->add_option("--checkpoint", checkpoints,
                     "File with a checkpoint from a safe place; the log must contain it")
        ->type_name("FILE");
    qualify =
        app.add_subcommand("qualify", "Compare the results of this program with published figures");
    qualify->add_option("--out", folder, "Folder for qualification.json and qualification.pdf")
        ->type_name("FOLDER")
        ->required();
    log_key =
        app.add_subcommand("log-key", "Create a new key that signs the log from the next start");
    forward = app.add_subcommand("forward", "Forward the log of a stopped service to a centre");
    forward->add_flag("--all", all, "Forward the whole log, then exit")->required();
    key = app.add_subcommand("key", "Create, list and revoke API keys");
    key->require_subcommand(1);
    create = key->add_subcommand("create", "Create a key and print it once");
    create->add_option("--name", name, "Name of the person or machine that uses the key")
        ->type_name("NAME")
        ->required();
    create->add_option("--role", role, "Role: viewer, operator, admin or station")
        ->type_name("WORD")
        ->required();
    create->add_option("--expires", expires, "Time of expiry, such as 2027-01-01T00:00:00Z")
        ->type_name("TIME");
    revoke = key->add_subcommand("revoke", "Revoke a key");
    revoke->add_option("--name", name, "Name of the key")->type_name("NAME")->required();
    list = key->add_subcommand("list", "List the keys");
  }

  /// @param has_data whether the data folder is given, not assumed
  Result<int> run(const Config& config, bool has_data) const {
    if (*qualify) return run_qualify(config, folder, has_data);
    if (*backup) return run_backup(config, file);
    if (*verify) return run_verify(config, checkpoints);
    if (*log_key) return run_log_key(config);
    if (*forward) return run_forward_all(config);
    if (*create) return run_key_create(config, name, role, expires);
    if (*revoke) return run_key_revoke(config, name);
    return run_key_list(config);
  }

  CLI::App* backup = nullptr;
  CLI::App* verify = nullptr;
  CLI::App* qualify = nullptr;
  CLI::App* log_key = nullptr;
  CLI::App* forward = nullptr;
  CLI::App* key = nullptr;
  CLI::App* create = nullptr;
  CLI::App* revoke = nullptr;
  CLI::App* list = nullptr;
  bool all = false;
  std::string file;
  std::string folder;
  std::vector<std::string> checkpoints;
  std::string name;
  std::string role;
  std::optional<std::string> expires;
};

int dispatch(const CLI::App& app, const Arguments& arguments, const Commands& commands) {
  const auto config = configuration(arguments);
  if (!config) return complain(config.error());
  if (arguments.print_config) {
    std::cout << to_toml(*config);
    return 0;
  }
  if (arguments.check_config) {
    const auto checked = preflight(*config, arguments.port_file);
    return checked ? 0 : complain(checked.error());
  }
  if (arguments.healthcheck) {
    const auto healthy = healthcheck(*config);
    return healthy ? 0 : complain(healthy.error());
  }
  if (!app.get_subcommands().empty()) {
    const bool has_data = !arguments.settings.at("data").empty() || config->data != Config{}.data;
    const auto done = commands.run(*config, has_data);
    if (done) return *done;
    complain(done.error());
    // Findings of verify and qualify are 1: that they could not look is another thing.
    return *commands.verify || *commands.qualify || done.error().code == ErrorCode::ConfigInvalid
               ? kUsage
               : kFailed;
  }
  open_log(config->log_level);
  const auto served = serve(*config, arguments.port_file);
  close_log();
  return served ? 0 : complain(served.error());
}

/// Reads flags, environment and file, then serves or runs a command.
/// @returns the exit code: 0, 1 if the service cannot run or a check has findings, 2 if the command
/// line or the configuration is wrong. One line on stderr has the reason.
int run_command_line(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file at its size limit is an error of a write
  CLI::App app(
      "Service for ISO 286 limits, verdicts on measured diameters and Klartext probe programs over "
      "HTTP.",
      "fitgauged");
  Arguments arguments;
  add_options(app, arguments);
  const Commands commands(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::cerr << "fitgauged: " << usage_text(app, error.what()) << " see fitgauged --help\n";
    return kUsage;
  }
  try {
    return dispatch(app, arguments, commands);
  } catch (const std::exception& defect) {
    std::cerr << "fitgauged: internal error: " << defect.what() << '\n';
    return kFailed;
  }
}

}  // namespace
}  // namespace fitgauge::daemon

int main(int argc, char** argv) { return fitgauge::daemon::run_command_line(argc, argv); }
