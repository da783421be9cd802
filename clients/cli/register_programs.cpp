#include "cli/registration.hpp"

#include "cli/control_commands.hpp"
#include "cli/nc_commands.hpp"
#include "cli/stored_commands.hpp"

namespace fitgauge::cli {
namespace {

void add_nc_files(CLI::App& nc, Action& chosen) {
  const auto prefix = std::make_shared<std::string>();
  add_command<std::string>(nc, "ls", "List the control's files", chosen, prefix, run_nc_ls)
      ->add_option("prefix", *prefix, "Only paths that begin with this text");

  const auto paths = std::make_shared<std::vector<std::string>>();
  CLI::App* put = nc.add_subcommand("put", "Store files: nc put 8255.h nc_prog/8255/");
  put->add_option("paths", *paths, "Files, then the path or folder/ on the control")
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
                  "Local file (default: the same name); - is standard output");
  get->add_flag("--force", options->force, "Replace an existing file");
}

void add_nc_programs(CLI::App& nc, Action& chosen) {
  const auto add_levels = [](CLI::App& command, std::vector<std::string>& levels) {
    command.add_option("--level", levels, "Level of a code: CODE=off, note, warning or error")
        ->expected(1)
        ->take_all();
  };
  const auto levels = std::make_shared<std::vector<std::string>>();
  add_levels(
      *add_command(nc, "lsp", "Run a language server for an editor on standard input and output",
                   chosen, levels, run_nc_lsp),
      *levels);
  const auto checked = std::make_shared<CheckOptions>();
  CLI::App* check = add_command(nc, "check", "Check programs, local or on the control", chosen,
                                checked, run_nc_check);
  check->add_option("files", checked->files, "Local files, or paths on the control")->required();
  check->add_flag("--from-control", checked->from_control, "Use files of the service");
  check->add_option("--format", checked->format, "Format of the findings: text, json, sarif")
      ->check(CLI::IsMember({"text", "json", "sarif"}));
  add_levels(*check, checked->levels);
  check
      ->add_option("--setup", checked->run.setup_file,
                   "JSON file with a setup; the check also runs the programs on it")
      ->type_name("FILE");
  check
      ->add_option("--set", checked->run.parameters,
                   "Parameter that is set before block 0 of this run: Q1=25")
      ->expected(1)
      ->take_all();

  const auto formatted = std::make_shared<FormatOptions>();
  CLI::App* format = add_command(nc, "format", "Format programs as a control does", chosen,
                                 formatted, run_nc_format);
  format->add_option("files", formatted->files, "Local files, or paths on the control")->required();
  format->add_flag("--in-place", formatted->in_place, "Write to the files (default: print)");
  format->add_flag("--from-control", formatted->from_control, "Use files of the service");

  const auto converted = std::make_shared<ConvertOptions>();
  CLI::App* convert = add_command(nc, "convert", "DIN/ISO to Klartext or back: nc convert a.i a.h",
                                  chosen, converted, run_nc_convert);
  convert->add_option("file", converted->file, "Local file, or path on the control")->required();
  convert->add_option("target", converted->target, "Local file for the converted program")
      ->required();
  convert->add_flag("--from-control", converted->from_control, "Use a program of the service");
  convert->add_flag("--force", converted->force, "Replace an existing file");

  const auto options = std::make_shared<RunOptions>();
  CLI::App* run =
      add_command(nc, "run", "Run a program on a simulated machine", chosen, options, run_nc_run);
  run->add_option("programs", options->programs, "Local files, or paths on the control")
      ->required();
  run->add_flag("--from-control", options->from_control, "Use programs of the service");
  run->add_option("--files-to", options->files_to,
                  "Local folder for the files that the run writes");
  run->add_flag("--force", options->force, "Replace existing files in this folder");
  const auto setup = run->add_option("--setup", options->setup,
                                     "JSON file; with --from-control the name of a stored setup")
                         ->type_name("FILE");
  run->add_option("--setup-file", options->setup_file, "JSON file with a setup")->excludes(setup);
  run->add_option("--set", options->parameters,
                  "Parameter that is set before block 0: Q1=25, QS1=H7")
      ->expected(1)
      ->take_all();
  run->add_option("--on-stop", options->on_stop, "At a STOP: continue or end (default: continue)");
  run->add_option("--language", options->language,
                  "Language of FN 16 masks: english, german, dutch, italian or polish");
  run->add_option("--part-id", options->part_id, "Part id that is stored with the measurements");
  run->add_option("--order", options->order, "Work order that is stored with the measurements");
  run->add_flag("--block-skip", options->block_skip, "Skip blocks that begin with /");
}

void add_runs(CLI::App& app, Action& chosen) {
  CLI::App* runs = app.add_subcommand("runs", "Runs of NC programs");
  runs->require_subcommand(1);
  const auto query = std::make_shared<RunsQuery>();
  CLI::App* list =
      add_command(*runs, "ls", "List the runs, the newest first", chosen, query, run_runs_ls);
  list->add_option(
      "--status", query->status,
      "Status: queued, running, completed, stopped, failed, cancelled or limit_exceeded");
  list->add_option("--program", query->program, "Only runs of this program");
  list->add_option("--limit", query->limit, "Maximum number of runs (default: 100)")
      ->check(CLI::Range(1, 1000));
  list->add_option("--after", query->after, "Cursor that the previous page printed");
  const Word id{"id", "Id of the run"};
  add_words(
      *runs, "show", "Print screen, messages and files of a run", chosen, {id}, 1,
      [](const Context& context, const Words& words) { return run_runs_show(context, words[0]); });
  add_words(*runs, "get", "Print a file that a run wrote", chosen,
            {id, {"name", "Name of the file"}, {"file", "Local file (default: standard output)"}},
            2, [](const Context& context, const Words& words) {
              return run_runs_get(context, words[0], words[1], words[2]);
            });
  add_words(*runs, "cancel", "Cancel a queued or running run", chosen, {id}, 1,
            [](const Context& context, const Words& words) {
              return run_runs_cancel(context, words[0]);
            });
}

void add_control(CLI::App& app, Action& chosen) {
  CLI::App* control = app.add_subcommand("control", "A HEIDENHAIN control over LSV-2");
  control->require_subcommand(1);
  const Word address{"address", "The control: HOST or HOST:PORT"};
  add_words(*control, "ls", "List a folder of a control", chosen,
            {address, {"directory", "Folder on the control (default: TNC:)"}}, 1,
            [](const Context& context, const Words& words) {
              return run_control_ls(context, words[0], words[1]);
            });
  const auto got = std::make_shared<ControlGetOptions>();
  CLI::App* get = add_command(*control, "get", "Fetch a file: control get tnc TNC:/log.txt", chosen,
                              got, run_control_get);
  get->add_option("address", got->address, address.help)->required();
  get->add_option("path", got->path, "Path on the control")->required();
  get->add_option("file", got->file, "Local file (default: the same name); - is standard output");
  get->add_flag("--force", got->force, "Replace an existing file");
  const auto put = std::make_shared<ControlPutOptions>();
  CLI::App* send = add_command(*control, "put", "Send files: control put tnc part.h TNC:/nc_prog/",
                               chosen, put, run_control_put);
  send->add_option("paths", put->words,
                   "Address of the control, local files, then the path or folder/ on the control")
      ->required()
      ->expected(3, CLI::detail::expected_max_vector_size);
  send->add_flag("--force", put->force, "Replace an existing file on the control");
  add_words(*control, "run", "Run a program of a virtual control", chosen,
            {address, {"program", "Path of the program on the control"}}, 2,
            [](const Context& context, const Words& words) {
              return run_control_run(context, words[0], words[1]);
            });
  add_words(*control, "state", "Print mode, program, axes and errors of a control", chosen,
            {address}, 1, [](const Context& context, const Words& words) {
              return run_control_state(context, words[0]);
            });
}

void add_replay(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App* replay = add_command(
      app, "replay", "Run a program with the contacts of a real run and compare the probing logs",
      chosen, options, run_replay);
  replay->add_option("program", options->run.program, "Path on the control")->required();
  replay->add_option("file", options->log, "Probing log of the machine")->required();
  replay
      ->add_option("--contacts", options->contacts,
                   "JSON file with a contact for each probing move: [[X, Y, Z], null, …]")
      ->required();
  const auto setup = replay->add_option("--setup", options->run.setup, "Name of a stored setup")
                         ->type_name("NAME");
  replay->add_option("--setup-file", options->run.setup_file, "JSON file with a setup")
      ->excludes(setup);
}

}  // namespace

void add_programs(CLI::App& app, Action& chosen) {
  CLI::App* nc = app.add_subcommand("nc", "NC programs and the control's files");
  nc->require_subcommand(1);
  add_nc_programs(*nc, chosen);
  add_nc_files(*nc, chosen);
  add_runs(app, chosen);
  add_control(app, chosen);
  add_replay(app, chosen);
}

}  // namespace fitgauge::cli
