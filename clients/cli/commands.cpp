#include "cli/commands.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/bash_completion.hpp"
#include "cli/completion_scripts.hpp"
#include "cli/limits_commands.hpp"
#include "cli/registration.hpp"
#include "cli/stored_commands.hpp"
#include "cli/watch_command.hpp"

namespace fitgauge::cli {
namespace {

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

std::string option_name(std::string_view field) {
  constexpr std::string_view kUnit = "_um_per_m_k";
  if (field.ends_with(kUnit)) field.remove_suffix(kUnit.size());
  std::string name = "--" + std::string(field);
  std::ranges::replace(name, '_', '-');
  return name;
}

void add_commands(CLI::App& app, Action& chosen) {
  add_gauging(app, chosen);
  add_records(app, chosen);
  add_programs(app, chosen);
  for (const StoredKind& kind : kStoredKinds) add_stored(app, chosen, kind);
  add_tables(app, chosen);
  add_watch(app, chosen);
  add_about(app, chosen);
}

}  // namespace fitgauge::cli
