#include "db/store/database.hpp"
#include "db/store/stores.hpp"
#include "nc/iso/parser.hpp"
#include "nc/klartext/mask_file.hpp"
#include "nc/klartext/parser.hpp"
#include "nc/program/program_cache.hpp"
#include "service/measurements/measurement_storage.hpp"
#include "service/runs/run_service.hpp"
#include "tables/tabfile/tab_table.hpp"

// Checks of a run before its start.

namespace fitgauge::app {
namespace {

constexpr std::array<std::string_view, 5> kTableExtensions = {".tab", ".t", ".tp", ".pr", ".d"};

/// The place of a table's error, one of its lines: `line 12`.
std::vector<klartext::Diagnostic> check_table(const interpreter::ControlFile& file,
                                              Allowance& allowance) {
  const auto table = tabfile::read_tab_file(*file.bytes, allowance);
  if (table) return {};
  const Error error = table.error();
  klartext::Diagnostic diagnostic{.message = error.message, .program = file.path.text()};
  constexpr std::string_view kLine = "line ";
  const std::string_view where = error.where;
  SourcePosition& begin = diagnostic.range.begin;
  std::from_chars(where.data() + kLine.size(), where.data() + where.size(), begin.line);
  diagnostic.range.end = begin;
  return {std::move(diagnostic)};
}

/// Returns all findings in a file of the control's disk, by its kind: a mask (`.a`), a table
/// (`.tab`, `.t`, `.tp`, `.pr`, `.d`), or else a program with the programs that it calls.
/// @errors ProgramUnknown if there is no such file.
Result<std::vector<klartext::Diagnostic>> check_file(const interpreter::ControlPath& path,
                                                     const interpreter::ControlDisk& disk,
                                                     interpreter::ProgramCache& programs,
                                                     Allowance& allowance) {
  const std::string_view name = path.file_name();
  const std::string extension = ascii_lower(name.substr(std::min(name.rfind('.'), name.size())));
  const bool is_mask = extension == ".a";
  const bool is_table = std::ranges::find(kTableExtensions, extension) != kTableExtensions.end();
  if (!is_mask && !is_table) return interpreter::check(path, disk, programs, allowance);
  const auto file = disk.find(path);
  if (!file) return Error{ErrorCode::ProgramUnknown, "file not found: " + path.text()};
  if (is_mask) return klartext::parse_mask(*file->bytes, file->path.text()).diagnostics;
  return check_table(*file, allowance);
}

/// A program as a control lists it: one blank between words, blocks numbered from 0.
/// @errors ProgramUnknown; ProgramInvalid with the first line that cannot be read.
Result<std::string> format_file(const interpreter::ControlPath& path,
                                const interpreter::ControlDisk& disk) {
  const auto file = disk.find(path);
  if (!file) return Error{ErrorCode::ProgramUnknown, "file not found: " + path.text()};
  const auto parsed = iso::parse_program(*file->bytes, file->path.text());
  if (const klartext::Diagnostic* found = parsed.not_printed()) {
    return Error{ErrorCode::ProgramInvalid, "line " + std::to_string(found->range.begin.line) +
                                                ": " + found->message +
                                                "; action=check lists all errors"};
  }
  return klartext::format_program(parsed.program);
}

/// The budget of one check or one reading of tables.
constexpr std::chrono::seconds kPreparingTime{5};
constexpr std::size_t kPreparingMemory = std::size_t{48} << 20;

}  // namespace

Result<RunService::Diagnostics> RunService::check(const interpreter::ControlPath& path,
                                                  std::optional<std::string> draft) {
  return check_with(check_file, path, std::move(draft));
}

Result<RunService::Diagnostics> RunService::check_program(const interpreter::ControlPath& path) {
  return check_with(interpreter::check, path);
}

Result<RunService::Diagnostics> RunService::check_with(Check find_all,
                                                       const interpreter::ControlPath& path,
                                                       std::optional<std::string> draft) try {
  const interpreter::ProjectingDisk disk(stored_, live_tables_.projections());
  Allowance allowance(kPreparingTime, kPreparingMemory, orders_.stop_token());
  if (!draft) return find_all(path, disk, programs_, allowance);
  // Like a file that a run has written, a draft is not in the cache.
  interpreter::OutputBudget budget(draft->size());
  interpreter::RunFiles files(disk, budget, 1);
  static_cast<void>(files.write(path, *std::move(draft)));
  return find_all(path, files, programs_, allowance);
} catch (const store::StorageFailure& failure) {
  return failure.error();
}

Result<void> RunService::check_start(const RunOrder& order) try {
  const std::optional<std::uint32_t> start = order.options.start_block;
  if (!start) return {};
  const interpreter::ProjectingDisk disk(stored_, live_tables_.projections());
  const auto file = programs_.get(disk, order.program);
  const auto program = file == nullptr ? nullptr : file->runnable(order.options.keeps_unreadable);
  if (program == nullptr || program->instruction_of(*start)) return {};  // null: the run reports it
  const std::string refused =
      fmt::format("{} has no block {}; its last block is {}", order.program.text(), *start,
                  program->program().blocks().back().number);
  return Error{
      ErrorCode::RequestInvalid, refused, {}, {{ErrorCode::FieldInvalid, refused, "/start_block"}}};
} catch (const store::StorageFailure& failure) {
  return failure.error();
}

Result<std::string> RunService::format(const interpreter::ControlPath& path) try {
  return format_file(path, stored_);
} catch (const store::StorageFailure& failure) {
  return failure.error();
}

Result<std::shared_ptr<const ControlTables>> RunService::control_tables() try {
  Allowance allowance(kPreparingTime, kPreparingMemory, orders_.stop_token());
  const std::lock_guard lock(tables_mutex_);
  return control_tables_.read(allowance);
} catch (const store::StorageFailure& failure) {
  return failure.error();
}

Result<void> RunService::load_meshes(machine::Setup& setup, std::string_view pointer,
                                     MissingFiles missing) try {
  const std::lock_guard lock(meshes_mutex_);
  return meshes_.load(setup, pointer, missing);
} catch (const store::StorageFailure& failure) {
  return failure.error();
}

Result<std::optional<Answer>> RunService::kept_answer(const IdempotencyScope& scope) {
  return database_.readers().wait([request = to_store(scope)](const Stores& stores) {
    return stores.idempotency.find(request);
  });
}

}  // namespace fitgauge::app
