#include "service/log/log_forwarding.hpp"

#include "db/store/database.hpp"
#include "service/log/log_keys.hpp"
#include "service/log/log_reader.hpp"
#include "service/measurements/measurement_storage.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

constexpr std::size_t kDigitsOfName = 8;

/// Whether a log of this name is of that origin: `fitgauge/NAME/` and its first eight digits.
bool is_name_of(std::string_view name, std::string_view origin) {
  return name.starts_with("fitgauge/") &&
         name.ends_with(fmt::format("/{}", origin.substr(0, kDigitsOfName)));
}

Error invalid(std::size_t row, std::string_view what) {
  return {ErrorCode::LogRecordInvalid, fmt::format("row {} of the batch {}", row + 1, what)};
}

/// The row in the batch of the record with this number, if it has one.
std::optional<std::size_t> row_in(const ForwardedBatch& batch, std::int64_t number) {
  const auto found = std::lower_bound(batch.rows.begin(), batch.rows.end(), number,
                                      [](const ForwardedBatch::Row& row, std::int64_t wanted) {
                                        return row.measurement.id < wanted;
                                      });
  if (found == batch.rows.end() || found->measurement.id != number) return std::nullopt;
  return static_cast<std::size_t>(found - batch.rows.begin());
}

}  // namespace

/// The state of a batch's log at this centre.
struct LogIntake::Known {
  std::int64_t number = 0;  ///< 0: nothing yet
  std::optional<store::OriginsStore::Base> base{};
  Head head{.size = 0, .root = tlog::empty_root()};
  std::vector<tlog::VerifierKey> keys{};
  std::vector<tlog::VerifierKey> new_keys{};  ///< that this batch has brought
  tlog::Frontier before{};                    ///< of the rows before the batch
  std::optional<tlog::Hash> root_at_end{};    ///< end of the batch within the stored rows
  bool lacks_notes = false;                   ///< of notes before those of the batch
};

/// The result of the tree for a batch.
struct LogIntake::Judged {
  Outcome outcome = Outcome::Taken;
  std::vector<tlog::Hash> leaves{};
  std::vector<store::LogStore::Node> nodes{};
  tlog::Hash root{};
};

Result<LogIntake::Answer> LogIntake::take(const ForwardedBatch& batch) {
  if (!is_origin_digits(batch.origin) || batch.from < 1 || batch.rows.size() > kMostRows) {
    return Error{ErrorCode::RequestInvalid,
                 fmt::format("an origin must have {} hexadecimal digits, a place must be 1 or "
                             "more, and a batch must have at most {} rows",
                             kDigitsOfOrigin, kMostRows)};
  }
  auto known = TRY(read(batch));
  TRY(trust(batch, known));
  if (batch.rows.empty() && batch.notes.empty()) {
    return Error{ErrorCode::RequestInvalid, "the batch has no record and no note"};
  }
  if (batch.from > static_cast<std::int64_t>(known.head.size) + 1 || known.lacks_notes)
    return Answer{.outcome = Outcome::Elsewhere, .head = known.head};
  auto judged = TRY(judge_tree(batch, known));
  if (judged.outcome == Outcome::Forked) fork(batch, known);
  if (judged.outcome != Outcome::Taken)
    return Answer{.outcome = judged.outcome, .head = known.head};
  TRY(check_rows(batch));
  TRY(prepare(batch, known));
  const auto stored = TRY(database_.writer().wait(
      [&](Stores& stores) { return store_rows(stores, batch, known, judged); }));
  if (!stored) {  // another batch of this log was faster
    const auto now = TRY(read(batch));
    return Answer{.outcome = Outcome::Elsewhere, .head = now.head};
  }
  tell_branch(batch, known);
  for (const tlog::VerifierKey& key : known.new_keys) {
    tell_("log_origin_key", fmt::format("{} signs with {} from now on", key.name(), key.text()));
  }
  return Answer{.outcome = Outcome::Taken,
                .head = {.size = known.before.size() + batch.rows.size(), .root = judged.root}};
}

Result<LogIntake::Known> LogIntake::read(const ForwardedBatch& batch) const {
  return database_.readers().wait([&](const Stores& stores) -> Result<Known> {
    Known known;
    const auto origin = stores.origins.find(batch.origin);
    const auto behind = parse_note_id(batch.notes_after, origins_);
    known.lacks_notes = !batch.notes_after.empty() &&
                        (!behind || stores.notes.newest_of(behind->origin) < behind->number);
    TRY(read_base(stores, batch, known));
    if (!origin) return known;
    known.number = origin->number;
    for (const std::string& text : stores.origins.keys(origin->number)) {
      auto key = TRY(tlog::VerifierKey::parse(text));
      known.keys.push_back(std::move(key));
    }
    if (origin->checkpoint.empty() && origin->first_row) {
      return Error{ErrorCode::RequestInvalid,
                   fmt::format("{} is the centre of this folder and cannot also be a station of it",
                               batch.origin)};
    }
    if (origin->checkpoint.empty()) return known;
    const auto checkpoint = TRY(tlog::parse_checkpoint(origin->checkpoint));
    known.head = {.size = checkpoint.size, .root = checkpoint.root};
    const auto before = static_cast<std::uint64_t>(batch.from - 1);
    if (before > known.head.size) return known;
    LogReader reader(stores, row_names(tables_, origins_), origin->number);
    known.before = reader.frontier(before);
    const std::uint64_t end = before + batch.rows.size();
    if (end <= known.head.size) known.root_at_end = reader.frontier(end).root();
    return known;
  });
}

/// A branch begins with the rows of its base that are here, even if it names more.
Result<void> LogIntake::read_base(const Stores& stores, const ForwardedBatch& batch,
                                  Known& known) const {
  if (batch.base.origin.empty()) return {};
  const auto base = stores.origins.find(batch.base.origin);
  if (!base || base->checkpoint.empty()) return {};
  known.base = {.origin = base->number, .size = batch.base.size};
  if (const auto origin = stores.origins.find(batch.origin)) {
    const auto stored = stores.origins.base(origin->number);
    if (!stored || stored->origin != known.base->origin || stored->size != batch.base.size) {
      return Error{ErrorCode::RequestInvalid,
                   fmt::format("{} is not a branch of {} after {} rows", batch.origin,
                               batch.base.origin, batch.base.size)};
    }
  }
  const auto there = static_cast<std::uint64_t>(std::min(base->size, batch.base.size));
  auto frontier = LogReader(stores, row_names(tables_, origins_), base->number).frontier(there);
  known.head = {.size = there, .root = frontier.root()};
  if (there == static_cast<std::uint64_t>(batch.from - 1)) known.before = frontier;
  return {};
}

/// Adds the keys that the batch brings with it: the first one on trust, each further one signed for
/// by one before it.
Result<void> LogIntake::trust(const ForwardedBatch& batch, Known& known) const {
  const auto key = TRY(tlog::VerifierKey::parse(batch.key));
  if (origins_.number(batch.origin, 0) == 0) {
    return Error{ErrorCode::LogForked,
                 fmt::format("{} is the log of this centre itself: one of the two folders is a "
                             "copy of the other. Start the station with an empty folder",
                             key.name())};
  }
  if (!is_name_of(key.name(), batch.origin)) {
    return Error{ErrorCode::LogKeyUnknown,
                 fmt::format("{} is not a key of the origin {}", key.name(), batch.origin)};
  }
  const auto add = [&known](const tlog::VerifierKey& next) {
    known.keys.push_back(next);
    known.new_keys.push_back(next);
  };
  const auto is_known = [&known](const tlog::VerifierKey& wanted) {
    return std::ranges::find(known.keys, wanted) != known.keys.end();
  };
  if (known.keys.empty()) add(key);
  // Notes may be in any order: the key of a signature can come from another note.
  for (bool more = true; more;) {
    more = false;
    for (const std::string& note : batch.hand_overs) {
      const auto next = next_key_of(note);
      if (!next || is_known(*next) || next->name() != known.keys.front().name()) continue;
      if (!tlog::open_note(note, known.keys) || !tlog::open_note(note, {&*next, 1})) continue;
      add(*next);
      more = true;
    }
  }
  if (is_known(key)) return {};
  return Error{ErrorCode::LogKeyUnknown,
               fmt::format("{} has a new key without a checkpoint that both keys signed: {}",
                           key.name(), batch.key)};
}

/// Compares the batch with its checkpoint and with the stored rows.
Result<LogIntake::Judged> LogIntake::judge_tree(const ForwardedBatch& batch,
                                                const Known& known) const {
  const auto checkpoint = TRY(tlog::open_checkpoint(batch.checkpoint, known.keys));
  const std::uint64_t end = known.before.size() + batch.rows.size();
  if (checkpoint.origin != known.keys.front().name() || checkpoint.size != end) {
    return Error{ErrorCode::RequestInvalid,
                 fmt::format("the checkpoint covers {} rows of {}, but the batch ends at {} of {}",
                             checkpoint.size, checkpoint.origin, end, known.keys.front().name())};
  }
  Judged judged;
  const auto is_other = [&](const tlog::Hash& here, const tlog::Hash& there) {
    if (here != there) judged.outcome = Outcome::Forked;
  };
  if (known.root_at_end) is_other(*known.root_at_end, checkpoint.root);
  tlog::Frontier grown = known.before;
  judged.leaves.reserve(batch.rows.size());
  bool fits = true;
  for (const ForwardedBatch::Row& row : batch.rows) {
    judged.leaves.push_back(tlog::leaf_hash(row.record));
    append_leaf(grown, judged.leaves.back(), judged.nodes);
    if (grown.size() == known.head.size) fits = grown.root() == known.head.root;
  }
  judged.root = grown.root();
  if (known.root_at_end) {  // all of it is already here, or contradicts the records here
    if (judged.outcome == Outcome::Taken && !batch.rows.empty()) {
      judged.outcome = Outcome::Elsewhere;
    }
    return judged;
  }
  if (judged.root != checkpoint.root) {
    return Error{ErrorCode::LogRootMismatch,
                 fmt::format("the rows do not match the root that {} has signed for {} rows: they "
                             "were altered, or earlier rows differ here",
                             checkpoint.origin, checkpoint.size)};
  }
  if (!fits) judged.outcome = Outcome::Forked;
  if (fits && known.before.size() != known.head.size) judged.outcome = Outcome::Elsewhere;
  return judged;
}

/// A row is accepted only if this version reads all of it and writes the same text again.
Result<void> LogIntake::check_rows(const ForwardedBatch& batch) const {
  std::int64_t before = batch.from - 1;
  for (std::size_t i = 0; i < batch.rows.size(); ++i) {
    const Measurement& m = batch.rows[i].measurement;
    if (m.origin != batch.origin) return invalid(i, "has the id of another folder");
    if (m.id <= before || m.id < batch.from + static_cast<std::int64_t>(i)) {
      return invalid(i, "has an id that does not follow the previous id");
    }
    before = m.id;
    if (m.corrected_elsewhere &&
        !origins_.number(m.corrected_elsewhere->digits, *m.correction_of) &&
        m.corrected_elsewhere->digits != batch.origin) {
      return invalid(i, "corrects a record of a folder that is not known here");
    }
    if (const std::string_view finding = finding_in(m, batch.rows[i].record); !finding.empty()) {
      return invalid(i, finding);
    }
  }
  return {};
}

/// Numbers the table revisions and the folder, each in a commit before the rows, so that every
/// reader of a row knows their names.
Result<void> LogIntake::prepare(const ForwardedBatch& batch, Known& known) {
  std::set<std::string_view> revisions;
  for (const auto& row : batch.rows) revisions.insert(row.measurement.table_revision);
  TRY(tables_.number_revisions(std::move(revisions)));
  if (known.number != 0) return {};
  TRY(database_.writer().wait([&](Stores& stores) {
    const auto found = stores.origins.find(batch.origin);
    known.number = found ? found->number : stores.origins.add(batch.origin);
    if (!found && known.base) {
      stores.origins.set_base(known.number, *known.base);
      stores.origins.set_head({.number = known.number, .size = known.base->size});
    }
  }));
  origins_.remember(known.number, batch.origin);
  return {};
}

/// @returns false: the log has grown.
Result<bool> LogIntake::store_rows(Stores& stores, const ForwardedBatch& batch, const Known& known,
                                   const Judged& judged) const {
  auto origin = stores.origins.find(known.number);
  if (!origin || (!batch.rows.empty() && origin->size != batch.from - 1)) return false;
  const std::int64_t first = stores.measurements.last_id() + 1;
  std::vector<MeasurementRow> rows;
  for (std::size_t i = 0; i < batch.rows.size(); ++i) {
    const Measurement& m = batch.rows[i].measurement;
    const std::int64_t place = batch.from + static_cast<std::int64_t>(i);
    MeasurementRow& row = rows.emplace_back(app::to_store(m));
    if (!m.table_revision.empty()) row.table_revision = tables_.revision_number(m.table_revision);
    row.id = first + static_cast<std::int64_t>(i);
    row.origin = known.number;
    row.seq = place;
    if (m.id != place) row.number = m.id;
    row.hash = judged.leaves[i];
    if (m.corrected_elsewhere) {
      const std::int64_t number = *m.correction_of;
      const std::int64_t of = *origins_.number(m.corrected_elsewhere->digits, number);
      row.corrected_origin = of;
      const auto in_batch = of == known.number ? row_in(batch, number) : std::nullopt;
      row.correction_of = in_batch  ? std::optional(first + static_cast<std::int64_t>(*in_batch))
                          : of == 0 ? std::optional(number)
                                    : stores.measurements.find_forwarded(of, number);
      if (!row.correction_of || *row.correction_of >= row.id) {
        return invalid(i, "corrects a record that is not here");
      }
    }
    if (rows.size() == kRowsAtATime || i + 1 == batch.rows.size()) {
      stores.measurements.append_forwarded(rows);
      rows.clear();
    }
  }
  for (const auto& answer : batch.answers) stores.idempotency.keep(answer);
  const std::int64_t now = clock_.now().nanoseconds;
  for (const tlog::VerifierKey& key : known.new_keys) {
    stores.origins.add_key(known.number, key.text(), now);
  }
  stores.origins.keep_nodes(known.number, judged.nodes);
  if (!batch.rows.empty()) {
    origin->first_row = origin->first_row.value_or(first);
    origin->size += static_cast<std::int64_t>(batch.rows.size());
    origin->checkpoint = batch.checkpoint;
    stores.origins.set_head(*origin);
  }
  TRY(store_notes(stores, batch, known.number));
  return true;
}

/// Stores new notes on records that are here. They belong to the station's history, to an earlier
/// one or to a branch of these.
Result<void> LogIntake::store_notes(Stores& stores, const ForwardedBatch& batch,
                                    std::int64_t station) const {
  std::set<std::int64_t> histories;
  for (std::int64_t at = station; histories.insert(at).second;) {
    if (const auto base = stores.origins.base(at)) at = base->origin;
  }
  const auto is_of_station = [&](std::int64_t origin) {
    while (!histories.contains(origin)) {
      const auto base = stores.origins.base(origin);
      if (!base) return false;
      origin = base->origin;
    }
    return true;
  };
  for (Note note : batch.notes) {
    const auto there = parse_note_id(note.id, origins_);
    if (!there || !is_of_station(there->origin)) continue;
    if (there->number <= stores.notes.newest_of(there->origin)) continue;
    const auto name = parse_measurement_id(note.measurement, origins_);
    const auto row = name ? existing_row_of(stores, *name, origins_) : name.error();
    if (row) {
      append_note(stores, *row, origins_, note, clock_.now().nanoseconds, *there);
    } else if (name && histories.contains(name->origin)) {
      return row.error();
    }
  }
  return {};
}

void LogIntake::tell_branch(const ForwardedBatch& batch, const Known& known) const {
  if (batch.rows.empty() || !known.base ||
      known.before.size() != static_cast<std::uint64_t>(known.base->size))
    return;
  tell_("log_branched",
        fmt::format("{} continues after {} measurements of {}: an older copy of that folder may "
                    "have been restored. Later measurements of {} stay stored here",
                    known.keys.front().name(), known.base->size, batch.base.origin,
                    batch.base.origin));
}

/// Keeps the signed proof that there are two histories of one log.
void LogIntake::fork(const ForwardedBatch& batch, const Known& known) {
  const auto is_new = database_.writer().wait([&](Stores& stores) {
    return stores.origins.add_fork(known.number, batch.checkpoint, clock_.now().nanoseconds);
  });
  if (!is_new || !*is_new) return;
  tell_("log_forked", fmt::format("{} has two histories: its folder was copied and started twice, "
                                  "or an older copy was restored. The first history continues; the "
                                  "other stays at its station, and its checkpoint is stored here",
                                  known.keys.front().name()));
}

}  // namespace fitgauge::app
