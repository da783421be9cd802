#include "db/store/files_store.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store {
namespace {

using sql::Blob;
using sql::Rows;

constexpr std::string_view kEntry =
    "r.path, r.revision, coalesce(length(r.content), 0), r.modified_at, r.caller";
constexpr int kContent = 5;  ///< the column after an entry's
/// Of each file, its deletions among them. Older ones go with the next change.
constexpr int kKeptRevisions = 20;

FileEntry read_entry(const Rows& rows) {
  return {.path = rows.get<std::string>(0),
          .revision = rows.get<std::int64_t>(1),
          .size = rows.get<std::int64_t>(2),
          .modified_at_ns = rows.get<std::int64_t>(3),
          .caller = rows.get<std::optional<std::string>>(4)};
}

std::optional<FileContent> read_file(Rows rows) {
  if (!rows.next()) return std::nullopt;
  require_sound(rows, kContent + 1, kFileRevisions);
  return FileContent{read_entry(rows), std::string(rows.get<Blob>(kContent).bytes)};
}

std::vector<FileEntry> read_entries(Rows rows) {
  std::vector<FileEntry> entries;
  while (rows.next()) entries.push_back(read_entry(rows));
  return entries;
}

}  // namespace

struct FilesStore::Statements {
  explicit Statements(sql::Connection& c)
      : stat(c, fmt::format("SELECT {} FROM files f JOIN file_revisions r USING (revision) "
                            "WHERE f.path_key = ?",
                            kEntry)),
        find(c, fmt::format("SELECT {}, r.content, {} FROM files f JOIN file_revisions r "
                            "USING (revision) WHERE f.path_key = ?",
                            kEntry, kFileRevisions.is_sound(c, "r"))),
        list(c, fmt::format("SELECT {} FROM files f JOIN file_revisions r USING (revision) "
                            "WHERE f.path_key >= ?1 AND substr(f.path_key, 1, length(?1)) = ?1 "
                            "ORDER BY f.path_key",
                            kEntry)),
        insert(c, kFileRevisions.insert(c) + " RETURNING revision"),
        point(
            c,
            "INSERT INTO files (path_key, revision) VALUES (?, ?) ON CONFLICT (path_key) DO UPDATE "
            "SET revision = excluded.revision"),
        unpoint(c, "DELETE FROM files WHERE path_key = ?"),
        forget(c, fmt::format("DELETE FROM file_revisions WHERE path_key = ? AND revision <= "
                              "(SELECT revision FROM file_revisions WHERE path_key = ? "
                              "ORDER BY revision DESC LIMIT 1 OFFSET {})",
                              kKeptRevisions)) {}

  sql::Statement stat;
  sql::Statement find;
  sql::Statement list;
  sql::Statement insert;
  sql::Statement point;
  sql::Statement unpoint;
  sql::Statement forget;
};

FilesStore::FilesStore(sql::Connection& connection)
    : statements_(std::make_unique<Statements>(connection)) {}
FilesStore::~FilesStore() = default;

FilesStore::PutOutcome FilesStore::put(const FileWrite& file) {
  // Else the pages of the large files before it would stay, as many as the cache takes.
  constexpr std::size_t kLarge = std::size_t{256} << 10;
  if (file.content.size() > kLarge) statements_->insert.release_pages();
  const std::string key = ascii_upper(file.path);
  const bool created = !stat(file.path);
  const auto revision = statements_->insert.returning<std::int64_t>(
      file.path, key, Blob{file.content}, file.modified_at_ns, file.caller);
  statements_->point.run(key, revision);
  statements_->forget.run(key, key);
  return {.created = created, .revision = revision};
}

bool FilesStore::remove(std::string_view path, std::int64_t now_ns,
                        std::optional<std::string_view> caller) {
  const std::optional<FileEntry> file = stat(path);
  if (!file) return false;
  const std::string key = ascii_upper(path);
  statements_->insert.returning<std::int64_t>(file->path, key, std::optional<Blob>(), now_ns,
                                              caller);
  statements_->unpoint.run(key);
  statements_->forget.run(key, key);
  return true;
}

std::optional<FileEntry> FilesStore::stat(std::string_view path) const {
  const std::string key = ascii_upper(path);
  Rows rows = statements_->stat.query(key);
  return rows.next() ? std::optional(read_entry(rows)) : std::nullopt;
}

std::optional<FileContent> FilesStore::find(std::string_view path) const {
  const std::string key = ascii_upper(path);
  return read_file(statements_->find.query(key));
}

std::vector<FileEntry> FilesStore::list(std::string_view prefix) const {
  const std::string key = ascii_upper(prefix);
  return read_entries(statements_->list.query(key));
}

}  // namespace fitgauge::store
