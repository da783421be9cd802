#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>

#include "cli/commands.hpp"
#include "cli/local_files.hpp"

namespace fitgauge::cli {
namespace {

constexpr std::string_view kDefaultServer = "http://127.0.0.1:8286";
constexpr int kMeasureRetrySeconds = 60;

/// Options of every command.
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
      fmt::format("Address of the service (default: FITGAUGE_SERVER, else {})", kDefaultServer));
  app.add_option("--key-file", common.key_file,
                 "File with the API key (default: the key in FITGAUGE_KEY)");
  app.add_option("--ca", common.authority_file, "CA certificates to trust (PEM)");
  app.add_option("--cert", common.certificate_file, "Certificate of this client (PEM)");
  app.add_option("--cert-key", common.certificate_key_file, "Private key of --cert (PEM)");
  app.add_flag("--json", common.json, "Print the JSON responses of the service unchanged");
  app.add_option(
         "--retry", common.retry_seconds,
         "Seconds that a write waits for the service (default: 60 for import, 0 for others)")
      ->check(CLI::Range(0, 86'400));
}

/// Returns the key of --key-file or FITGAUGE_KEY; not of an argument, which other users can read.
Outcome<std::string> read_key(const CommonOptions& common) {
  std::string text = environment_variable("FITGAUGE_KEY");
  if (!common.key_file.empty()) text = TRY(read_file(common.key_file));
  const std::string_view key = trim(std::string_view(text).substr(0, text.find_first_of("\r\n")));
  const bool printable = std::ranges::all_of(key, [](char c) { return c > ' ' && c < '\x7F'; });
  if (printable) return std::string(key);
  return Failure{ExitCode::Usage, "the API key has a wrong character: copy it again"};
}

Outcome<Connection> connection_of(const CommonOptions& common) {
  std::string server = common.server;
  if (server.empty()) server = environment_variable("FITGAUGE_SERVER");
  if (server.empty()) server = kDefaultServer;
  auto url = TRY(service_url(server));
  auto key = TRY(read_key(common));
  return Connection{.url = std::move(url),
                    .key = std::move(key),
                    .authority_file = common.authority_file,
                    .certificate_file = common.certificate_file,
                    .certificate_key_file = common.certificate_key_file};
}

Outcome<ExitCode> run_action(const Action& action, const CommonOptions& common) {
  auto connection = TRY(connection_of(common));
  HttpClient client(std::move(connection));
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

/// Names the first unknown word, command or option, and the nearest known one.
/// @returns none if all are known, and another error applies.
std::optional<std::string> what_is_unknown(const CLI::App& command,
                                           const std::vector<std::string>& words) {
  const auto option =
      std::ranges::find_if(words, [](const auto& word) { return word.starts_with("--"); });
  const bool wants_command = command.get_require_subcommand_min() > 0;
  const bool is_option = option != words.end() && (!wants_command || option == words.begin());
  if (words.empty() || (!is_option && !wants_command)) return std::nullopt;
  const std::string word = is_option ? option->substr(0, option->find('=')) : words.front();
  SpellingHint hint(word);
  for (const CLI::App* app = &command; app != nullptr && is_option; app = app->get_parent()) {
    for (const CLI::Option* known : app->get_options()) hint.consider(known->get_name());
  }
  if (!is_option) {
    for (const CLI::App* known : command.get_subcommands({})) hint.consider(known->get_name());
  }
  std::string text = fmt::format("unknown {} '{}'", is_option ? "option" : "command", word);
  if (!hint.word().empty()) text += fmt::format("; did you mean '{}'?", hint.word());
  return text;
}

/// The part of a command line that cannot be read, and the command that was understood before it.
std::string usage_text(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  std::string name = "fitgauge";
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    name += ' ' + command->get_name();
  }
  const std::string what = what_is_unknown(*command, app.remaining(true)).value_or(error.what());
  return fmt::format("{}{} see {} --help", what, what.ends_with('?') ? "" : ";", name);
}

/// Fills closed standard descriptors with one that is neither read nor written (O_PATH): otherwise
/// the next socket would take their place.
void occupy_standard_descriptors() {
  int opened = 0;
  while (opened >= 0 && opened <= STDERR_FILENO) opened = ::open("/", O_PATH);
  if (opened >= 0) close(opened);
}

/// Runs `fitgauge`. @returns the exit code, an ExitCode.
int run_command_line(int argc, char** argv) {
  occupy_standard_descriptors();
  std::signal(SIGXFSZ, SIG_IGN);  // a file at its size limit is an error of a write
  CLI::App app(
      "Command line of the fitgauge service: look up limits and fits, judge and store "
      "measurements, run NC programs.",
      "fitgauge");
  CommonOptions common;
  Action action;
  app.require_subcommand(1);
  app.fallthrough();  // common options may follow the command
  app.set_version_flag("--version", "fitgauge " FITGAUGE_VERSION);
  add_common(app, common);
  add_commands(app, action);
  try {
    app.parse(argc, argv);
    if (app.got_subcommand("import") && app.count("--retry") == 0)
      common.retry_seconds = kMeasureRetrySeconds;
    for (int i = 1; i < argc; ++i) {
      if (!is_utf8(argv[i])) return complain({ExitCode::Usage, "an argument is not UTF-8"}, false);
    }
    const auto done = run_action(action, common);
    if (!done) return complain(done.error(), common.json);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      return complain({ExitCode::LocalFile, "standard output cannot be written"}, false);
    return end_with(*done);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return complain({ExitCode::Usage, usage_text(app, error)}, false);
  } catch (const std::exception& defect) {
    // fmt throws if the stream is full.
    if (std::ferror(stdout) != 0)
      return complain({ExitCode::LocalFile, "standard output cannot be written"}, false);
    return complain({ExitCode::Defect, std::string("internal error: ") + defect.what()}, false);
  }
}

}  // namespace
}  // namespace fitgauge::cli

int main(int argc, char** argv) { return fitgauge::cli::run_command_line(argc, argv); }
