#include "service/log/log_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <utility>

#include "base/base64.hpp"
#include "base/guarded.hpp"
#include "db/store/database.hpp"
#include "proof/note.hpp"
#include "service/log/log_keys.hpp"
#include "service/log/log_reader.hpp"
#include "service/measurements/mapping.hpp"
#include "service/measurements/measurement_storage.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

using std::chrono::hours;
using std::chrono::seconds;

constexpr seconds kBetweenSignings{1};
constexpr hours kBetweenTellings{24};
constexpr std::int64_t kLeavesAtATime = 4096;
constexpr std::uint64_t kLeavesACommit = 1'000'000;
/// Hexadecimal digits of the origin in ids and in the log's name.
constexpr std::size_t kDigitsInIds = 16;
constexpr std::size_t kDigitsInName = 8;

}  // namespace

LogService::LogService(store::Database& database, const TableCatalog& tables, const Clock& clock,
                       LogOptions options)
    : database_(database), tables_(tables), clock_(clock), options_(std::move(options)) {}

void LogService::tell(std::string_view event, const std::string& detail) const {
  if (options_.tell) options_.tell(event, detail);
}

LogService::~LogService() { stop(); }

Result<std::unique_ptr<LogService>> LogService::open(store::Database& database,
                                                     const TableCatalog& tables, const Clock& clock,
                                                     LogOptions options) {
  std::unique_ptr<LogService> log(new LogService(database, tables, clock, std::move(options)));
  if (const auto loaded = log->load(); !loaded) return loaded.error();
  return log;
}

Result<void> LogService::load() {
  struct Loaded {
    store::LogStore::State state;
    std::vector<std::string> keys;
    tlog::Frontier frontier;
    std::int64_t size_at_centre = 0;
  };
  const auto loaded =
      database_.readers().wait([this](const store::Stores& stores) -> Result<Loaded> {
        Loaded found{.state = stores.log.state(), .keys = stores.log.keys(), .frontier = {}};
        const auto forwarded = stores.origins.forwarded();
        if (forwarded && forwarded->size > stores.measurements.log_size()) {
          found.size_at_centre = forwarded->size;
        }
        origins_.remember(0, to_hex(found.state.origin).substr(0, kDigitsInIds));
        for (const auto& origin : stores.origins.list()) {
          origins_.remember(origin.number, origin.digits);
        }
        if (options_.attach) return found;
        const RowNames names = row_names(tables_, origins_);
        LogReader reader(stores, names);
        found.frontier = reader.frontier(static_cast<std::uint64_t>(found.state.size));
        return found;
      });
  // What is damaged is for verify to tell.
  if (options_.attach && !loaded && loaded.error().code == ErrorCode::StorageCorrupt) return {};
  if (!loaded) return loaded.error();
  if (options_.attach) return {};
  frontier_ = loaded->frontier;
  name_ = loaded->state.name.value_or(
      fmt::format("fitgauge/{}/{}", options_.name, origin().substr(0, kDigitsInName)));
  if (const auto keys = load_keys(loaded->keys); !keys) return keys;
  look_at_older_checkpoint();
  if (loaded->size_at_centre > 0) set_behind(loaded->size_at_centre);
  sign();
  return {};
}

/// Makes the key at the first start, or when it was lost, and lists its public half.
Result<void> LogService::load_keys(const std::vector<std::string>& known) {
  auto keys = read_log_keys(options_.directory);
  if (!keys) return keys.error();
  if (!keys->empty() && keys->front().verifier().name() != name_) {
    set_aside(kLogKeyFile, "of another log");
    keys->clear();
  }
  if (keys->empty()) {
    keys->push_back(tlog::SigningKey::make(name_));
    if (const auto written = write_log_keys(options_.directory, *keys); !written) return written;
    // Of daemons that share a database each has a key of its own.
    if (!known.empty() && !options_.shares) {
      tell("log_key_lost",
           fmt::format("{} is not there: a new key signs from now on, and nothing but a kept "
                       "checkpoint joins it to the old one",
                       kLogKeyFile));
    }
  }
  signers_ = *std::move(keys);
  signer_ = signers_.front();
  std::vector<std::string> all = known;
  const std::string newest = signers_.front().verifier().text();
  const bool is_new = std::find(known.begin(), known.end(), newest) == known.end();
  if (is_new) all.insert(all.begin(), newest);
  std::string lines;
  for (const std::string& key : all) lines += key + "\n";
  verifier_keys_.set(std::make_shared<const std::string>(std::move(lines)));
  if (!is_new) return {};
  const auto stored = database_.writer().wait([&](store::Stores& stores) -> Result<bool> {
    stores.log.set_name(name_);
    stores.log.add_key(newest, clock_.now().nanoseconds);
    return true;
  });
  if (!stored) return stored.error();
  return {};
}

/// Keeps a file that does not belong to the database any more.
void LogService::set_aside(std::string_view name, std::string_view why) {
  const auto aside = fmt::format("{}.{}", name, clock_.now().nanoseconds / 1'000'000'000);
  std::error_code failure;
  std::filesystem::rename(options_.directory / name, options_.directory / aside, failure);
  tell("log_file_set_aside",
       failure ? fmt::format("{} is {}, and cannot be renamed: {}", name, why, failure.message())
               : fmt::format("{} is {}: it is called {} now", name, why, aside));
}

/// A folder whose database is older than what it signed got a copy back. The checkpoint that tells
/// stays aside.
void LogService::look_at_older_checkpoint() {
  const auto note = read_small_file(options_.directory / kCheckpointFile);
  if (!note || !*note || (*note)->empty()) return;
  std::vector<tlog::VerifierKey> keys;
  for (const tlog::SigningKey& key : signers_) keys.push_back(key.verifier());
  const auto kept = tlog::open_checkpoint(**note, keys);
  if (!kept || kept->origin != name_) {
    set_aside(kCheckpointFile, "of another log or key");
  } else if (kept->size > frontier_.size()) {
    set_aside(kCheckpointFile, "newer than the database");
    tell("log_behind",
         fmt::format("this folder has signed {} measurements, and the database has {} "
                     "of them: an older copy was put back, and ids from m{} on are "
                     "given out a second time",
                     kept->size, frontier_.size(), frontier_.size() + 1));
  }
}

void LogService::set_behind(std::int64_t size_at_centre) {
  size_at_centre_ = size_at_centre;
  tell("log_behind", behind()->message);
}

std::optional<Error> LogService::behind() const {
  const std::int64_t size = size_at_centre_;
  if (size == 0) return std::nullopt;
  return Error{ErrorCode::StorageUnavailable,
               fmt::format("the centre has {} measurements of this folder's log, which are more "
                           "than there are here: an older copy was put back, or the folder was "
                           "copied and started twice. It takes no measurement, so that none gets "
                           "the id of another: put the newest copy back, or start with an empty "
                           "folder",
                           size),
               "database"};
}

void LogService::start() {
  next_telling_ = Steady::now() + kBetweenTellings;
  thread_ = Thread("the log", [this](const std::stop_token& stop) { run(stop); });
}

void LogService::stop() { thread_.stop(); }

void LogService::committed() {
  const std::lock_guard lock(mutex_);
  if (std::exchange(dirty_, true)) return;
  wake_.notify_one();
}

void LogService::take_names(const store::Stores& stores) {
  for (const auto& origin : stores.origins.list()) {
    origins_.remember(origin.number, origin.digits);
  }
  std::string lines;
  for (const std::string& key : stores.log.keys()) lines += key + "\n";
  verifier_keys_.set(std::make_shared<const std::string>(std::move(lines)));
}

std::string LogService::verifier_keys() const { return *verifier_keys_.get(); }

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
      guarded("the log", [&] { has_grown = grow(stop).has_value(); });
      lock.lock();
      if (!has_grown) dirty_ = true;  // the storage tells of its failures itself
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
}

/// What one commit adds to the tree.
struct LogService::Stretch {
  tlog::Frontier grown;
  std::vector<store::LogStore::Node> nodes{};
  bool more = true;  ///< there may be leaves behind it
};

/// Takes in what was stored since, keeps the nodes it completes, mostly in one commit, and signs.
/// After an upgrade that may be a long way: it is gone in stretches.
Result<void> LogService::grow(const std::stop_token& stop) {
  for (bool more = true; more && !stop.stop_requested();) {
    Stretch stretch{.grown = frontier_};
    if (const auto taken = take_leaves(stop, stretch); !taken) return taken;
    if (stretch.grown.size() == frontier_.size()) break;
    const auto kept = database_.writer().wait([&](store::Stores& stores) -> Result<bool> {
      stores.log.grow(static_cast<std::int64_t>(stretch.grown.size()), stretch.nodes);
      return true;
    });
    if (!kept) return kept.error();
    frontier_ = std::move(stretch.grown);
    more = stretch.more;
  }
  // Not this growth alone: what was taken in before may not have been signed.
  if (frontier_.size() != head_.get()->checkpoint.size) sign();
  return {};
}

Result<void> LogService::take_leaves(const std::stop_token& stop, Stretch& stretch) {
  tlog::Frontier& grown = stretch.grown;
  const std::uint64_t end = grown.size() + kLeavesACommit;
  while (stretch.more && grown.size() < end && !stop.stop_requested()) {
    const auto size = static_cast<std::int64_t>(grown.size());
    const auto leaves = database_.readers().wait(
        [this, size](const store::Stores& stores) -> Result<std::vector<tlog::Hash>> {
          const RowNames names = row_names(tables_, origins_);
          return LogReader(stores, names).leaves(size, kLeavesAtATime);
        });
    if (!leaves) return leaves.error();
    for (const tlog::Hash& leaf : *leaves) {
      const unsigned completed = grown.append(leaf);
      for (unsigned level = tlog::kTileHeight; level < completed; level += tlog::kTileHeight) {
        stretch.nodes.push_back({.level = static_cast<int>(level / tlog::kTileHeight),
                                 .index = static_cast<std::int64_t>((grown.size() >> level) - 1),
                                 .hash = grown.completed(level)});
      }
    }
    stretch.more = leaves->size() == static_cast<std::size_t>(kLeavesAtATime);
  }
  return {};
}

void LogService::sign() {
  auto head = std::make_shared<Head>();
  head->checkpoint = {.origin = name_, .size = frontier_.size(), .root = frontier_.root()};
  std::vector<const tlog::SigningKey*> keys;
  for (const tlog::SigningKey& key : signers_) keys.push_back(&key);
  std::string text = head->checkpoint.text();
  // Who holds the old key says which one comes next: anybody can put a second signature under a
  // note.
  if (keys.size() > 1) text += next_key_line(signers_.front().verifier());
  head->note = tlog::sign_note(text, keys);
  // A folder that is another's by now gets no checkpoint of this log.
  if (const auto health = database_.health(); health.state == store::HealthState::WritesFailing) {
    tell("log_checkpoint_not_kept", health.reason);
  } else if (const auto kept =
                 replace_file(options_.directory / kCheckpointFile, head->note, false);
             !kept) {
    tell("log_checkpoint_not_kept", kept.error().message);
  } else if (signers_.size() > 1) {
    // The hand-over from the old key is kept: the new one signs alone from now on.
    const auto file = options_.directory /
                      fmt::format("{}.{:08x}", kCheckpointFile, signers_.front().verifier().id());
    signers_.resize(1, signers_.front());
    auto written = replace_file(file, head->note, true);
    if (written) written = write_log_keys(options_.directory, signers_);
    tell("log_key_replaced", written ? file.string() : written.error().message);
  }
  head_.set(std::move(head));
}

std::string LogService::head_text() const {
  const auto head = head_.get();
  return fmt::format("{} has {} measurements, root {}", name_, head->checkpoint.size,
                     tlog::to_base64(head->checkpoint.root));
}

std::string LogService::sign_at(const store::Stores& stores, std::uint64_t size) const {
  const RowNames names = row_names(tables_, origins_);
  LogReader reader(stores, names);
  const tlog::Checkpoint checkpoint{
      .origin = name_, .size = size, .root = reader.frontier(size).root()};
  const tlog::SigningKey* const key = &*signer_;
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
  // A later one has signed as many measurements or more.
  std::sort(notes.begin(), notes.end(), [](const std::string& a, const std::string& b) {
    const auto size = [](const std::string& note) {
      const auto checkpoint = tlog::parse_checkpoint(note);
      return checkpoint ? checkpoint->size : 0;
    };
    return size(a) < size(b);
  });
  return notes;
}

Result<LogService::Logs> LogService::logs(store::Database& database) {
  // A key that was altered does not fit its seal, which verify tells.
  const auto parsed = [](const std::vector<std::string>& texts) {
    std::vector<tlog::VerifierKey> keys;
    for (const std::string& text : texts) {
      if (const auto key = tlog::VerifierKey::parse(text)) keys.push_back(*key);
    }
    return keys;
  };
  return database.readers().wait([&](const store::Stores& stores) -> Result<Logs> {
    const store::LogStore::State state = stores.log.state();
    Logs logs;
    logs[0] = {.name = state.name.value_or(""),
               .size = state.size,
               .keys = parsed(stores.log.keys()),
               .checkpoint = {}};
    for (const auto& origin : stores.origins.list()) {
      const auto keys = parsed(stores.origins.keys(origin.number));
      logs[origin.number] = {.name = keys.empty() ? origin.digits : keys.front().name(),
                             .size = origin.size,
                             .keys = keys,
                             .checkpoint = origin.checkpoint,
                             .is_partial = keys.empty() && origin.size == 0};
    }
    return logs;
  });
}

}  // namespace fitgauge::app
