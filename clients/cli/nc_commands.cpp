#include "cli/nc_commands.hpp"

#include "base/text.hpp"
#include "cli/address.hpp"
#include "cli/gauge_command.hpp"
#include "cli/http_client.hpp"
#include "cli/local_files.hpp"
#include "cli/problem.hpp"

namespace fitgauge::cli {
namespace {

Outcome<Answer> send(const Context& context, const Request& request) {
  return expect_ok(context.client.send(request), context.client.url());
}

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
  if (ascii_iequals(name.substr(0, 2), "QS")) return json_quoted(value);
  const auto number = parse_document(value);
  if (number && number->kind == JsonValue::Kind::Number) return std::string(value);
  return Failure{ExitCode::Usage,
                 fmt::format("{} must be a number such as 25.5; got '{}'", name, value)};
}

Outcome<std::string> setup_json(const RunOptions& options) {
  if (options.setup_file.empty()) return json_quoted(options.setup);
  auto text = read_file(options.setup_file);
  if (!text || parse_document(*text)) return text;
  return Failure{ExitCode::LocalFile, options.setup_file + ": is not JSON"};
}

Failure refused_run(const Context& context, const Answer& answer) {
  const auto document = parse_document(answer.body);
  if (document && !context.json) print_diagnostics(*document, stderr);
  Failure failure = failure_of(answer, context.client.url());
  if (document && document->find("diagnostics") != nullptr) {
    failure.exit_code = ExitCode::ProgramFailed;
  }
  return failure;
}

}  // namespace

void print_messages(const JsonValue& run) {
  for (const JsonValue& message : run.member("messages").items) {
    fmt::print(stderr, "{}:{}: {} {}: {}\n", message.text_of("program"), message.text_of("line"),
               message.text_of("kind"), message.text_of("number"), message.text_of("text"));
  }
}

Outcome<ExitCode> run_nc_ls(const Context& context, const std::string& prefix) {
  const auto answer =
      send(context,
           {.target = "/v1/files" + (prefix.empty() ? "" : "?prefix=" + percent_encoded(prefix))});
  return show(context, answer, [&](const JsonValue& document) {
    for (const JsonValue& file : document.member("files").items) {
      context.print("{:>9}  {}  {}\n", file.text_of("size"), file.text_of("modified_at"),
                    file.text_of("path"));
    }
  });
}

Outcome<ExitCode> run_nc_put(const Context& context, const std::vector<std::string>& files,
                             const std::string& destination) {
  if (files.size() > 1 && !names_folder(destination)) {
    return Failure{ExitCode::Usage,
                   fmt::format("several files need a folder: write {}/", destination)};
  }
  for (const std::string& file : files) {
    const auto bytes = TRY(read_file(file));
    const std::string path =
        names_folder(destination) ? destination + std::string(base_name(file)) : destination;
    const auto answer = expect_ok(context.persist({.method = "PUT",
                                                   .target = file_target(path),
                                                   .content_type = "application/octet-stream",
                                                   .body = bytes}),
                                  context.client.url());
    if (!answer) return answer.error();
    if (!context.json) context.print("{}  {} bytes\n", control_path(path), bytes.size());
  }
  return ExitCode::Good;
}

Outcome<ExitCode> run_nc_get(const Context& context, const GetOptions& options) {
  const std::string file =
      options.file.empty() ? std::string(base_name(options.path)) : options.file;
  const auto answer = TRY(send(context, {.target = file_target(options.path)}));
  TRY(may_replace(file, options.force));
  const auto written = write_file(file, answer.body);
  return written ? Outcome<ExitCode>(ExitCode::Good) : written.error();
}

Outcome<std::string> run_order(const RunOptions& options) {
  JsonObject parameters;
  for (const std::string& parameter : options.parameters) {
    const std::size_t equals = parameter.find('=');
    if (equals == std::string::npos) {
      return Failure{ExitCode::Usage,
                     fmt::format("--set must be a parameter such as Q1=25; got '{}'", parameter)};
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

namespace {

/// The document of a run at the service.
Outcome<std::string> run_there(const Context& context, const RunOptions& options) {
  if (!options.files_to.empty())
    return Failure{ExitCode::Usage, "--files-to is for local runs: use fitgauge runs get ID NAME"};
  const auto order = TRY(run_order(options));
  auto answer = TRY(context.post_once("/v1/runs", order));
  if (!answer.ok()) return refused_run(context, answer);
  return std::move(answer.body);
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
    return Failure{ExitCode::ProgramFailed,
                   fmt::format("run {} ended with status {}{}",
                               options.from_control ? run->text_of("id") : options.program, status,
                               missing_part(*run, options))};
  }
  const std::string_view verdict = run->text_of("verdict");
  return verdict.empty() ? ExitCode::Good : verdict_exit_code(verdict);
}

}  // namespace

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

}  // namespace fitgauge::cli
