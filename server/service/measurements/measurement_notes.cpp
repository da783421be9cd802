#include "service/measurements/measurement_notes.hpp"

#include <fmt/format.h>

namespace fitgauge::app {
namespace {

std::string note_id_text(std::int64_t id, std::string_view origin) {
  return fmt::format("n{}-{}", id, origin);
}

}  // namespace

void append_note(store::Stores& stores, std::int64_t row, std::string_view origin, Note& note) {
  const std::int64_t id = stores.notes.append({.measurement = row,
                                               .cause = note.cause,
                                               .measure = note.measure,
                                               .text = note.text,
                                               .operator_id = note.operator_id,
                                               .caller = note.caller,
                                               .received_at_ns = note.received_at.nanoseconds});
  note.id = note_id_text(id, origin);
}

std::vector<Note> notes_of(const store::Stores& stores, std::int64_t row,
                           const std::string& measurement, std::string_view origin) {
  std::vector<Note> notes;
  for (store::Note& note : stores.notes.list(row)) {
    notes.push_back({.id = note_id_text(note.id, origin),
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
