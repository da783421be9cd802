#include "service/measurements/measurement_notes.hpp"

#include <fmt/format.h>

#include "record/origins.hpp"

namespace fitgauge::app {
namespace {

std::string note_id_text(std::int64_t id, const Origins& origins) {
  return fmt::format("n{}-{}", id, origins.own(Counted::Note, id));
}

}  // namespace

void append_note(store::Stores& stores, std::int64_t row, const Origins& origins, Note& note) {
  const std::int64_t id = stores.notes.append({.measurement = row,
                                               .cause = note.cause,
                                               .measure = note.measure,
                                               .text = note.text,
                                               .operator_id = note.operator_id,
                                               .caller = note.caller,
                                               .received_at_ns = note.received_at.nanoseconds});
  note.id = note_id_text(id, origins);
}

std::vector<Note> notes_of(const store::Stores& stores, std::int64_t row,
                           const std::string& measurement, const Origins& origins) {
  std::vector<Note> notes;
  for (store::Note& note : stores.notes.list(row)) {
    notes.push_back({.id = note_id_text(note.id, origins),
                     .measurement = measurement,
                     .cause = std::move(note.cause),
                     .measure = std::move(note.measure),
                     .text = std::move(note.text),
                     .operator_id = std::move(note.operator_id),
                     .caller = std::move(note.caller),
                     .received_at = {note.received_at_ns}});
  }
  return notes;
}

}  // namespace fitgauge::app
