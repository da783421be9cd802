// What is done for a run before it is started.

#include <chrono>

#include "db/store/database.hpp"
#include "db/store/storage_failure.hpp"
#include "nc/program/check.hpp"
#include "service/files/draft_disk.hpp"
#include "service/files/file_check.hpp"
#include "service/measurements/mapping.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::app {
namespace {

/// What one check or one reading of tables may take.
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
  return find_all(path, DraftDisk(disk, path, *std::move(draft)), programs_, allowance);
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
  return database_.readers().wait([request = to_store(scope)](const store::Stores& stores) {
    return stores.idempotency.find(request);
  });
}

}  // namespace fitgauge::app
