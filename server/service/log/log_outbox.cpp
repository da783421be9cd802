#include "service/log/log_forwarding.hpp"

#include "db/store/database.hpp"
#include "record/note.hpp"
#include "record/record.hpp"
#include "service/log/log_keys.hpp"
#include "service/log/log_reader.hpp"
#include "service/measurements/measurement_storage.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

constexpr std::int64_t kRowsARead = 500;
constexpr std::int64_t kNotesABatch = 500;

}  // namespace

Result<LogOutbox::Batch> LogOutbox::next(std::int64_t after, std::int64_t most,
                                         std::optional<std::int64_t> noted) const {
  return database_.readers().wait([&](const Stores& stores) {
    const RowNames names = row_names(tables_, log_.origins());
    std::vector<store::Note> notes;
    if (noted) notes = stores.notes.own_after(*noted, kNotesABatch);
    const auto* of_note = notes.empty() ? nullptr : empty_history(notes.front().id);
    const bool is_of_note = of_note != nullptr && of_note->begin <= after;
    if (is_of_note) after = of_note->begin;
    const LogService::History& history = is_of_note ? *of_note : log_.history_of(after + 1);
    Batch batch{.from = after + 1};
    std::int64_t end = std::min(after + most, stores.log.state().size);
    if (history.end) end = std::min(end, *history.end);
    if (!history.signer && end > after) {
      batch.unsigned_to = history.end;
      return batch;
    }
    batch.origin = history.digits;
    if (history.begin > 0) {
      batch.base = log_.history_of(history.begin).digits;
      batch.base_size = history.begin;
    }
    std::optional<std::int64_t> first_row;
    std::int64_t last_row = 0;
    std::size_t bytes = 0;
    for (std::int64_t at = after; at < end && bytes < kMostBytes;) {
      stores.measurements.list_log(
          0, at, std::min(kRowsARead, end - at), [&](const MeasurementRow& row) {
            ++at;
            if (bytes >= kMostBytes) return;
            append_record(batch.records.emplace_back(), from_store(row, names));
            bytes += batch.records.back().size();
            first_row = first_row.value_or(row.id);
            last_row = row.id;
          });
    }
    const std::int64_t place = after + static_cast<std::int64_t>(batch.records.size());
    if (!notes.empty() && history.signer && place > 0) {
      add_notes(stores, place, *noted, std::move(notes), batch);
    }
    if (!first_row && batch.notes.empty()) return batch;
    batch.checkpoint = log_.sign_at(stores, history, static_cast<std::uint64_t>(place));
    batch.key = history.signer->verifier().text();
    batch.hand_overs = log_.hand_overs();
    if (!first_row) return batch;
    stores.idempotency.visit_forwarded(*first_row, last_row,
                                       [&](const auto& kept) { batch.answers.push_back(kept); });
    return batch;
  });
}

/// Returns the history of a note without records, which later notes do not name.
const LogService::History* LogOutbox::empty_history(std::int64_t note) const {
  const auto& history = log_.history_of(log_.origins().own(Counted::Note, note));
  return history.signer && history.end == history.begin ? &history : nullptr;
}

/// @param place number of records of this folder that the centre has with the batch
/// @param notes after that number
void LogOutbox::add_notes(const Stores& stores, std::int64_t place, std::int64_t behind,
                          std::vector<store::Note> notes, Batch& batch) const {
  const Origins& origins = log_.origins();
  // The centre accepts them in their order: notes of a later history follow with its batches.
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  for (const auto& ended : stores.log.branches()) {
    if (digits_of_origin(ended.origin) == batch.origin) last = ended.newest[3];
  }
  for (store::Note& note : notes) {
    const LogService::History* const of = empty_history(note.id);
    if (note.id > last || (of != nullptr && of->digits != batch.origin)) return;
    std::string record;
    stores.measurements.find(note.measurement, [&](const MeasurementRow& row) {
      if (!row.is_forwarded() && row.place_in_log() > place) return;
      const std::int64_t number = row.public_number();
      record = measurement_id_text(number, origins.digits(row.origin.value_or(0), number));
    });
    if (record.empty()) return;
    if (batch.notes.empty() && behind > 0) {
      batch.notes_after = note_id_text(behind, origins.own(Counted::Note, behind));
    }
    batch.last_note = note.id;
    batch.notes.push_back(api::body_json(from_store(std::move(note), record, origins)));
  }
}

bool LogOutbox::is_note_of(std::string_view history, std::int64_t number) const {
  return log_.origins().own(Counted::Note, number) == history;
}

Result<std::optional<bool>> LogOutbox::begins_with(std::int64_t size,
                                                   const tlog::Hash& root) const {
  return database_.readers().wait([&](const Stores& stores) {
    if (size > stores.log.state().size) return std::optional<bool>();
    const auto count = static_cast<std::uint64_t>(size);
    return std::optional(log_.reader(stores).frontier(count).root() == root);
  });
}

Result<std::int64_t> LogOutbox::confirmed(std::string_view centre) const {
  return database_.readers().wait([&](const Stores& stores) {
    const auto forwarded = stores.origins.forwarded();
    return forwarded && forwarded->centre == centre ? forwarded->size : 0;
  });
}

Result<void> LogOutbox::confirm(std::string_view centre, std::int64_t size) const {
  return database_.writer().wait([&](Stores& stores) {
    stores.origins.set_forwarded({.centre = std::string(centre), .size = size});
  });
}

std::string_view LogOutbox::newest_history() const {
  const auto rows =
      database_.readers().wait([](const Stores& stores) { return stores.measurements.log_size(); });
  return log_.history_of(rows ? *rows : std::numeric_limits<std::int64_t>::max()).digits;
}

void LogOutbox::meet(std::string_view centre) const {
  constexpr auto kCentre = store::LogStore::Mark::Centre;
  const auto known =
      database_.readers().wait([](const Stores& stores) { return stores.log.mark(kCentre); });
  if (!known || *known == centre) return;
  static_cast<void>(database_.writer().wait(
      [centre](Stores& stores) { stores.log.set_mark(kCentre, std::string(centre)); }));
}

void LogOutbox::set_forked(const std::optional<std::string>& why) const {
  static_cast<void>(log_.set_forked(why));  // the next call repeats a failed store
}

std::int64_t LogOutbox::committed() const { return database_.writer().counters().own_rows; }

Result<LogOutbox::Waiting> LogOutbox::waiting(std::int64_t confirmed) const {
  return database_.readers().wait([&](const Stores& stores) {
    Waiting waiting{.rows = std::max<std::int64_t>(0, stores.measurements.log_size() - confirmed)};
    stores.measurements.list_log(0, confirmed, 1, [&](const MeasurementRow& row) {
      waiting.oldest = Timestamp{row.received_at_ns};
    });
    return waiting;
  });
}

}  // namespace fitgauge::app
