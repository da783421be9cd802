#include <sstream>

#include "db/store/database.hpp"
#include "service/log/leaves.hpp"
#include "service/log/log_keys.hpp"
#include "service/log/log_reader.hpp"
#include "service/log/log_service.hpp"
#include "service/measurements/measurement_storage.hpp"
#include "service/tables/table_catalog.hpp"

// Responses of the log: tiles, and proofs, also of forwarded records under a signature of this
// folder. Its growth is in log_service.cpp.

namespace fitgauge::app {
namespace {

constexpr std::chrono::milliseconds kPatience{1'100};

Error unknown_tile(std::string_view path) {
  return {ErrorCode::NotFound,
          fmt::format("the log has no tile '{}'; its size is in /v1/log/checkpoint",
                      path.substr(0, 60))};
}

}  // namespace

void LogService::prove(const RecordName& name, Done<Proof> done) {
  const auto asked = Steady::now();
  database_.readers().submit(
      [this, name](const Stores& stores) { return read_proof(stores, name); },
      [this, name, asked, done = std::move(done)](Result<Proof> proof) mutable {
        if (!proof || proof->index < proof->head->checkpoint.size) return done(std::move(proof));
        std::unique_lock lock(mutex_);
        if (!stopped_) {
          waiters_.push_back({.name = name,
                              .index = proof->index,
                              .deadline = asked + kPatience,
                              .done = std::move(done)});
          dirty_ = true;
          return wake_.notify_one();
        }
        lock.unlock();
        done(shutting_down());
      });
}

Result<LogService::Proof> LogService::read_proof(const Stores& stores, const RecordName& name) {
  // The state of the job's first statement is not older than a head that was read before it.
  Proof proof{.index = 0, .leaf = {}, .path = {}, .head = head_.get()};
  const auto row = row_of(stores, name);
  std::int64_t place = 0;
  if (row) {
    stores.measurements.find(*row,
                             [&](const MeasurementRow& found) { place = found.place_in_log(); });
  }
  if (place == 0) {
    return unknown_measurement(name, origins_);
  }
  proof.index = static_cast<std::uint64_t>(place - 1);
  if (name.origin != 0) {
    proof.head = countersigned(stores, name.origin);
    if (!proof.head) {
      return Error{
          ErrorCode::NotFound,
          fmt::format("{} was made at the centre: its log and its proof are there",
                      measurement_id_text(name.number, origins_.digits(name.origin, name.number)))};
    }
  }
  const std::uint64_t size = proof.head->checkpoint.size;
  if (proof.index >= size) return proof;
  LogReader log = reader(stores, name.origin);
  proof.leaf = log.node({.level = 0, .index = proof.index});
  proof.path = tlog::inclusion_proof(proof.index, size,
                                     [&](const tlog::Node& node) { return log.node(node); });
  return proof;
}

/// Returns the head of a forwarded log, with a signature of this folder in addition to the
/// station's; none for a log with only corrections here.
std::shared_ptr<const LogService::Head> LogService::countersigned(const Stores& stores,
                                                                  std::int64_t origin) const {
  auto head = std::make_shared<Head>();
  if (stores.origins.find(origin)->size == 0) return nullptr;
  head->note = stores.origins.find(origin)->checkpoint;
  head->checkpoint = tlog::parse_checkpoint(head->note).value();
  const std::string_view text = std::string_view(head->note).substr(0, head->note.find("\n\n") + 1);
  const tlog::SigningKey* const key = &*signer_;
  const std::string own = tlog::sign_note(text, {&key, 1});
  head->note += own.substr(text.size() + 1);
  return head;
}

/// Repeats the request of waiters whose measurement is now covered, and refuses waiters after their
/// time.
void LogService::end_waiters(std::unique_lock<std::mutex>& lock) {
  const auto now = Steady::now();
  const std::uint64_t size = head_.get()->checkpoint.size;
  const auto first = std::stable_partition(
      waiters_.begin(), waiters_.end(),
      [&](const Waiter& waiter) { return waiter.index >= size && waiter.deadline > now; });
  std::vector<Waiter> over(std::make_move_iterator(first), std::make_move_iterator(waiters_.end()));
  waiters_.erase(first, waiters_.end());
  lock.unlock();
  for (Waiter& waiter : over) {
    guarded("a proof that was waited for", [&] {
      if (waiter.index < size) return prove(waiter.name, std::move(waiter.done));
      waiter.done(Error{ErrorCode::StorageBusy,
                        "no checkpoint covers the measurement yet: ask again in a second"});
    });
  }
  lock.lock();
}

void LogService::tile(std::string_view path, bool of_changes, Done<TileBytes> done) {
  const auto tile = tlog::parse_tile(path);
  if (!tile || (!of_changes && !tlog::has_tile(head_.get()->checkpoint.size, *tile))) {
    return done(unknown_tile(path));
  }
  database_.readers().submit(
      [this, of_changes, tile = *tile,
       path = std::string(path)](const Stores& stores) -> Result<TileBytes> {
        if (of_changes &&
            !tlog::has_tile(static_cast<std::uint64_t>(stores.changes.size()), tile)) {
          return unknown_tile(path);
        }
        return TileBytes{.bytes = reader(stores, of_changes ? LogReader::kChanges : 0).tile(tile),
                         .is_full = tile.width == tlog::kTileWidth};
      },
      std::move(done));
}

void LogService::changes(store::ChangeFilter filter, std::string after, std::int64_t limit,
                         Done<ChangePage> done) const {
  database_.readers().submit(
      [filter = std::move(filter), after = std::move(after),
       limit](const Stores& stores) -> Result<ChangePage> {
        std::vector<std::pair<std::string, std::int64_t>> histories;  // and the last of each
        for (const auto& ended : stores.log.branches()) {
          histories.emplace_back(digits_of_origin(ended.origin),
                                 stores.log.last_change(ended.name));
        }
        histories.emplace_back(digits_of_origin(stores.log.state().origin), stores.changes.size());
        const std::string_view given =
            std::string_view(after).substr(after.starts_with('c') ? 1 : 0);
        const std::size_t dash = std::min(given.find('-', 1), given.size());
        const std::string_view digits = given.substr(std::min(dash + 1, given.size()));
        const auto of = std::ranges::find_if(
            histories, [&](const auto& each) { return digits.empty() || each.first == digits; });
        const auto number = read_number<std::int64_t>(given.substr(0, dash));
        if (!number || *number < 0 || of == histories.end() || *number > of->second) {
          return Error{
              ErrorCode::CursorInvalid,
              "after must be an id, or `next` or `last` of an earlier page, of this history"};
        }
        const auto id = [&histories](std::int64_t of_number) {
          const auto own = std::find_if(histories.begin(), std::prev(histories.end()),
                                        [=](const auto& each) { return of_number <= each.second; });
          return fmt::format("c{}-{}", of_number, own->first);
        };
        const auto page = stores.changes.list(filter, *number, limit);
        ChangePage found{
            .changes = {}, .last = *number == 0 ? "" : id(*number), .has_more = page.has_more};
        for (const store::Change& change : page.changes) {
          found.last = id(change.id);
          found.changes.push_back(change_json(change, found.last));
        }
        return found;
      },
      std::move(done));
}

void LogService::changes_head(Done<std::string> done) {
  database_.readers().submit(
      [this](const Stores& stores) -> Result<std::string> {
        const std::lock_guard lock(changes_mutex_);
        const auto size = static_cast<std::uint64_t>(stores.changes.size());
        // A job that sees fewer changes than another job uses the other's head.
        if (changes_head_ && changes_head_->checkpoint.size >= size) return changes_head_->note;
        const tlog::SigningKey named = signer_->named(kTreeOfChanges.name(name_));
        const tlog::SigningKey* const key = &named;
        Head head{.checkpoint = {.origin = named.verifier().name(),
                                 .size = size,
                                 .root = reader(stores, LogReader::kChanges).frontier(size).root()},
                  .note = {}};
        head.note = tlog::sign_note(head.checkpoint.text(), {&key, 1});
        static_cast<void>(keep(kTreeOfChanges, head.note));
        changes_head_ = std::move(head);
        return changes_head_->note;
      },
      std::move(done));
}

std::string LogService::changes_keys() const {
  std::istringstream lines(verifier_keys());
  std::string keys;
  for (std::string line; std::getline(lines, line);) {
    const auto key = tlog::VerifierKey::parse(line);
    if (key) keys += key->named(kTreeOfChanges.name(key->name())).text() + "\n";
  }
  return keys;
}

}  // namespace fitgauge::app
