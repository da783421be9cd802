#include <filesystem>
#include <random>

#include "db/store/database.hpp"
#include "service/log/log_keys.hpp"
#include "service/log/log_reader.hpp"
#include "service/log/log_service.hpp"
#include "service/tables/table_catalog.hpp"

// The begin of a folder's log: its history and its key. Its growth is in log_service.cpp.

namespace fitgauge::app {
namespace {

using Mark = store::LogStore::Mark;

/// Hexadecimal digits of the origin in the log's name.
constexpr std::size_t kDigitsInName = 8;

std::string name_of(std::string_view name, std::string_view digits) {
  return fmt::format("fitgauge/{}/{}", name, digits.substr(0, kDigitsInName));
}

/// NAME of fitgauge/NAME/DIGITS.
std::string_view middle_of(std::string_view name) {
  const std::size_t first = name.find('/') + 1;
  return name.substr(first, name.rfind('/') - first);
}

/// Whether the options give the log another name. The default name leaves a log its own.
bool is_renamed(std::string_view name, const LogOptions& options) {
  return options.name != LogOptions().name && options.name != middle_of(name);
}

/// The name under which a folder has signed the log with this origin; none: it has not.
std::optional<std::string> name_in_folder(const std::filesystem::path& folder,
                                          const std::string& digits) {
  std::vector<std::string> names;
  for (const TreeNames& tree : {kTreeOfMeasurements, kTreeOfChanges}) {
    const auto note = read_small_file(folder / tree.file);
    if (!note || !*note) continue;
    const auto checkpoint = tlog::parse_checkpoint(**note);
    if (!checkpoint || !checkpoint->origin.ends_with(tree.suffix)) continue;
    names.push_back(checkpoint->origin.substr(0, checkpoint->origin.size() - tree.suffix.size()));
  }
  if (const auto keys = read_log_keys(folder)) {
    for (const tlog::SigningKey& key : *keys) names.push_back(key.verifier().name());
  }
  const std::string ending = "/" + digits.substr(0, kDigitsInName);
  const auto name =
      std::ranges::find_if(names, [&](const auto& each) { return each.ends_with(ending); });
  return name == names.end() ? std::nullopt : std::optional(*name);
}

/// Whether only the timeline differs.
bool is_after_fail_over(const std::optional<std::string>& kept, const std::string& place) {
  return kept && *kept != place &&
         kept->substr(0, kept->rfind(' ')) == place.substr(0, place.rfind(' '));
}

}  // namespace

/// The state of the log in the database.
struct LogService::Loaded {
  store::LogStore::State state{};
  std::vector<store::LogStore::Branch> branches{};
  std::vector<std::string> keys{};
  std::int64_t rows = 0;
  std::int64_t changes = 0;
  bool is_copy = false;
  std::string place{};
  std::optional<std::string> kept_place{};
  std::optional<std::string> forked{};
  std::optional<std::string> centre{};
  std::vector<store::OriginsStore::Origin> origins{};

  /// Whether the log takes the name of the options: no measurement has named the current one, and
  /// neither a station nor another daemon relies on it.
  bool takes_name(const LogOptions& options) const {
    return is_renamed(*state.name, options) && rows == 0 && origins.empty() && !options.shares;
  }
};

Result<LogService::Loaded> LogService::read() const {
  return database_.readers().wait([](const Stores& stores) {
    return Loaded{.state = stores.log.state(),
                  .branches = stores.log.branches(),
                  .keys = stores.log.keys(),
                  .rows = stores.measurements.log_size(),
                  .changes = stores.changes.size(),
                  .is_copy = stores.log.mark(Mark::Copy).has_value(),
                  .place = stores.log.place(),
                  .kept_place = stores.log.mark(Mark::Place),
                  .forked = stores.log.mark(Mark::Forked),
                  .centre = stores.log.mark(Mark::Centre),
                  .origins = stores.origins.list()};
  });
}

/// After a fail-over, gives the daemons that were connected before it time to accept the new
/// timeline: they know which ids they have given out.
Result<void> LogService::settle_place(Loaded& loaded) {
  constexpr int kMostLooks = 7;
  for (int look = 0; look < kMostLooks && is_after_fail_over(loaded.kept_place, loaded.place);
       ++look) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    loaded = TRY(read());
  }
  return {};
}

/// Keeps the place of the database, and the new timeline after a fail-over that this daemon was
/// connected through.
/// @errors LogForked if it is not the database that this daemon has signed.
Result<void> LogService::keep_place() const {
  if (!options_.shares) return {};
  const auto is_kept = TRY(database_.readers().wait([&](const Stores& stores) {
    const auto forked = [](std::string why) { return Error{ErrorCode::LogForked, std::move(why)}; };
    if (const auto why = stores.log.mark(Mark::Forked)) return Result<bool>(forked(*why));
    const auto kept = stores.log.mark(Mark::Place);
    const std::string place = stores.log.place();
    if (kept && *kept != place && !is_after_fail_over(kept, place)) {
      return Result<bool>(forked(
          fmt::format("the database was at {}, and is at {}: restart this service", *kept, place)));
    }
    tlog::Frontier own = frontier_;
    const bool is_behind = stores.log.state().size < static_cast<std::int64_t>(own.size());
    if (is_behind || reader(stores).frontier(own.size()).root() != own.root()) {
      return Result<bool>(
          forked(fmt::format("the database does not have the {} measurements that this service "
                             "signed: restart this service",
                             own.size())));
    }
    return Result<bool>(kept == place);
  }));
  if (is_kept) return {};
  return database_.writer().wait(
      [](Stores& stores) { stores.log.set_mark(Mark::Place, stores.log.place()); });
}

Result<void> LogService::load() {
  auto loaded = read();
  // verify reports damage.
  if (options_.attach && !loaded && loaded.error().code == ErrorCode::StorageCorrupt) return {};
  if (!loaded) return loaded.error();
  if (!options_.attach) {
    TRY(settle_place(*loaded));
    if (const auto why = why_to_branch(*loaded)) {
      TRY(branch(*loaded, *why));
      loaded = read();
      if (!loaded) return loaded.error();
    }
  }
  std::int64_t begin = 0;
  for (const auto& ended : loaded->branches) {
    const std::string digits = digits_of_origin(ended.origin);
    origins_.remember({.digits = digits, .newest = ended.newest});
    histories_.push_back({.digits = digits, .name = ended.name, .begin = begin, .end = ended.size});
    begin = ended.size;
  }
  origins_.remember(0, digits_of_origin(loaded->state.origin));
  for (const auto& origin : loaded->origins) origins_.remember(origin.number, origin.digits);
  if (options_.attach) return {};
  frontier_ = TRY(database_.readers().wait([&](const Stores& stores) {
    return reader(stores).frontier(static_cast<std::uint64_t>(loaded->state.size));
  }));
  name_ = loaded->state.name.value_or(name_of(options_.name, origin()));
  histories_.push_back({.digits = std::string(origin()), .name = name_, .begin = begin});
  if (is_renamed(name_, options_)) {
    tell("log_name_kept",
         fmt::format("the measurement log is {} and stays so: origin-name {} is for an empty log; "
                     "remove the setting, or start with an empty data folder",
                     name_, options_.name));
  }
  TRY(load_keys(loaded->keys));
  TRY(keep_place());
  if (loaded->forked) {
    forked_.set(std::make_shared<const std::string>(*loaded->forked));
    tell("log_forked", *loaded->forked);
  }
  sign();
  TRY(wait_for_result<std::string>([this](auto done) { changes_head(std::move(done)); }));
  return {};
}

/// Makes the key at the first start of a history, or when it was lost, and lists its public half.
Result<void> LogService::load_keys(const std::vector<std::string>& known) {
  auto keys = TRY(read_log_keys(options_.directory));
  const bool is_in_order = !keys.empty() && keys.front().verifier().name() == name_;
  for (const tlog::SigningKey& key : keys) {
    const auto history = std::ranges::find_if(
        histories_, [&](const History& each) { return each.name == key.verifier().name(); });
    if (history != histories_.end() && !history->end) {
      signers_.push_back(key);
      continue;
    }
    // A history that this database does not know may belong to a later copy, which comes back.
    if (history != histories_.end() && !history->signer) history->signer = key;
    older_.push_back(key);
  }
  const bool is_made = signers_.empty();
  if (is_made) signers_.push_back(tlog::SigningKey::make(name_));
  if (is_made || !is_in_order) TRY(write_keys());
  if (is_made) {
    const bool was_there = std::ranges::any_of(known, [this](const auto& text) {
      const auto key = tlog::VerifierKey::parse(text);
      return key && key->name() == name_;
    });
    // Each of several daemons with one database has its own key.
    if (was_there && !options_.shares) {
      tell("log_key_lost", fmt::format("{} is missing: a new key signs from now on, and only a "
                                       "stored checkpoint connects it to the old key",
                                       kLogKeyFile));
    }
  }
  signer_ = histories_.back().signer = signers_.front();
  std::vector<std::string> all = known;
  const std::string newest = signers_.front().verifier().text();
  const bool is_new = std::ranges::find(known, newest) == known.end();
  if (is_new) all.insert(all.begin(), newest);
  std::string lines;
  for (const std::string& key : all) lines += key + "\n";
  verifier_keys_.set(std::make_shared<const std::string>(std::move(lines)));
  if (!is_new) return {};
  return database_.writer().wait([&](Stores& stores) {
    stores.log.set_name(name_);
    stores.log.add_key(newest, clock_.now().nanoseconds);
  });
}

/// Keys of other histories stay stored: they sign records that a centre lacks.
Result<void> LogService::write_keys() const {
  std::vector<tlog::SigningKey> all = signers_;
  all.insert(all.end(), older_.begin(), older_.end());
  return write_log_keys(options_.directory, all);
}

/// Keeps a file that does not belong to the database.
void LogService::set_aside(std::string_view name, std::string_view why) {
  const auto aside = fmt::format("{}.{}", name, clock_.now().nanoseconds / 1'000'000'000);
  std::error_code failure;
  std::filesystem::rename(options_.directory / name, options_.directory / aside, failure);
  tell("log_file_set_aside",
       failure ? fmt::format("{} is {}, and cannot be renamed: {}", name, why, failure.message())
               : fmt::format("{} is {}: it was renamed to {}", name, why, aside));
}

/// The root of the first leaves. Those after the stored tree are appended: it may be shorter after
/// a power failure.
Result<tlog::Hash> LogService::root_of(const TreeNames& tree, std::uint64_t size) const {
  return database_.readers().wait([&](const Stores& stores) {
    const bool is_stored = tree.file == kCheckpointFile;
    LogReader log = reader(stores, is_stored ? 0 : LogReader::kChanges);
    const auto stored = static_cast<std::uint64_t>(stores.log.state().size);
    tlog::Frontier frontier = log.frontier(is_stored ? std::min(size, stored) : size);
    const auto begin = static_cast<std::int64_t>(frontier.size());
    for (const tlog::Hash& leaf : log.leaves(begin, static_cast<std::int64_t>(size) - begin)) {
      frontier.append(leaf);
    }
    return frontier.root();
  });
}

/// The finding of a tree's checkpoint in the folder against the database, which has so many leaves
/// of it; the file is set aside then.
std::optional<std::string> LogService::told_by(const TreeNames& tree, std::int64_t leaves,
                                               const Loaded& loaded) {
  const auto note = read_small_file(options_.directory / tree.file);
  if (!note) {
    set_aside(tree.file, "unreadable");
    return note.error().message;
  }
  if (!*note || (*note)->empty()) return std::nullopt;
  if (!tlog::parse_checkpoint(**note)) {  // for example cut by a power failure
    set_aside(tree.file, "not a checkpoint");
    return std::nullopt;
  }
  const auto kept = tlog::open_checkpoint(**note, tree.keys(loaded.keys));
  // A branch that was not signed yet when the daemon ended.
  const auto is_former = [&](const auto& ended) {
    return kept && kept->origin == tree.name(ended.name);
  };
  if (std::ranges::any_of(loaded.branches, is_former)) return std::nullopt;
  if (!kept || kept->origin != tree.name(*loaded.state.name)) {
    // A service that joins others after it was used with another database.
    const bool is_new_here =
        options_.shares &&
        !name_in_folder(options_.directory, digits_of_origin(loaded.state.origin));
    set_aside(tree.file, "of another log or key");
    if (is_new_here) return std::nullopt;
    return "the folder has signed another log than the database's";
  }
  if (kept->size <= static_cast<std::uint64_t>(leaves)) {
    const auto root = root_of(tree, kept->size);
    if (!root || *root == kept->root) return std::nullopt;
    set_aside(tree.file, "of other content than the database's");
    return fmt::format("this folder has signed other {} under this name than the database has",
                       tree.leaves);
  }
  set_aside(tree.file, "newer than the database");
  return fmt::format("this folder has signed {} {}, and the database has {}", kept->size,
                     tree.leaves, leaves);
}

std::optional<std::string> LogService::told_by_checkpoint(const Loaded& loaded) {
  auto told = told_by(kTreeOfMeasurements, loaded.rows, loaded);
  auto of_changes = told_by(kTreeOfChanges, loaded.changes, loaded);
  return told ? told : of_changes;
}

/// Returns the reason why the next ids may already have been given out; none if they cannot.
std::optional<std::string> LogService::why_to_branch(Loaded& loaded) {
  if (!loaded.state.name) {
    loaded.state.name = name_in_folder(options_.directory, digits_of_origin(loaded.state.origin));
    if (!loaded.state.name) return std::nullopt;  // the first start
    return "the folder has signed this log, and the database has lost its beginning";
  }
  if (auto told = told_by_checkpoint(loaded)) return told;
  if (loaded.takes_name(options_)) return fmt::format("origin-name is {}", options_.name);
  if (loaded.is_copy) return "the database is a copy that `backup` made";
  if (loaded.forked && options_.shares) return loaded.forked;
  if (loaded.kept_place.value_or(loaded.place) != loaded.place) {
    return fmt::format(
        "the database was restored or moved: it was at {} (server, database, first row, timeline), "
        "and is at {}",
        *loaded.kept_place, loaded.place);
  }
  if (!options_.ask_centre) return std::nullopt;
  const auto there = options_.ask_centre(digits_of_origin(loaded.state.origin));
  if (!there) return "the centre did not return its size of this log";
  if (there->rows > loaded.rows) {
    return fmt::format("the centre has {} measurements of this log, and the database has {}",
                       there->rows, loaded.rows);
  }
  if (there->is_branched) return "the centre has a branch of this log, which the database lacks";
  const auto has_note = database_.readers().wait([&](const Stores& stores) {
    return there->note == 0 || !stores.notes.own_after(there->note - 1, 1).empty();
  });
  if (has_note && !*has_note) return "the centre has notes of this log that the database lacks";
  if (!loaded.centre || *loaded.centre == there->centre) return std::nullopt;
  return fmt::format("the centre has begun {} after {}, and may have lost measurements",
                     there->centre, *loaded.centre);
}

Result<void> LogService::branch(const Loaded& loaded, const std::string& why) {
  std::array<std::uint8_t, 16> origin{};
  std::random_device random;
  for (std::uint8_t& byte : origin) byte = static_cast<std::uint8_t>(random());
  const std::string& before = *loaded.state.name;
  const std::string name = name_of(loaded.takes_name(options_) ? options_.name : middle_of(before),
                                   digits_of_origin(origin));
  const auto begun = TRY(database_.writer().wait([&](Stores& stores) {
    // Another daemon may have been first.
    const auto state = stores.log.state();
    if (state.origin != loaded.state.origin) return false;
    if (!state.name) stores.log.set_name(before);
    if (options_.shares) stores.log.set_mark(Mark::Place, stores.log.place());
    stores.log.begin_branch(stores.measurements.log_size(), origin, name);
    return true;
  }));
  if (begun) {
    tell("log_branched", fmt::format("{} continues as {} after {} measurements, which keep their "
                                     "ids; later ids end with {}: {}",
                                     before, name, loaded.rows, digits_of_origin(origin), why));
  }
  return {};
}

}  // namespace fitgauge::app
