#pragma once

#include "base/clock.hpp"
#include "db/store/on_connection.hpp"

namespace fitgauge::store {

/// Kinds of documents: texts with a name. The codes are stored: never change one, never use one
/// again.
enum class DocumentKind : std::uint8_t {
  Uncertainty = 1,
  GaugeInUse = 2,
  Setup = 3,
  Plan = 4,
  Connection = 5,
  ConnectionProgress = 6,  ///< progress of the connection with that name
  Catalogue = 7,
  Calibration = 8,  ///< of a gauge in use, named by app::calibration_name()
  Study = 9,        ///< of a gauge in use
};
constexpr DocumentKind last_of(DocumentKind) { return DocumentKind::Study; }

struct Document {
  DocumentKind kind = DocumentKind::Uncertainty;
  std::string name{};
  std::string text{};  ///< opaque here
  std::int64_t modified_at_ns = 0;
  std::optional<std::string> caller{};
};

/// Documents by kind and name.
class DocumentsStore : public OnConnection<DocumentsStore> {
 public:
  bool put(const Document& document);  ///< @returns whether it is new
  bool remove(DocumentKind kind, std::string_view name);
  std::optional<Document> find(DocumentKind kind, std::string_view name) const;
  std::vector<Document> list(DocumentKind kind) const;  ///< by name, with their texts
};

/// A file of the control's disk without its content.
struct FileEntry {
  std::string path{};         ///< as last written, with upper and lower case
  std::int64_t revision = 0;  ///< rises with every write and delete of any file
  std::int64_t size = 0;      ///< bytes
  Timestamp modified_at{};
  std::optional<std::string> caller{};
};

struct FileContent : FileEntry {
  std::string content{};
};

/// Arguments of `put`.
struct FileWrite {
  std::string_view path{};
  std::string_view content{};
  std::int64_t modified_at_ns = 0;
  std::optional<std::string_view> caller{};
};

/// The files of the control's disk. Of each the 20 newest revisions stay in the table
/// `file_revisions`, deletions among them. Paths are opaque texts that compare without regard to
/// ASCII case, as on the control.
class FilesStore : public OnConnection<FilesStore> {
 public:
  struct PutOutcome {
    bool created = false;  ///< false: an existing file was replaced
    std::int64_t revision = 0;
  };
  PutOutcome put(const FileWrite& file);

  /// @returns whether there was such a file.
  bool remove(std::string_view path, std::int64_t now_ns, std::optional<std::string_view> caller);

  std::optional<FileEntry> stat(std::string_view path) const;
  std::optional<FileContent> find(std::string_view path) const;
  std::vector<FileEntry> list(std::string_view prefix) const;  ///< by path
};

/// A note of a person about a measurement, its cause or an action; at least one of the texts.
struct Note {
  std::int64_t id = 0;           ///< given by the store
  std::int64_t measurement = 0;  ///< the row it is about
  std::optional<std::string> cause{};
  std::optional<std::string> measure{};
  std::optional<std::string> text{};
  std::optional<std::string> operator_id{};
  std::optional<std::string> caller{};
  std::int64_t received_at_ns = 0;
  // For a note that a station has forwarded:
  std::int64_t origin = 0;  ///< OriginsStore::Origin::number; 0 is this folder
  std::int64_t number = 0;  ///< in the id it got there
};

/// Notes of measurements, kept for ever: the database refuses UPDATE and DELETE.
class NotesStore : public OnConnection<NotesStore> {
 public:
  std::int64_t append(const Note& note);                   ///< @returns its id
  std::vector<Note> list(std::int64_t measurement) const;  ///< oldest first

  /// Returns up to `limit` notes of this folder after the id `after`, on its own records and on
  /// corrections of its centre.
  std::vector<Note> own_after(std::int64_t after, std::int64_t limit) const;
  /// The greatest number of the notes that this origin has forwarded; 0 before the first.
  std::int64_t newest_of(std::int64_t origin) const;
};

struct Event {
  std::int64_t id = 0;
  std::string type{};
  std::string payload{};  ///< opaque here
  Timestamp at{};
};

/// Events for replay, the newest ones only. Ids rise and are never used twice.
class EventsStore : public OnConnection<EventsStore> {
 public:
  std::int64_t append(std::string_view type, std::string_view payload, std::int64_t now_ns);

  std::vector<Event> after(std::int64_t id, std::size_t limit) const;  ///< oldest first
  /// Oldest and newest stored ids; 0 and 0 if there are none. A reader that stopped before `oldest
  /// - 1` has missed events.
  struct Kept {
    std::int64_t oldest = 0;
    std::int64_t newest = 0;
  };
  Kept kept() const;

  /// Deletes the oldest so that at most `keep` remain, up to `limit` of them. @returns how many.
  std::int64_t trim(std::int64_t keep, std::int64_t limit);
};

}  // namespace fitgauge::store
