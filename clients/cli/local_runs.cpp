#include <filesystem>

#include "api/runs/run_codec.hpp"
#include "cli/local_files.hpp"
#include "cli/nc_commands.hpp"
#include "nc/program/diagnose.hpp"

namespace fitgauge::cli {
namespace {

Failure refused(const Error& error) {
  std::string text(title(error.code));
  if (error.details.empty()) text += ": " + error.message;
  for (const Error& each : error.details) text += fmt::format("; {}: {}", each.where, each.message);
  return {ExitCode::Refused, std::move(text)};
}

Outcome<app::RunOrder> order_of(const std::string& text, const FolderDisk& disk) {
  Allowance unlimited;
  const auto body = parse_json(text);
  if (!body) return refused(body.error());
  const auto tables = app::read_control_tables(disk, unlimited);
  if (!tables) return refused(tables.error());
  auto order = api::decode_run_order(
      *body,
      [](const std::string& name) -> Result<app::NamedDocument> {
        return Error{ErrorCode::SetupUnknown, "setup not found: " + name};
      },
      *tables);
  if (!order) return refused(order.error());
  const auto loaded = app::MeshFiles(disk).load(order->setup, "/setup", app::MissingFiles::Refused);
  if (!loaded) return refused(loaded.error());
  return *std::move(order);
}

/// The findings of the check of a local program and, if it has no error, of its run.
struct LocalRun {
  std::vector<klartext::Diagnostic> found{};
  app::RunReport report{};
  std::string document{};  ///< empty: it has not run
  interpreter::MachineBuilder builder{};
};

/// @param is_run else the program is only checked
/// @param follows every block, so that an error of FN 14 says which jump led to it
Outcome<LocalRun> check_and_run(RunOptions options, bool is_run, bool follows) {
  const std::string file = std::exchange(options.program, std::string(base_name(options.program)));
  if (options.setup_file.empty()) options.setup_file = std::exchange(options.setup, {});
  const auto text = TRY(run_order(options));
  const auto name = TRY(local_program(file));
  const FolderDisk disk(file);
  LocalRun local;
  Allowance unlimited;
  std::optional<app::RunOrder> order;
  if (is_run) {
    order = TRY(order_of(text, disk));
    if (follows) order->watch = {{klartext::QSpace::Q, 0}};
    local.builder = order->options.builder;
  }
  interpreter::ProgramCache programs;
  auto found = interpreter::check(name, disk, programs, unlimited);
  if (!found) return Failure{ExitCode::LocalFile, file + ": " + found.error().message};
  local.found = *std::move(found);
  for (klartext::Diagnostic& each : local.found) each.program = disk.name_here(each.program);
  if (!is_run || klartext::has_errors(local.found)) return local;
  const SystemClock clock;
  const app::RunFormat format = api::run_format();
  local.report = {.program = file, .seed = order->setup.seed, .created_at = clock.now()};
  app::ActiveRun run(local.report.id, {}, std::make_shared<const app::RunOrder>(*std::move(order)),
                     local.report.created_at);
  local.report.result = app::execute({disk, programs, clock, format.trace}, run).result;
  local.report.finished_at = clock.now();
  for (klartext::Diagnostic& each : interpreter::findings_of(local.report.result)) {
    const auto path = interpreter::ControlPath::parse(each.program);
    const auto linked = path ? programs.get(disk, *path) : nullptr;
    if (linked != nullptr && linked->program != nullptr) {
      if (interpreter::is_ignored(linked->program->program(), each)) continue;
      each.source = linked->program->program().line(each.range.begin.line);
    }
    each.program = disk.name_here(each.program);
    std::erase_if(local.found, [&](const klartext::Diagnostic& checked) {
      return checked.message == each.message && checked.program == each.program &&
             checked.range.begin.line == each.range.begin.line;
    });
    for (auto& note : each.notes)
      if (!note.program.empty()) note.program = disk.name_here(note.program);
    local.found.push_back(std::move(each));
  }
  for (auto& message : local.report.result.messages)
    message.program = disk.name_here(message.program);
  local.document = format.report(local.report);
  return local;
}

}  // namespace

Outcome<std::vector<klartext::Diagnostic>> found_here(const RunOptions& options) {
  auto local = TRY(check_and_run(options, !options.setup_file.empty(), true));
  const auto drop = [&](const std::string& hint) {
    std::erase_if(local.found, [&](const auto& each) { return each.message == hint; });
  };
  for (const auto& each : local.builder.m_functions) drop(interpreter::m_function_hint(each.first));
  for (const auto& each : local.builder.cycles)
    for (const bool is_probing : {false, true})
      drop(interpreter::cycle_hint(is_probing, each.first));
  return std::move(local.found);
}

Outcome<std::string> run_here(const Context& context, RunOptions options) {
  if (!options.part_id.empty() || !options.order.empty()) {
    return Failure{
        ExitCode::Usage,
        "--part-id and --order need --from-control: the service stores them with its records"};
  }
  auto local = TRY(check_and_run(options, true, false));
  if (local.document.empty()) {
    for (const klartext::Diagnostic& each : local.found)
      if (!context.json) fmt::print(stderr, "{}\n", klartext::render(each));
    return Failure{ExitCode::ProgramFailed,
                   options.program + " or a program that it calls has errors"};
  }
  for (const interpreter::WrittenFile& each : local.report.result.files) {
    if (options.files_to.empty()) break;
    std::error_code failed;
    const std::string target = options.files_to + "/" + relative_of(each.path.text());
    std::filesystem::create_directories(std::filesystem::path(target).parent_path(), failed);
    TRY(may_replace(target, options.force));
    TRY(write_file(target, each.bytes));
  }
  return std::move(local.document);
}

}  // namespace fitgauge::cli
