#include "cli/nc_commands.hpp"

#include "cli/answers.hpp"
#include "cli/local_files.hpp"

namespace fitgauge::cli {
namespace {

/// Prints each finding with its block.
void print_diagnostics(const JsonValue& document, std::FILE* stream) {
  for (const JsonValue& found : document.member("diagnostics").items) {
    fmt::print(stream, "{}:{}:{}: {}: {}\n    {}\n", found.text_of("program"),
               found.text_of("line"), found.text_of("column"), found.text_of("severity"),
               found.text_of("message"), found.text_of("source"));
  }
}

bool names_folder(std::string_view path) { return path.ends_with('/') || path.ends_with('\\'); }

/// A parameter's value as JSON: a QS holds a text, every other one a number.
Outcome<std::string> parameter_json(std::string_view name, std::string_view value) {
  if (ascii_iequals(name.substr(0, 2), "QS")) return json_string(value);
  const auto number = parse_document(value);
  if (number && number->kind == JsonValue::Kind::Number) return std::string(value);
  return Failure::of(ExitCode::Usage, "{} must be a number such as 25.5; got '{}'", name, value);
}

Outcome<std::string> setup_json(const RunOptions& options) {
  if (options.setup_file.empty()) return json_string(options.setup);
  auto text = read_file(options.setup_file);
  if (!text || parse_document(*text)) return text;
  return Failure{ExitCode::LocalFile, options.setup_file + ": is not JSON"};
}

/// Prints the findings of a program that the service does not run.
Failure refused_run(const Context& context, Failure failure) {
  const auto document = parse_document(failure.document);
  if (document && !context.json) print_diagnostics(*document, stderr);
  const bool has_findings = document && document->find("diagnostics") != nullptr;
  if (has_findings) failure.exit_code = ExitCode::ProgramFailed;
  return failure;
}

/// The document of a run at the service.
Outcome<std::string> run_there(const Context& context, const RunOptions& options) {
  if (!options.files_to.empty())
    return Failure{ExitCode::Usage, "--files-to is for local runs: use fitgauge runs get ID NAME"};
  const auto order = TRY(run_order(options));
  auto answer = context.post_once("/v1/runs", order);
  if (!answer) return refused_run(context, std::move(answer).error());
  return std::move(answer->body);
}

/// The usual cause of a probing move without contact (error 1014), if the run has no setup.
std::string_view missing_part(const JsonValue& run, const RunOptions& options) {
  const bool has_setup = !options.setup.empty() || !options.setup_file.empty();
  const auto is_missed = [](const JsonValue& each) { return each.text_of("number") == "1014"; };
  return !has_setup && std::ranges::any_of(run.member("messages").items, is_missed)
             ? ": the machine has no workpiece, give a setup with --setup"
             : "";
}

Outcome<ExitCode> run_one(const Context& context, const RunOptions& options) {
  const auto body =
      TRY(options.from_control ? run_there(context, options) : run_here(context, options));
  const auto run = parse_document(body);
  if (!run)
    return Failure{ExitCode::NoAnswer,
                   context.client.url() + " did not return a run: check that fitgauged runs there"};
  if (context.json) {
    context.print_document(body);
  } else {
    for (const JsonValue& line : run->member("screen").items) context.print("{}\n", line.text);
    print_messages(*run);
  }
  const std::string_view status = run->text_of("status");
  if (status != "completed") {
    return Failure::of(ExitCode::ProgramFailed, "run {} ended with status {}{}",
                       options.from_control ? run->text_of("id") : options.program, status,
                       missing_part(*run, options));
  }
  const std::string_view verdict = run->text_of("verdict");
  return verdict.empty() ? ExitCode::Good : verdict_exit_code(verdict);
}

/// `nc run PROGRAM…`: prints the screen; the exit code is the verdict of the last measuring cycle,
/// Good without one, ProgramFailed when the program did not complete.
Outcome<ExitCode> run_nc_run(const Context& context, const RunOptions& options) {
  ExitCode worst = ExitCode::Good;
  for (const std::string& program : options.programs) {
    RunOptions one = options;
    one.program = program;
    if (!options.files_to.empty() && options.programs.size() > 1)
      one.files_to += fmt::format("/{}", base_name(program));
    const auto code = TRY(run_one(context, one));
    worst = std::max(worst, code);
  }
  return worst;
}

/// `nc ls [PREFIX]`
Outcome<ExitCode> run_nc_ls(const Context& context, const std::string& prefix) {
  const std::string query = prefix.empty() ? "" : "?prefix=" + percent_encoded(prefix);
  return show(context, context.send({.target = "/v1/files" + query}),
              [&](const JsonValue& document) {
                for (const JsonValue& file : document.member("files").items) {
                  context.print("{:>9}  {}  {}\n", file.text_of("size"),
                                file.text_of("modified_at"), file.text_of("path"));
                }
              });
}

/// `nc put FILE… DESTINATION`: several files need a folder, which ends with a stroke.
Outcome<ExitCode> run_nc_put(const Context& context, const Words& paths) {
  const std::string& destination = paths.back();
  const std::vector<std::string> files(paths.begin(), paths.end() - 1);
  if (files.size() > 1 && !names_folder(destination))
    return Failure::of(ExitCode::Usage, "several files need a folder: write {}/", destination);
  for (const std::string& file : files) {
    const auto bytes = TRY(read_file(file));
    const std::string path =
        names_folder(destination) ? destination + std::string(base_name(file)) : destination;
    TRY(context.persist({.method = "PUT",
                         .target = file_target(path),
                         .content_type = "application/octet-stream",
                         .body = bytes}));
    if (!context.json) context.print("{}  {} bytes\n", control_path(path), bytes.size());
  }
  return ExitCode::Good;
}

struct GetOptions {
  std::string path;
  std::string file{};  ///< its name here when empty; `-` is standard output
  bool force = false;  ///< replace a file that is there
};

/// `nc get PATH [FILE]`: asks before it replaces a file. @errors LocalFile without consent.
Outcome<ExitCode> run_nc_get(const Context& context, const GetOptions& options) {
  const std::string file =
      options.file.empty() ? std::string(base_name(options.path)) : options.file;
  const auto answer = TRY(context.send({.target = file_target(options.path)}));
  TRY(may_replace(file, options.force));
  const auto written = write_file(file, answer.body);
  return written ? Outcome<ExitCode>(ExitCode::Good) : written.error();
}

}  // namespace

void print_messages(const JsonValue& run) {
  for (const JsonValue& message : run.member("messages").items) {
    fmt::print(stderr, "{}:{}: {} {}: {}\n", message.text_of("program"), message.text_of("line"),
               message.text_of("kind"), message.text_of("number"), message.text_of("text"));
  }
}

Outcome<std::string> run_order(const RunOptions& options) {
  JsonObject parameters;
  for (const std::string& parameter : options.parameters) {
    const std::size_t equals = parameter.find('=');
    if (equals == std::string::npos) {
      return Failure::of(ExitCode::Usage, "--set must be a parameter such as Q1=25; got '{}'",
                         parameter);
    }
    const std::string name = parameter.substr(0, equals);
    const auto value = TRY(parameter_json(name, std::string_view(parameter).substr(equals + 1)));
    parameters.add_raw(name, value);
  }
  JsonObject order;
  order.add("program", control_path(options.program));
  if (!options.setup.empty() || !options.setup_file.empty()) {
    const auto setup = TRY(setup_json(options));
    order.add_raw("setup", setup);
  }
  if (!options.parameters.empty()) order.add_raw("parameters", parameters.text());
  order.add_given("on_stop", options.on_stop)
      .add_given("language", options.language)
      .add_given("part_id", options.part_id)
      .add_given("order", options.order);
  if (options.block_skip) order.add_raw("block_skip", "true");
  return order.text();
}

void add_nc(CLI::App& nc, Action& chosen) {
  const auto [run, options] =
      add_command(nc, "run", "Run a program on a simulated machine", chosen, run_nc_run);
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
  add_repeated(*run, "--set", options->parameters,
               "Parameter that is set before block 0: Q1=25, QS1=H7");
  run->add_option("--on-stop", options->on_stop, "At a STOP: continue or end (default: continue)");
  run->add_option("--language", options->language,
                  "Language of FN 16 masks: english, german, dutch, italian or polish");
  run->add_option("--part-id", options->part_id, "Part id that is stored with the measurements");
  run->add_option("--order", options->order, "Work order that is stored with the measurements");
  run->add_flag("--block-skip", options->block_skip, "Skip blocks that begin with /");

  const auto [list, prefix] = add_command(nc, "ls", "List the control's files", chosen, run_nc_ls);
  list->add_option("prefix", *prefix, "Only paths that begin with this text");

  const auto [put, paths] =
      add_command(nc, "put", "Store files: nc put 8255.h nc_prog/8255/", chosen, run_nc_put);
  put->add_option("paths", *paths, "Files, then the path or folder/ on the control")
      ->required()
      ->expected(2, CLI::detail::expected_max_vector_size);

  const auto [get, got] =
      add_command(nc, "get", "Fetch a file: nc get nc_prog/8255/8255.h", chosen, run_nc_get);
  get->add_option("path", got->path, "Path on the control")->required();
  get->add_option("file", got->file, "Local file (default: the same name); - is standard output");
  get->add_flag("--force", got->force, "Replace an existing file");
}

}  // namespace fitgauge::cli
