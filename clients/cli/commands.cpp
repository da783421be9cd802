#include "cli/commands.hpp"

namespace fitgauge::cli {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) { return app.get_subcommands({}); }

bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

/// Kinds of values, and the last words of their options. An option may name its kind.
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
    if (type == kind || words.find(name) != words.npos || words.find(word) != words.npos)
      return kind;
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
  for (const CLI::App* command : commands)
    add_zsh(out, *command, function + '_' + command->get_name());
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

// The scripts of fish and zsh are made from the commands; that of bash is a file.
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

/// `fitgauge version`: of this program, and of the service with the revision of its tables.
Outcome<ExitCode> run_version(const Context& context) {
  if (!context.json) context.print("fitgauge {}\n", FITGAUGE_VERSION);
  const auto answer = TRY(context.send({.target = "/openapi.json"}));
  const auto document = TRY(context.document_of(answer));
  const std::string_view service = document.member("info").text_of("version");
  if (context.json) {
    context.print_document(JsonObject()
                               .add("fitgauge", FITGAUGE_VERSION)
                               .add("fitgauged", service)
                               .add("server", context.client.url())
                               .text());
  } else {
    context.print("fitgauged {} at {}\n", service, context.client.url());
  }
  return ExitCode::Good;
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
  for (const auto add :
       {add_limits, add_gauge, add_import, add_statistics, add_records, add_figures, add_plans})
    add(app, chosen);
  CLI::App* nc = app.add_subcommand("nc", "NC programs and the control's files");
  nc->require_subcommand(1);
  for (const auto add : {add_lsp, add_programs, add_nc}) add(*nc, chosen);
  for (const auto add : {add_runs, add_control, add_replay, add_stored, add_watch, add_about})
    add(app, chosen);
  name_values(app);
}

}  // namespace fitgauge::cli
