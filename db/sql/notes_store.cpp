#include "db/store/notes_store.hpp"

#include <fmt/format.h>

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store {
namespace {

using sql::Rows;

Note read_note(const Rows& rows) {
  require_sound(rows, 8, kNotes);
  return {.id = rows.get<std::int64_t>(0),
          .measurement = rows.get<std::int64_t>(1),
          .cause = rows.get<std::optional<std::string>>(2),
          .measure = rows.get<std::optional<std::string>>(3),
          .text = rows.get<std::optional<std::string>>(4),
          .operator_id = rows.get<std::optional<std::string>>(5),
          .caller = rows.get<std::optional<std::string>>(6),
          .received_at_ns = rows.get<std::int64_t>(7)};
}

}  // namespace

struct NotesStore::Statements {
  explicit Statements(sql::Connection& c)
      : insert(c, kNotes.insert(c) + " RETURNING id"),
        list(c, fmt::format("SELECT id, {}, {} FROM notes WHERE measurement = ? ORDER BY id",
                            kNotes.columns, kNotes.is_sound(c))) {}

  sql::Statement insert;
  sql::Statement list;
};

NotesStore::NotesStore(sql::Connection& connection)
    : statements_(std::make_unique<Statements>(connection)) {}
NotesStore::~NotesStore() = default;

std::int64_t NotesStore::append(const Note& note) {
  return statements_->insert.returning<std::int64_t>(note.measurement, note.cause, note.measure,
                                                     note.text, note.operator_id, note.caller,
                                                     note.received_at_ns);
}

std::vector<Note> NotesStore::list(std::int64_t measurement) const {
  std::vector<Note> notes;
  for (Rows rows = statements_->list.query(measurement); rows.next();) {
    notes.push_back(read_note(rows));
  }
  return notes;
}

}  // namespace fitgauge::store
