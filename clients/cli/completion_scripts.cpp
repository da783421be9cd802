#include "cli/completion_scripts.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>

namespace fitgauge::cli {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) { return app.get_subcommands({}); }

bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

/// Whether what is typed there is a file of this machine.
bool takes_file(const CLI::Option& option) {
  constexpr std::array<std::string_view, 10> kFiles{
      "file",         "--contacts", "paths", "--state", "--output",
      "--setup-file", "--key-file", "--ca",  "--cert",  "--cert-key"};
  const std::string name = option.get_name();
  return std::any_of(kFiles.begin(), kFiles.end(), [&name](std::string_view file) {
    return name == file || name.starts_with(std::string(file) + ",");
  });
}

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

/// Help in a specification of zsh, where brackets and colons mean something.
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

/// The options of a command, then what it takes.
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

}  // namespace

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

}  // namespace fitgauge::cli
