#include "service/log/log_service.hpp"

#include "db/store/database.hpp"
#include "service/log/log_keys.hpp"
#include "service/log/log_reader.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

using std::chrono::hours;
using std::chrono::seconds;

constexpr seconds kBetweenSignings{1};
constexpr hours kBetweenTellings{24};
constexpr seconds kLastGrowth{1};  // after an upgrade the rest follows at the next start
constexpr std::int64_t kLeavesAtATime = 4096;
constexpr std::uint64_t kLeavesACommit = 1'000'000;

}  // namespace

LogService::LogService(Database& database, const TableCatalog& tables, const Clock& clock,
                       LogOptions options)
    : database_(database), tables_(tables), clock_(clock), options_(std::move(options)) {}

void LogService::tell(std::string_view event, const std::string& detail) const {
  if (options_.tell) options_.tell(event, detail);
}

LogService::~LogService() { stop(); }

Result<std::unique_ptr<LogService>> LogService::open(Database& database, const TableCatalog& tables,
                                                     const Clock& clock, LogOptions options) {
  std::unique_ptr<LogService> log(new LogService(database, tables, clock, std::move(options)));
  TRY(log->load());
  return log;
}

LogReader LogService::reader(const Stores& stores, std::int64_t origin) const {
  return {stores, row_names(tables_, origins_), origin};
}

Result<void> LogService::set_forked(const std::optional<std::string>& why) {
  if (why.has_value() == forked().has_value()) return {};
  forked_.set(std::make_shared<const std::string>(why.value_or("")));
  TRY(database_.writer().wait(
      [&](Stores& stores) { stores.log.set_mark(store::LogStore::Mark::Forked, why); }));
  if (why) tell("log_forked", *why);
  return {};
}

std::optional<Error> LogService::forked() const {
  const auto why = forked_.get();
  if (!why || why->empty()) return std::nullopt;
  return Error{ErrorCode::LogForked, *why, "database"};
}

const LogService::History& LogService::history_of(std::int64_t place) const {
  return *std::ranges::find_if(histories_, [place](const History& history) {
    return !history.end || place <= *history.end;
  });
}

const LogService::History& LogService::history_of(std::string_view digits) const {
  return *std::ranges::find_if(
      histories_, [digits](const History& history) { return history.digits == digits; });
}

void LogService::start() {
  next_telling_ = Steady::now() + kBetweenTellings;
  thread_ = Thread("the log", [this](const std::stop_token& stop) { run(stop); });
}

void LogService::committed() {
  const std::lock_guard lock(mutex_);
  if (std::exchange(dirty_, true)) return;
  wake_.notify_one();
}

void LogService::take_names(const Stores& stores) {
  if (digits_of_origin(stores.log.state().origin) != origin()) {
    throw store::StorageFailure({ErrorCode::StorageUnavailable,
                                 "an older copy of the database was restored, and another service "
                                 "has begun a branch: restart this service"});
  }
  for (const auto& origin : stores.origins.list()) origins_.remember(origin.number, origin.digits);
  std::string lines;
  for (const std::string& key : stores.log.keys()) lines += key + "\n";
  verifier_keys_.set(std::make_shared<const std::string>(std::move(lines)));
}

/// @pre mutex_ is held.
LogService::Steady::time_point LogService::next_wake() const {
  auto next = next_telling_;
  if (dirty_) next = std::min(next, next_signing_);
  for (const Waiter& waiter : waiters_) next = std::min(next, waiter.deadline);
  return next;
}

void LogService::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    const auto now = Steady::now();
    if (dirty_ && now >= next_signing_) {
      dirty_ = false;
      next_signing_ = now + kBetweenSignings;
      lock.unlock();
      bool has_grown = false;
      guarded("the log",
              [&] { has_grown = grow([&stop] { return stop.stop_requested(); }).has_value(); });
      lock.lock();
      if (!has_grown) dirty_ = true;  // the storage reports its failures itself
    }
    if (now >= next_telling_) {
      next_telling_ = now + kBetweenTellings;
      guarded("the log", [&] { tell("log_head", head_text()); });
    }
    end_waiters(lock);
    const auto planned = next_wake();
    wake_.wait_until(lock, stop, planned, [&] { return next_wake() < planned; });
  }
  stopped_ = true;
  const std::vector<Waiter> left = std::exchange(waiters_, {});
  lock.unlock();
  for (const Waiter& waiter : left) {
    guarded("a proof that was waited for", [&] { waiter.done(shutting_down()); });
  }
  guarded("the log's end", [this] {
    // After the jobs that wait for the writer, which committed() does not report.
    if (!database_.writer().wait([](Stores&) {})) return;
    const auto end = Steady::now() + kLastGrowth;
    static_cast<void>(grow([end] { return Steady::now() >= end; }));
  });
}

/// The leaves that one commit adds to the tree.
struct LogService::Stretch {
  tlog::Frontier grown;
  std::vector<store::LogStore::Node> nodes{};
  bool more = true;  ///< there may be leaves after it
};

/// Reads new rows, stores the completed nodes, mostly in one commit, and signs. After an upgrade
/// there may be many rows: they are read in parts.
Result<void> LogService::grow(const IsOver& is_over) {
  const auto place = keep_place();
  if (!place && place.error().code == ErrorCode::LogForked) TRY(set_forked(place.error().message));
  if (!place) return place.error();
  for (bool more = true; more && !is_over();) {
    Stretch stretch{.grown = frontier_};
    TRY(take_leaves(is_over, stretch));
    if (stretch.grown.size() == frontier_.size()) break;
    TRY(database_.writer().wait([&](Stores& stores) {
      stores.log.grow(static_cast<std::int64_t>(stretch.grown.size()), stretch.nodes);
    }));
    frontier_ = std::move(stretch.grown);
    more = stretch.more;
  }
  // Not only this growth: earlier growth may not have been signed.
  if (frontier_.size() != head_.get()->checkpoint.size) sign();
  TRY(wait_for_result<std::string>([this](auto done) { changes_head(std::move(done)); }));
  return {};
}

Result<void> LogService::take_leaves(const IsOver& is_over, Stretch& stretch) {
  tlog::Frontier& grown = stretch.grown;
  const std::uint64_t end = grown.size() + kLeavesACommit;
  while (stretch.more && grown.size() < end && !is_over()) {
    const auto size = static_cast<std::int64_t>(grown.size());
    const auto leaves = TRY(database_.readers().wait(
        [&](const Stores& stores) { return reader(stores).leaves(size, kLeavesAtATime); }));
    for (const tlog::Hash& leaf : leaves) append_leaf(grown, leaf, stretch.nodes);
    stretch.more = leaves.size() == static_cast<std::size_t>(kLeavesAtATime);
  }
  return {};
}

void LogService::sign() {
  auto head = std::make_shared<Head>();
  head->checkpoint = {.origin = name_, .size = frontier_.size(), .root = frontier_.root()};
  std::vector<const tlog::SigningKey*> keys;
  for (const tlog::SigningKey& key : signers_) keys.push_back(&key);
  std::string text = head->checkpoint.text();
  // The owner of the old key names the next key: anybody can put a second signature under a
  // note.
  if (keys.size() > 1) text += next_key_line(signers_.front().verifier());
  head->note = tlog::sign_note(text, keys);
  if (keep(kTreeOfMeasurements, head->note) && signers_.size() > 1) {
    // The checkpoint of both keys is stored: from now on only the new key signs.
    const auto file = options_.directory /
                      fmt::format("{}.{:08x}", kCheckpointFile, signers_.front().verifier().id());
    signers_.resize(1, signers_.front());
    auto written = keep_file(file, head->note, true);
    if (written) written = write_keys();
    tell("log_key_replaced", written ? file.string() : written.error().message);
  }
  head_.set(std::move(head));
}

/// A folder that now belongs to another daemon gets no checkpoint of this log.
Result<void> LogService::keep(const TreeNames& tree, const std::string& note) const {
  const auto health = database_.health();
  auto kept = health.state == store::HealthState::WritesFailing
                  ? Result<void>(Error{ErrorCode::StorageUnavailable, health.reason})
                  : keep_file(options_.directory / tree.file, note, false);
  if (!kept) tell("log_checkpoint_not_kept", kept.error().message);
  return kept;
}

std::string LogService::head_text() const {
  const auto head = head_.get();
  return fmt::format("{} has {} measurements, root {}", name_, head->checkpoint.size,
                     tlog::to_base64(head->checkpoint.root));
}

std::string LogService::sign_at(const Stores& stores, const History& history,
                                std::uint64_t size) const {
  const tlog::Checkpoint checkpoint{
      .origin = history.name, .size = size, .root = reader(stores).frontier(size).root()};
  const tlog::SigningKey* const key = &*history.signer;
  return tlog::sign_note(checkpoint.text(), {&key, 1});
}

std::vector<std::string> LogService::hand_overs() const {
  std::vector<std::string> notes;
  const std::string prefix = std::string(kCheckpointFile) + ".";
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(options_.directory, failure)) {
    if (!entry.path().filename().string().starts_with(prefix)) continue;
    const auto note = read_small_file(entry.path());
    if (note && *note && next_key_of(**note)) notes.push_back(**note);
  }
  // A later checkpoint has signed at least as many measurements.
  std::ranges::sort(notes, [](const std::string& a, const std::string& b) {
    const auto size = [](const std::string& note) {
      const auto checkpoint = tlog::parse_checkpoint(note);
      return checkpoint ? checkpoint->size : 0;
    };
    return size(a) < size(b);
  });
  return notes;
}

Result<LogService::Logs> LogService::logs(Database& database) {
  return database.readers().wait([](const Stores& stores) {
    const store::LogStore::State state = stores.log.state();
    Logs logs;
    logs[0] = {.name = state.name.value_or(""),
               .size = state.size,
               .keys = kTreeOfMeasurements.keys(stores.log.keys())};
    Facts& changes = logs[LogReader::kChanges];
    changes = {.name = kTreeOfChanges.name(logs[0].name),
               .size = stores.changes.size(),
               .keys = kTreeOfChanges.keys(stores.log.keys()),
               .leaves = kTreeOfChanges.leaves};
    for (const auto& ended : stores.log.branches()) {
      logs[0].former.emplace(ended.name, static_cast<std::uint64_t>(ended.size));
      // The number of continued changes is not stored: their root determines it.
      changes.former.emplace(kTreeOfChanges.name(ended.name),
                             std::numeric_limits<std::uint64_t>::max());
    }
    for (const auto& origin : stores.origins.list()) {
      const auto keys = kTreeOfMeasurements.keys(stores.origins.keys(origin.number));
      logs[origin.number] = {.name = keys.empty() ? origin.digits : keys.front().name(),
                             .size = origin.size,
                             .keys = keys,
                             .checkpoint = origin.checkpoint,
                             .is_partial = keys.empty() && origin.size == 0};
      if (const auto base = stores.origins.base(origin.number)) {
        logs[origin.number].base =
            LogReader(stores, {}, base->origin).frontier(static_cast<std::uint64_t>(base->size));
      }
    }
    return logs;
  });
}

}  // namespace fitgauge::app
