#include "cli/commands.hpp"

#include <CLI/CLI.hpp>

#include "cli/limits_commands.hpp"
#include "cli/registration.hpp"
#include "cli/stored_commands.hpp"
#include "cli/watch_command.hpp"

namespace fitgauge::cli {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) { return app.get_subcommands({}); }

bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

/// Kinds of values, and the last words of the options that have them. An option may name its kind
/// itself; others have any text.
constexpr std::pair<std::string_view, std::string_view> kValueKinds[] = {
    {"FILE", " file files paths programs target contacts state output ca cert key "},
    {"FOLDER", " files-to "},
    {"NUMBER",
     " um mm c nominal measured factor freedom expansion uncertainty probability confidence lower "
     "upper reference tolerance retry limit chunk baud count "},
    {"TIME", " from to at "},
    {"URL", " server "},
    {"HOST:PORT", " address "},
    {"NAME", " "}};

std::string_view kind_of(const CLI::Option& option) {
  const std::string name = ' ' + option.get_single_name() + ' ';
  const std::string word = ' ' + name.substr(name.find_last_of(" -", name.size() - 2) + 1);
  const std::string type = option.get_type_name();
  for (const auto& [kind, words] : kValueKinds) {
    if (type == kind || words.find(name) != words.npos || words.find(word) != words.npos) {
      return kind;
    }
  }
  return "TEXT";
}

void name_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (!is_flag(*option)) option->type_name(std::string(kind_of(*option)));
  }
  for (CLI::App* command : app.get_subcommands({})) name_values(*command);
}

bool takes_file(const CLI::Option& option) { return kind_of(option) == "FILE"; }

/// Text between single quotes of a shell.
std::string shell_text(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out + "'";
}

/// Help for a specification of zsh, in which brackets and colons have a meaning.
std::string zsh_help(std::string text) {
  for (char& c : text) {
    if (c == '[' || c == ']' || c == ':') c = ' ';
  }
  return text;
}

void add_fish(std::string& out, const CLI::App& app, const std::string& inside) {
  std::string names;
  for (const CLI::App* command : commands_of(app)) names += ' ' + command->get_name();
  const std::string here = inside.empty()
                               ? "__fish_use_subcommand"
                               : inside + "; and not __fish_seen_subcommand_from" + names;
  for (const CLI::App* command : commands_of(app)) {
    out += fmt::format("complete -c fitgauge -n {} -a {} -d {}\n", shell_text(here),
                       command->get_name(), shell_text(command->get_description()));
    add_fish(out, *command,
             (inside.empty() ? "" : inside + "; and ") + "__fish_seen_subcommand_from " +
                 command->get_name());
  }
  const std::string condition = inside.empty() ? "" : " -n " + shell_text(inside);
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_lnames().empty()) {
      if (takes_file(*option)) out += fmt::format("complete -c fitgauge{} -F\n", condition);
      continue;
    }
    out += fmt::format("complete -c fitgauge{} -l {} -d {}{}\n", condition,
                       option->get_lnames().front(), shell_text(option->get_description()),
                       is_flag(*option)      ? ""
                       : takes_file(*option) ? " -r -F"
                                             : " -x");
  }
}

/// The options of a command, then its arguments.
std::string zsh_arguments(const CLI::App& app) {
  std::string out;
  bool files = false;
  for (const CLI::Option* option : app.get_options()) {
    files = files || (option->get_lnames().empty() && takes_file(*option));
    for (const std::string& name : option->get_lnames()) {
      const std::string value = is_flag(*option)      ? ""
                                : takes_file(*option) ? ":file:_files"
                                                      : ":value:";
      out += " \\\n    " + shell_text(fmt::format("--{}[{}]{}", name,
                                                  zsh_help(option->get_description()), value));
    }
  }
  return files ? out + " \\\n    '*:file:_files'" : out;
}

void add_zsh(std::string& out, const CLI::App& app, const std::string& function) {
  const auto commands = commands_of(app);
  for (const CLI::App* command : commands) {
    add_zsh(out, *command, function + '_' + command->get_name());
  }
  out += function + "() {\n";
  if (commands.empty()) {
    out += "  _arguments" + zsh_arguments(app) + "\n}\n";
    return;
  }
  out += "  local state\n  local -a commands=(\n";
  for (const CLI::App* command : commands) {
    out += "    " + shell_text(command->get_name() + ":" + zsh_help(command->get_description())) +
           "\n";
  }
  out += "  )\n  _arguments -C" + zsh_arguments(app) +
         " \\\n    '1:command:->command' '*::rest:->rest'\n  case $state in\n"
         "    command) _describe command commands ;;\n    rest) case $words[1] in\n";
  for (const CLI::App* command : commands) {
    out += fmt::format("      {0}) {1}_{0} ;;\n", command->get_name(), function);
  }
  out += "    esac ;;\n  esac\n}\n";
}

// The completion scripts of fish and zsh are made from the commands, with their help. The script of
// bash is a file (completion/fitgauge.bash).
std::string fish_completion(const CLI::App& app) {
  std::string out = "# fish completion for fitgauge(1): fitgauge completion fish\n";
  out += "complete -c fitgauge -f\n";
  add_fish(out, app, "");
  return out;
}

std::string zsh_completion(const CLI::App& app) {
  std::string out =
      "#compdef fitgauge\n# zsh completion for fitgauge(1): fitgauge completion zsh\n";
  add_zsh(out, app, "_fitgauge");
  return out + "compdef _fitgauge fitgauge\n";
}

void add_stored(CLI::App& app, Action& chosen, const StoredKind& kind) {
  CLI::App* stored = app.add_subcommand(std::string(kind.command), std::string(kind.help));
  stored->require_subcommand(1);
  const Word name{"name", fmt::format("Name of {}", kind.what)};
  add_words(*stored, "ls", fmt::format("List the names of the {}", kind.command), chosen, {}, 0,
            [&kind](const Context& context, const Words&) { return run_stored_ls(context, kind); });
  add_words(*stored, "put", fmt::format("Store {}: {} put m3 m3.json", kind.what, kind.command),
            chosen, {name, {"file", "JSON file; - is standard input"}}, 2,
            [&kind](const Context& context, const Words& words) {
              return run_stored_put(context, kind, words[0], words[1]);
            });
  add_words(*stored, "get", fmt::format("Print {}, or write it to a file", kind.what), chosen,
            {name, {"file", "File to write (default: standard output)"}}, 1,
            [&kind](const Context& context, const Words& words) {
              return run_stored_get(context, kind, words[0], words[1]);
            });
  add_words(*stored, "rm", fmt::format("Delete {}", kind.what), chosen, {name}, 1,
            [&kind](const Context& context, const Words& words) {
              return run_stored_rm(context, kind, words[0]);
            });
}

void add_tables(CLI::App& app, Action& chosen) {
  CLI::App* tables = app.add_subcommand("tables", "Tolerance tables and custom tolerance classes");
  tables->require_subcommand(1);
  const auto options = std::make_shared<TableOptions>();
  CLI::App* out = add_command(*tables, "export", "Write a tolerance table: tables export hole",
                              chosen, options, run_tables_export);
  out->add_option("feature", options->feature, "Table: hole or shaft")
      ->required()
      ->check(CLI::IsMember({"hole", "shaft"}));
  out->add_option("--format", options->format,
                  "Format: csv, json, or tab for the control (default: csv)")
      ->check(CLI::IsMember({"csv", "json", "tab"}));
  out->add_option("--classes", options->classes, "Only these tolerance classes, such as H7,JS7");
  out->add_option("--revision", options->revision,
                  "Table revision to export (default: the current one)");
  out->add_option("--output,-o", options->output, "File to write (default: standard output)");
  const auto classes = [](const std::string& feature) {
    return StoredKind{
        "", "", "", feature == "hole" ? "/v1/tables/hole/classes" : "/v1/tables/shaft/classes", ""};
  };
  const auto of_feature = CLI::IsMember({"hole", "shaft"});
  const Word feature{"feature", "Table: hole or shaft"};
  const Word name{"name", "Name of the custom tolerance class"};
  add_words(*tables, "set", "Store a custom tolerance class: tables set hole PRESS press.json",
            chosen, {feature, name, {"file", "JSON file; - is standard input"}}, 3,
            [classes](const Context& context, const Words& words) {
              return run_stored_put(context, classes(words[0]), words[1], words[2]);
            })
      ->get_option("feature")
      ->check(of_feature);
  add_words(*tables, "reset", "Delete a custom tolerance class: the standard applies again", chosen,
            {feature, name}, 2,
            [classes](const Context& context, const Words& words) {
              return run_stored_rm(context, classes(words[0]), words[1]);
            })
      ->get_option("feature")
      ->check(of_feature);
}

void add_watch(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<WatchOptions>();
  CLI::App* watch = add_command(app, "watch", "Print measurements and ends of runs as they happen",
                                chosen, options, run_watch);
  watch
      ->add_option("--source", options->source, "Source: gauge, simulation or all (default: gauge)")
      ->check(CLI::IsMember({"gauge", "simulation", "all"}));
  watch->add_option("--after", options->after, "Start after the event with this id");
  watch->add_option("--count", options->count, "Stop after this number of events");
}

void add_about(CLI::App& app, Action& chosen) {
  app.add_subcommand("version", "Version of this program and of the service")->callback([&chosen] {
    chosen = run_version;
  });
  const auto shell = std::make_shared<std::string>();
  CLI::App* completion = app.add_subcommand("completion", "Print the completion script of a shell");
  completion->add_option("shell", *shell, "Shell: bash, fish or zsh")
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
  name_values(app);
}

}  // namespace fitgauge::cli
