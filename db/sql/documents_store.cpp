#include "db/store/documents_store.hpp"

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store {
namespace {

using sql::Blob;
using sql::Rows;

constexpr std::string_view kEntry =
    "r.path, r.revision, coalesce(length(r.content), 0), r.modified_at, r.caller";
constexpr int kContent = 5;  ///< the column after an entry's
/// Number of revisions that are kept of each file, with its deletions. The next change removes
/// older ones.
constexpr int kKeptRevisions = 20;

std::vector<Note> read_notes(Rows rows) {
  std::vector<Note> notes;
  while (rows.next()) {
    require_sound(rows, 10, kNotes);
    require_sound(rows, 11, kNoteOrigins);
    notes.push_back(row_of<Note>(rows));
  }
  return notes;
}

std::string select_notes(const sql::Connection& c, std::string_view where) {
  return fmt::format(
      "SELECT id, {}, coalesce(o.origin, 0), coalesce(o.number, 0), {}, CASE WHEN o.note IS NULL "
      "THEN 1 ELSE {} END FROM notes n LEFT JOIN note_origins o ON o.note = n.id WHERE {}",
      kNotes.columns, kNotes.is_sound(c, "n"), kNoteOrigins.is_sound(c, "o"), where);
}

}  // namespace

template <>
struct StatementsOf<DocumentsStore> {
  sql::Connection& c;
  sql::Statement find{c, kDocuments.select(c, "WHERE kind = ? AND name = ?")};
  sql::Statement list{c, kDocuments.select(c, "WHERE kind = ? ORDER BY name")};
  sql::Statement put{c, kDocuments.replace(c)};
  sql::Statement remove{c, "DELETE FROM documents WHERE kind = ? AND name = ? RETURNING 1"};
};

bool DocumentsStore::put(const Document& document) {
  const bool is_new = !find(document.kind, document.name);
  statements().put.run(document.kind, document.name, document.text, document.modified_at_ns,
                       document.caller);
  return is_new;
}

bool DocumentsStore::remove(DocumentKind kind, std::string_view name) {
  return statements().remove.run_counting(kind, name) > 0;
}

std::optional<Document> DocumentsStore::find(DocumentKind kind, std::string_view name) const {
  return read_first<Document>(statements().find.query(kind, name), kDocuments);
}

std::vector<Document> DocumentsStore::list(DocumentKind kind) const {
  return read_all<Document>(statements().list.query(kind), kDocuments);
}

template <>
struct StatementsOf<FilesStore> {
  sql::Connection& c;
  sql::Statement stat{c,
                      fmt::format("SELECT {} FROM files f JOIN file_revisions r USING (revision) "
                                  "WHERE f.path_key = ?",
                                  kEntry)};
  sql::Statement find{c, fmt::format("SELECT {}, r.content, {} FROM files f JOIN file_revisions r "
                                     "USING (revision) WHERE f.path_key = ?",
                                     kEntry, kFileRevisions.is_sound(c, "r"))};
  sql::Statement list{
      c, fmt::format("SELECT {} FROM files f JOIN file_revisions r USING (revision) "
                     "WHERE f.path_key >= ?1 AND substr(f.path_key, 1, length(?1)) = ?1 "
                     "ORDER BY f.path_key",
                     kEntry)};
  sql::Statement insert{c, kFileRevisions.insert(c) + " RETURNING revision"};
  sql::Statement point{
      c,
      "INSERT INTO files (path_key, revision) VALUES (?, ?) ON CONFLICT (path_key) DO UPDATE "
      "SET revision = excluded.revision"};
  sql::Statement unpoint{c, "DELETE FROM files WHERE path_key = ?"};
  sql::Statement forget{c,
                        fmt::format("DELETE FROM file_revisions WHERE path_key = ? AND revision <= "
                                    "(SELECT revision FROM file_revisions WHERE path_key = ? "
                                    "ORDER BY revision DESC LIMIT 1 OFFSET {})",
                                    kKeptRevisions)};
};

FilesStore::PutOutcome FilesStore::put(const FileWrite& file) {
  // Deletes in steps: the pages of large files would fill the cache.
  constexpr std::size_t kLarge = std::size_t{256} << 10;
  if (file.content.size() > kLarge) statements().insert.release_pages();
  const std::string key = ascii_upper(file.path);
  const bool created = !stat(file.path);
  const auto revision = statements().insert.returning<std::int64_t>(
      file.path, key, Blob{file.content}, file.modified_at_ns, file.caller);
  statements().point.run(key, revision);
  statements().forget.run(key, key);
  return {.created = created, .revision = revision};
}

bool FilesStore::remove(std::string_view path, std::int64_t now_ns,
                        std::optional<std::string_view> caller) {
  const std::optional<FileEntry> file = stat(path);
  if (!file) return false;
  const std::string key = ascii_upper(path);
  statements().insert.returning<std::int64_t>(file->path, key, std::optional<Blob>(), now_ns,
                                              caller);
  statements().unpoint.run(key);
  statements().forget.run(key, key);
  return true;
}

std::optional<FileEntry> FilesStore::stat(std::string_view path) const {
  const std::string key = ascii_upper(path);
  return read_first<FileEntry>(statements().stat.query(key));
}

std::optional<FileContent> FilesStore::find(std::string_view path) const {
  const std::string key = ascii_upper(path);
  Rows rows = statements().find.query(key);
  if (!rows.next()) return std::nullopt;
  require_sound(rows, kContent + 1, kFileRevisions);
  return FileContent{row_of<FileEntry>(rows), std::string(rows.get<Blob>(kContent).bytes)};
}

std::vector<FileEntry> FilesStore::list(std::string_view prefix) const {
  const std::string key = ascii_upper(prefix);
  return read_all<FileEntry>(statements().list.query(key));
}

template <>
struct StatementsOf<NotesStore> {
  sql::Connection& c;
  sql::Statement insert{c, kNotes.insert(c) + " RETURNING id"};
  sql::Statement insert_origin{c, kNoteOrigins.insert(c)};
  sql::Statement list{c, select_notes(c, "measurement = ? ORDER BY id")};
  sql::Statement own_after{
      c, select_notes(c,
                      "id > ? AND o.note IS NULL AND EXISTS (SELECT 1 FROM "
                      "measurements m WHERE m.id = n.measurement AND "
                      "(coalesce(m.origin, 0) = 0 OR m.origin IN (SELECT number FROM "
                      "origins WHERE checkpoint = ''))) ORDER BY id LIMIT ?")};
  sql::Statement newest_of{c, "SELECT coalesce(max(number), 0) FROM note_origins WHERE origin = ?"};
};

std::int64_t NotesStore::append(const Note& note) {
  const auto id = statements().insert.returning<std::int64_t>(
      note.measurement, note.cause, note.measure, note.text, note.operator_id, note.caller,
      note.received_at_ns);
  if (note.origin > 0) statements().insert_origin.run(id, note.origin, note.number);
  return id;
}

std::vector<Note> NotesStore::list(std::int64_t measurement) const {
  return read_notes(statements().list.query(measurement));
}

std::vector<Note> NotesStore::own_after(std::int64_t after, std::int64_t limit) const {
  return read_notes(statements().own_after.query(after, limit));
}

std::int64_t NotesStore::newest_of(std::int64_t origin) const {
  return statements().newest_of.returning<std::int64_t>(origin);
}

template <>
struct StatementsOf<EventsStore> {
  sql::Connection& c;
  sql::Statement insert{c, kEvents.insert(c) + " RETURNING id"};
  sql::Statement after{
      c, "SELECT id, type, payload, created_at FROM events WHERE id > ? ORDER BY id LIMIT ?"};
  sql::Statement kept{c,
                      "SELECT coalesce((SELECT min(id) FROM events), 0), "
                      "coalesce((SELECT max(id) FROM events), 0)"};
  // Ids have no gaps, as events are deleted from the oldest on.
  sql::Statement trim{
      c,
      "DELETE FROM events WHERE id IN (SELECT id FROM events "
      "WHERE id <= (SELECT max(id) FROM events) - ?1 ORDER BY id LIMIT ?2) RETURNING 1"};
};

std::int64_t EventsStore::append(std::string_view type, std::string_view payload,
                                 std::int64_t now_ns) {
  return statements().insert.returning<std::int64_t>(type, payload, now_ns);
}

std::vector<Event> EventsStore::after(std::int64_t id, std::size_t limit) const {
  return read_all<Event>(statements().after.query(id, limit));
}

EventsStore::Kept EventsStore::kept() const { return *read_first<Kept>(statements().kept.query()); }

std::int64_t EventsStore::trim(std::int64_t keep, std::int64_t limit) {
  return statements().trim.run_counting(keep, limit);
}

}  // namespace fitgauge::store
