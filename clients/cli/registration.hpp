#pragma once

#include <CLI/CLI.hpp>

#include "cli/commands.hpp"

namespace fitgauge::cli {

// Each subject registers its commands here; add_commands() calls all of them.

void add_gauging(CLI::App& app, Action& chosen);  ///< limits, fits, gauge, measure, statistics
void add_records(CLI::App& app,
                 Action& chosen);  ///< stored measurements: lists, corrections, figures
void add_programs(CLI::App& app, Action& chosen);  ///< NC files and programs, runs, a control

/// Registers one command whose options outlive the parsing; sets `chosen` to its action.
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
  for (std::size_t i = 0; i < words.size(); ++i) {
    command->add_option(words[i].name, values->at(i), words[i].help)->required(i < required);
  }
  command->callback([&chosen, values, run] {
    chosen = [values, run](const Context& context) { return run(context, *values); };
  });
  return command;
}

}  // namespace fitgauge::cli
