#include "app/log/log_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "app/log/log_keys.hpp"
#include "app/log/log_reader.hpp"
#include "app/measurements/mapping.hpp"
#include "app/tables/table_catalog.hpp"
#include "base/guarded.hpp"
#include "store/database.hpp"
#include "tlog/base64.hpp"
#include "tlog/note.hpp"
#include "tlog/proof.hpp"

namespace fitgauge::app {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kBetweenSignings{1};
constexpr milliseconds kPatience{1'100};
constexpr hours kBetweenTellings{24};
constexpr std::int64_t kLeavesAtATime = 4096;
constexpr std::uint64_t kLeavesACommit = 1'000'000;
/// Hexadecimal digits of the origin in ids and in the log's name.
constexpr std::size_t kDigitsInIds = 16;
constexpr std::size_t kDigitsInName = 8;

Error unknown_tile(std::string_view path) {
  return {ErrorCode::NotFound,
          fmt::format("the log has no tile '{}'; its size is in /v1/log/checkpoint",
                      path.substr(0, 60))};
}

Error stopping() { return {ErrorCode::ShuttingDown, "the service is shutting down"}; }

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

RowNames LogService::row_names() const {
  return {.revision_id = [this](std::int64_t number) { return tables_.revision_id(number); },
          .origin = origin_};
}

Result<void> LogService::load() {
  struct Loaded {
    store::LogStore::State state;
    std::vector<std::string> keys;
    tlog::Frontier frontier;
  };
  const auto loaded =
      database_.readers().wait([this](const store::Stores& stores) -> Result<Loaded> {
        Loaded found{.state = stores.log.state(), .keys = stores.log.keys(), .frontier = {}};
        origin_ = to_hex(found.state.origin).substr(0, kDigitsInIds);
        if (options_.attach) return found;
        const RowNames names = row_names();
        LogReader reader(stores, names);
        const auto size = static_cast<std::uint64_t>(found.state.size);
        std::vector<tlog::Hash> roots;
        for (const tlog::Node& node : tlog::subtrees(0, size)) roots.push_back(reader.node(node));
        found.frontier = tlog::Frontier(size, std::move(roots));
        return found;
      });
  // What is damaged is for verify to tell.
  if (options_.attach && !loaded && loaded.error().code == ErrorCode::StorageCorrupt) return {};
  if (!loaded) return loaded.error();
  chained_ = loaded->state.chained;
  if (options_.attach) return {};
  frontier_ = loaded->frontier;
  name_ = loaded->state.name.value_or(
      fmt::format("fitgauge/{}/{}", options_.name, origin_.substr(0, kDigitsInName)));
  if (const auto keys = load_keys(loaded->keys); !keys) return keys;
  look_at_older_checkpoint();
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
    if (!known.empty()) {
      tell("log_key_lost",
           fmt::format("{} is not there: a new key signs from now on, and nothing but a kept "
                       "checkpoint joins it to the old one",
                       kLogKeyFile));
    }
  }
  signers_ = *std::move(keys);
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

void LogService::start() {
  next_telling_ = Steady::now() + kBetweenTellings;
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void LogService::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void LogService::committed() {
  const std::lock_guard lock(mutex_);
  if (std::exchange(dirty_, true)) return;
  wake_.notify_one();
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
      Result<void> grown;
      guarded("the log", [&] { grown = grow(stop); });
      lock.lock();
      if (!grown) dirty_ = true;  // the storage tells of its failures itself
    }
    if (now >= next_telling_) {
      next_telling_ = now + kBetweenTellings;
      tell("log_head", head_text());
    }
    end_waiters(lock);
    const auto planned = next_wake();
    wake_.wait_until(lock, stop, planned, [&] { return next_wake() < planned; });
  }
  stopped_ = true;
  const std::vector<Waiter> left = std::exchange(waiters_, {});
  lock.unlock();
  for (const Waiter& waiter : left) waiter.done(stopping());
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
  const std::uint64_t before = frontier_.size();
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
  if (frontier_.size() != before) sign();
  return {};
}

Result<void> LogService::take_leaves(const std::stop_token& stop, Stretch& stretch) {
  tlog::Frontier& grown = stretch.grown;
  const std::uint64_t end = grown.size() + kLeavesACommit;
  while (stretch.more && grown.size() < end && !stop.stop_requested()) {
    const auto size = static_cast<std::int64_t>(grown.size());
    const auto leaves = database_.readers().wait(
        [this, size](const store::Stores& stores) -> Result<std::vector<tlog::Hash>> {
          const RowNames names = row_names();
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
  head->note = tlog::sign_note(head->checkpoint.text(), keys);
  if (const auto kept = replace_file(options_.directory / kCheckpointFile, head->note, false);
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

/// Asks again for those whose measurement is covered now, and refuses those whose time is over.
void LogService::end_waiters(std::unique_lock<std::mutex>& lock) {
  const auto now = Steady::now();
  const auto size = static_cast<std::int64_t>(head_.get()->checkpoint.size);
  const auto first = std::stable_partition(
      waiters_.begin(), waiters_.end(),
      [&](const Waiter& waiter) { return waiter.id > size && waiter.deadline > now; });
  std::vector<Waiter> over(std::make_move_iterator(first), std::make_move_iterator(waiters_.end()));
  waiters_.erase(first, waiters_.end());
  lock.unlock();
  for (Waiter& waiter : over) {
    guarded("a proof that was waited for", [&] {
      if (waiter.id <= size) return prove(waiter.id, std::move(waiter.done));
      waiter.done(Error{ErrorCode::StorageBusy,
                        "no checkpoint covers the measurement yet; ask again in a second"});
    });
  }
  lock.lock();
}

Result<LogService::Proof> LogService::read_proof(const store::Stores& stores, std::int64_t id) {
  // The state of the job's first statement is not older than a head that was taken before it.
  Proof proof{
      .index = static_cast<std::uint64_t>(id - 1), .leaf = {}, .path = {}, .head = head_.get()};
  if (id > stores.measurements.last_id()) {
    return Error{ErrorCode::MeasurementUnknown,
                 fmt::format("there is no measurement '{}'", measurement_id_text(id, origin_))};
  }
  const std::uint64_t size = proof.head->checkpoint.size;
  if (proof.index >= size) return proof;
  const RowNames names = row_names();
  LogReader reader(stores, names);
  proof.leaf = reader.node({.level = 0, .index = proof.index});
  proof.path = tlog::inclusion_proof(proof.index, size,
                                     [&](const tlog::Node& node) { return reader.node(node); });
  return proof;
}

void LogService::prove(std::int64_t id, Done<Proof> done) {
  const auto asked = Steady::now();
  database_.readers().submit(
      [this, id](const store::Stores& stores) { return read_proof(stores, id); },
      [this, id, asked, done = std::move(done)](Result<Proof> proof) mutable {
        if (!proof || proof->index < proof->head->checkpoint.size) return done(std::move(proof));
        std::unique_lock lock(mutex_);
        if (!stopped_) {
          waiters_.push_back({.id = id, .deadline = asked + kPatience, .done = std::move(done)});
          dirty_ = true;
          return wake_.notify_one();
        }
        lock.unlock();
        done(stopping());
      });
}

void LogService::tile(std::string_view path, Done<TileBytes> done) {
  const auto tile = tlog::parse_tile(path);
  if (!tile || !tlog::has_tile(head_.get()->checkpoint.size, *tile)) {
    return done(unknown_tile(path));
  }
  database_.readers().submit(
      [this, tile = *tile](const store::Stores& stores) -> Result<TileBytes> {
        const RowNames names = row_names();
        return TileBytes{.bytes = LogReader(stores, names).tile(tile),
                         .is_full = tile.width == tlog::kTileWidth};
      },
      std::move(done));
}

Result<LogService::Facts> LogService::facts(store::Database& database) {
  return database.readers().wait([](const store::Stores& stores) -> Result<Facts> {
    const store::LogStore::State state = stores.log.state();
    Facts facts{
        .name = state.name.value_or(""), .chained = state.chained, .size = state.size, .keys = {}};
    for (const std::string& text : stores.log.keys()) {
      // One that was altered does not fit its seal, which verify tells.
      if (const auto key = tlog::VerifierKey::parse(text)) facts.keys.push_back(*key);
    }
    return facts;
  });
}

}  // namespace fitgauge::app
