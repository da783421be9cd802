#include "plant/lsv2/collected_log.hpp"

#include <future>

#include "base/thread.hpp"
#include "nc/program/control_disk.hpp"
#include "service/files/file_service.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kMostUnderWay = 16;

/// Not for a client: it shows that the log was not stored before.
class NewLog final : public app::Rendering {
 public:
  explicit NewLog(std::shared_ptr<bool> is_new) : is_new_(std::move(is_new)) {}
  void add(std::span<const app::Measurement>, std::string_view) override {}
  app::Answer finish() override {
    *is_new_ = true;
    return {.status = 201, .content_type = "text/plain", .location = {}, .body = {}};
  }

 private:
  std::shared_ptr<bool> is_new_;
};

/// A log on its way to the disk.
struct UnderWay {
  std::shared_ptr<CollectedLog> log;
  std::shared_ptr<bool> is_new;  ///< set by the writer before the answer
  std::future<Result<app::Answer>> stored;
};

UnderWay store(app::MeasurementService& measurements, const MachineOptions& machine,
               std::shared_ptr<CollectedLog> log) {
  const app::IdempotencyScope scope{.caller = machine.name,
                                    .method = "COLLECT",
                                    .path = "lsv2",
                                    .key = log->key,
                                    .body = log->text,
                                    .is_kept_for_ever = true};
  auto is_new = std::make_shared<bool>(false);
  auto promise = std::make_shared<std::promise<Result<app::Answer>>>();
  auto future = promise->get_future();
  measurements.record(
      log->measurements, scope, [is_new] { return std::make_unique<NewLog>(is_new); },
      [promise, log](Result<app::Answer> answer) { promise->set_value(std::move(answer)); });
  return {std::move(log), std::move(is_new), std::move(future)};
}

/// Stores the file unless it is stored unchanged.
Result<void> keep(app::FileService& files, const MachineOptions& machine, const std::string& path,
                  const std::string& bytes) {
  constexpr std::size_t kDrive = 5;  // TNC:\.
  auto kept = TRY(interpreter::ControlPath::parse(
      fmt::format("TNC:\\collected\\{}\\{}", machine.name, path.substr(kDrive))));
  const auto there = wait_for_result<app::DiskFile>([&](auto done) { files.read(kept, done); });
  if (there && there->bytes == bytes) return {};
  if (!there && there.error().code != ErrorCode::FileUnknown) return there.error();
  const auto written = wait_for_result<bool>(
      [&](auto done) { files.write(std::move(kept), bytes, machine.name, {}, done); });
  if (!written) return written.error();
  return {};
}

}  // namespace

Result<Taken> take_logs(const Plant& plant, const MachineOptions& machine, const std::string& path,
                        const std::string& bytes) {
  const Collected found = collect(
      {.machine = machine, .path = path, .tables = plant.tables, .now = plant.clock.now()}, bytes);
  Taken taken{.logs = found.logs.size(), .unread = found.unread};
  std::deque<UnderWay> under_way;
  std::optional<Error> failed;
  const auto finish_one = [&] {
    UnderWay next = std::move(under_way.front());
    under_way.pop_front();
    const auto stored = next.stored.get();
    if (!stored) {
      failed = stored.error();
    } else if (*next.is_new) {
      taken.measurements += next.log->measurements.size();
      taken.values_kept += next.log->values_kept;
    }
  };
  for (const auto& log : found.logs) {
    if (log->measurements.empty()) continue;
    if (under_way.size() == kMostUnderWay) finish_one();
    if (failed) break;
    under_way.push_back(store(plant.measurements, machine, log));
  }
  while (!under_way.empty()) finish_one();
  if (failed) return *failed;
  TRY(keep(plant.files, machine, path, bytes));
  return taken;
}

}  // namespace fitgauge::connections
