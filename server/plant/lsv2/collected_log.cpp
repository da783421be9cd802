#include "plant/lsv2/collected_log.hpp"

#include <ctime>

#include "nc/probing/cycle_host.hpp"
#include "nc/program/control_disk.hpp"
#include "plant/settings.hpp"
#include "service/files/file_service.hpp"

namespace fitgauge::connections {
namespace {

using app::Measurement;
using log_reader::LogValue;
using log_reader::MeasuringLog;
using log_reader::PatternResult;
using log_reader::Role;

/// One log, or one result of an FN 16 file. Owns its measurements' texts, so it must not move.
struct CollectedLog {
  CollectedLog& operator=(CollectedLog&&) = delete;  // neither copied nor moved

  std::string text{};
  bool has_time = false;                         ///< the control's, in its text
  std::string key{};                             ///< unique to this log of this machine and path
  std::vector<app::Measurement> measurements{};  ///< empty: it has no length
  std::size_t values_kept = 0;  ///< angles and figures of axes, they stay in the file
  bool is_new = false;          ///< set by the writer before its answer

  app::TableCatalog::Tables tables{};
  std::deque<std::string> texts{};
};

/// The results that were found in a file.
struct Collected {
  std::vector<std::shared_ptr<CollectedLog>> logs{};
  std::vector<std::string> unread{};  ///< `line 5: …`
};

/// The source of a file, and the tables that judge its results.
struct Origin {
  const MachineOptions& machine;
  const std::string& path;  ///< on the control
  const app::TableCatalog& tables;
  Timestamp now;  ///< of results without a time
};

/// Bytes of the longest text that a measurement allows.
constexpr std::size_t kLongestText = 200;
constexpr std::size_t kLongestComment = 2000;

/// Returns the instant. A control's clock shows the time of the zone of this service.
Timestamp instant(const sheet::WallTime& shown) {
  std::tm time{};
  ::gmtime_r(&shown.seconds, &time);
  time.tm_isdst = -1;
  return Timestamp{std::int64_t{std::mktime(&time)} * kNanosecondsPerSecond};
}

/// Stores a text in the log, cut to the limit of a field.
std::string_view kept(CollectedLog& log, std::string_view text, std::size_t most = kLongestText) {
  return log.texts.emplace_back(first_characters(text, most));
}

/// Returns a measurement with the fields that all measurements of a file have.
Measurement begun(CollectedLog& log, const Origin& origin) {
  Measurement measurement;
  measurement.received_at = origin.now;
  measurement.measured_at = origin.now;
  measurement.machine = kept(log, origin.machine.machine_name());
  measurement.comment = kept(log, origin.path, kLongestComment);
  measurement.caller = kept(log, origin.machine.name);
  return measurement;
}

Measurement measurement_of(CollectedLog& log, const MeasuringLog& read, const LogValue& value,
                           const Origin& origin) {
  Measurement measurement = begun(log, origin);
  if (read.time) measurement.measured_at = instant(*read.time);
  measurement.cycle = read.cycle;
  measurement.characteristic = kept(log, value.name);
  if (!read.program.empty()) measurement.operation = kept(log, read.program);
  app::CycleSize size{
      .quantity = probing::quantity_of(read.cycle, value.role == Role::Position),
      .feature = value.role == Role::Shaft ? iso286::Feature::Shaft : iso286::Feature::Hole,
      .nominal = value.nominal,
      .measured = value.measured};
  if (gauging::has_feature(size.quantity)) measurement.size_operator = "GG";
  if (value.upper) size.limits = {.upper = *value.upper, .lower = *value.lower};
  judge_size(measurement, size);
  return measurement;
}

std::shared_ptr<CollectedLog> collected(const MeasuringLog& read, const Origin& origin) {
  auto log = std::make_shared<CollectedLog>();
  log->text = read.text;
  log->has_time = read.time.has_value();
  const bool judges = std::ranges::any_of(
      read.values, [](const LogValue& value) { return value.upper.has_value(); });
  for (const LogValue& value : read.values) {
    const auto quantity = probing::quantity_of(read.cycle, value.role == Role::Position);
    if (judges && !value.upper && !gauging::has_feature(quantity)) continue;
    // An angle or a figure of an axis has no place in a measurement.
    if (value.is_length && value.nominal) {
      log->measurements.push_back(measurement_of(*log, read, value, origin));
    } else {
      ++log->values_kept;
    }
  }
  return log;
}

/// The fields of one result, each asked for by its name. The pattern has those that limits need.
class Fields {
 public:
  explicit Fields(const PatternResult& result) : result_(result) {}

  bool has(std::string_view name) const { return result_.fields.contains(name); }
  std::string_view text(std::string_view name) const {
    const auto found = result_.fields.find(name);
    return found == result_.fields.end() ? std::string_view() : found->second;
  }
  Result<Length> length(std::string_view name) const {
    return parse_length_mm(text(name), kSyntax);
  }
  Result<Length> micrometres(std::string_view name) const {
    return parse_length_um(text(name), kSyntax);
  }

 private:
  static constexpr DecimalSyntax kSyntax{
      .decimal_comma = true, .exponent = false, .round_to_nearest = true};

  const PatternResult& result_;
};

/// Judges a measurement by the limits that the tables give for its tolerance class.
Result<void> judge_by_class(Measurement& measurement, CollectedLog& log, const Fields& fields,
                            const Origin& origin) {
  log.tables = TRY(origin.tables.tables());
  const auto nominal = TRY(fields.length("nominal_mm"));
  const auto size = TRY(iso286::NominalSize::make(nominal));
  const auto limits =
      TRY(log.tables->limits_of_size(size, std::string(fields.text("tolerance_class"))));
  apply_limits(measurement, limits, *log.tables);
  judge(measurement);
  return {};
}

/// Returns the limits from `upper_um`, `lower_um` and the nominal size, or `upper_mm`, `lower_mm`.
Result<std::optional<gauging::Limits>> drawn_limits(const Fields& fields,
                                                    std::optional<Length> nominal) {
  gauging::Limits limits;
  if (nominal && fields.has("upper_um")) {
    limits.upper = *nominal + TRY(fields.micrometres("upper_um"));
    limits.lower = *nominal + TRY(fields.micrometres("lower_um"));
  } else if (fields.has("upper_mm")) {
    limits.upper = TRY(fields.length("upper_mm"));
    limits.lower = TRY(fields.length("lower_mm"));
  } else {
    return std::optional<gauging::Limits>();
  }
  if (limits.upper < limits.lower)
    return invalid_field("the upper limit must not be below the lower limit");
  if (limits.lower <= Length()) return invalid_field("the lower limit must be above 0");
  return std::optional(limits);
}

Result<void> judge_by_drawing(Measurement& measurement, const Fields& fields) {
  app::CycleSize size;
  size.measured = measurement.measured;
  if (fields.has("nominal_mm")) size.nominal = TRY(fields.length("nominal_mm"));
  size.limits = TRY(drawn_limits(fields, size.nominal));
  const std::string_view feature = fields.text("feature");
  if (!feature.empty() && feature != "hole" && feature != "shaft") {
    return invalid_field(fmt::format("feature must be one of: hole, shaft; got '{}'", feature));
  }
  if (feature == "shaft") size.feature = iso286::Feature::Shaft;
  judge_size(measurement, size);
  return {};
}

Result<void> take_time(Measurement& measurement, CollectedLog& log, const Fields& fields) {
  log.has_time = fields.has("date") && fields.has("time");
  if (!log.has_time) return {};
  const auto shown = log_reader::read_clock(fields.text("date"), fields.text("time"));
  if (!shown) {
    return invalid_field(fmt::format("date and time must be DD-MM-YYYY and H:MM:SS; got '{} {}'",
                                     fields.text("date"), fields.text("time")));
  }
  measurement.measured_at = instant(*shown);
  return {};
}

Result<std::shared_ptr<CollectedLog>> collected(const PatternResult& result, const Origin& origin) {
  auto log = std::make_shared<CollectedLog>();
  log->text = result.text;
  const Fields fields(result);
  Measurement measurement = begun(*log, origin);
  const auto measured = TRY(fields.length("measured_mm"));
  if (measured <= Length()) return invalid_field("a measured size must be above 0");
  measurement.measured = measured;
  TRY(take_time(measurement, *log, fields));
  for (const app::MeasurementField& field : app::kLabels) {
    if (!fields.has(field.name) || fields.text(field.name).empty()) continue;
    measurement.*field.text = kept(*log, fields.text(field.name), field.accepted.longest);
  }
  TRY(fields.has("tolerance_class") ? judge_by_class(measurement, *log, fields, origin)
                                    : judge_by_drawing(measurement, fields));
  log->measurements.push_back(measurement);
  return log;
}

std::string told(const log_reader::Unread& unread) {
  return unread.line == 0 ? unread.why : fmt::format("line {}: {}", unread.line, unread.why);
}

void collect_by(const log_reader::PatternReading& reading, const Origin& origin, Collected& into) {
  for (const auto& unread : reading.unread) into.unread.push_back(told(unread));
  for (const PatternResult& result : reading.results) {
    auto log = collected(result, origin);
    if (log) {
      into.logs.push_back(*std::move(log));
    } else {
      into.unread.push_back(
          fmt::format("result {}: {}", into.logs.size() + 1, log.error().message));
    }
  }
}

/// Numbers equal logs: logs with a time by their order, logs without one by everything before them.
/// A file that is written anew has new results; a file that grows does not.
void number(std::vector<std::shared_ptr<CollectedLog>>& logs, const Origin& origin) {
  std::map<Digest, std::size_t> seen;
  std::string before;
  for (const auto& log : logs) {
    const std::size_t ordinal = seen[sha256(log->text)]++;
    before = to_hex(sha256(before + log->text));
    const std::string place = log->has_time ? std::to_string(ordinal) : before;
    log->key = to_hex(sha256(fmt::format(
        "{}:{}{}:{}{}:{}{}", origin.machine.machine_name().size(), origin.machine.machine_name(),
        origin.path.size(), ascii_lower(origin.path), place.size(), place, log->text)));
  }
}

/// Reads the logs of touch-probe cycles, or else by the first pattern that finds a result. Of
/// a log that judges something every size is stored, and every other length it judges; of one that
/// judges nothing every length, unjudged. Angles and figures of axes stay in the file.
Collected collect(const Origin& origin, const std::string& bytes) {
  Collected found;
  const log_reader::Reading reading = log_reader::read_logs(bytes);
  for (const MeasuringLog& log : reading.logs) found.logs.push_back(collected(log, origin));
  for (const auto& unread : reading.unread) found.unread.push_back(told(unread));
  if (reading.logs.empty() && !reading.is_unfinished) {
    for (const NamedPattern& named : origin.machine.patterns) {
      const auto by_pattern = named.pattern.read(bytes);
      if (by_pattern.results.empty() && !by_pattern.is_unfinished) continue;
      found.unread.clear();
      collect_by(by_pattern, origin, found);
      break;
    }
  }
  number(found.logs, origin);
  return found;
}

constexpr std::size_t kMostUnderWay = 16;

/// Marks a log as new when the writer stores it. No client gets this answer.
class NewLog final : public app::Rendering {
 public:
  explicit NewLog(std::shared_ptr<CollectedLog> log) : log_(std::move(log)) {}
  void add(std::span<const app::Measurement>, std::string_view) override {}
  app::Answer finish() override {
    log_->is_new = true;
    return {.status = 201, .content_type = "text/plain", .location = {}, .body = {}};
  }

 private:
  const std::shared_ptr<CollectedLog> log_;
};

/// A log on its way to the disk.
struct UnderWay {
  std::shared_ptr<CollectedLog> log;
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
  auto promise = std::make_shared<std::promise<Result<app::Answer>>>();
  auto future = promise->get_future();
  measurements.record(
      log->measurements, scope, [log] { return std::make_unique<NewLog>(log); },
      [promise, log](Result<app::Answer> answer) { promise->set_value(std::move(answer)); });
  return {std::move(log), std::move(future)};
}

/// Stores the file unless it is stored unchanged.
Result<void> keep(app::FileService& files, const MachineOptions& machine, const std::string& path,
                  const std::string& bytes) {
  constexpr std::size_t kDrive = 5;  // TNC:\.
  auto kept = TRY(interpreter::ControlPath::parse(
      fmt::format("TNC:\\collected\\{}\\{}", machine.name, path.substr(kDrive))));
  const auto there =
      wait_for_result<store::FileContent>([&](auto done) { files.read(kept, done); });
  if (there && there->content == bytes) return {};
  if (!there && there.error().code != ErrorCode::FileUnknown) return there.error();
  TRY(wait_for_result<bool>(
      [&](auto done) { files.write(std::move(kept), bytes, machine.name, {}, done); }));
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
    } else if (next.log->is_new) {
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
