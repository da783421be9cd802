#include <filesystem>

#include "api/runs/run_codec.hpp"
#include "base/json/json_value.hpp"
#include "cli/address.hpp"
#include "cli/folder_disk.hpp"
#include "cli/local_files.hpp"
#include "cli/nc_commands.hpp"
#include "nc/program/check.hpp"
#include "service/runs/control_files.hpp"
#include "service/runs/run_executor.hpp"

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
        return Error{ErrorCode::SetupUnknown, "there is no setup " + name};
      },
      *tables);
  if (!order) return refused(order.error());
  const auto loaded = app::MeshFiles(disk).load(order->setup, "/setup", app::MissingFiles::Refused);
  if (!loaded) return refused(loaded.error());
  return *std::move(order);
}

}  // namespace

Outcome<std::string> run_here(const Context& context, RunOptions options) {
  if (!options.part_id.empty() || !options.order.empty()) {
    return Failure{
        ExitCode::Usage,
        "--part-id and --order need --from-control: the service stores them with its records"};
  }
  const std::string file = options.program;
  options.program = base_name(file);
  if (options.setup_file.empty()) options.setup_file = std::exchange(options.setup, {});
  const auto text = run_order(options);
  if (!text) return text.error();
  const auto name = local_program(file);
  if (!name) return name.error();
  const FolderDisk disk(file);
  Allowance unlimited;
  auto order = order_of(*text, disk);
  if (!order) return order.error();
  interpreter::ProgramCache programs;
  auto found = interpreter::check(*name, disk, programs, unlimited);
  if (!found) return Failure{ExitCode::LocalFile, file + ": " + found.error().message};
  if (interpreter::has_errors(*found)) {
    for (klartext::Diagnostic& each : *found) {
      each.program = disk.name_here(each.program);
      if (!context.json) fmt::print(stderr, "{}\n", klartext::render(each));
    }
    return Failure{ExitCode::ProgramFailed, file + " or a program that it calls has errors"};
  }
  const SystemClock clock;
  const app::RunFormat format = api::run_format();
  app::RunReport report{.program = file, .seed = order->setup.seed, .created_at = clock.now()};
  app::ActiveRun run(report.id, {}, std::make_shared<const app::RunOrder>(*std::move(order)),
                     report.created_at);
  report.result = app::execute({disk, programs, clock, format.trace}, run).result;
  report.finished_at = clock.now();
  for (auto& message : report.result.messages) message.program = disk.name_here(message.program);
  for (const interpreter::WrittenFile& each : report.result.files) {
    if (options.files_to.empty()) break;
    std::error_code failed;
    const std::string target = options.files_to + "/" + relative_of(each.path.text());
    std::filesystem::create_directories(std::filesystem::path(target).parent_path(), failed);
    if (const auto allowed = may_replace(target, options.force); !allowed) return allowed.error();
    if (const auto written = write_file(target, each.bytes); !written) return written.error();
  }
  return format.report(report);
}

}  // namespace fitgauge::cli
