#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::store {

namespace sql {
class Connection;
}

/// A file of the control's disk without its content.
struct FileEntry {
  std::string path{};         ///< as it was last written, upper and lower case kept
  std::int64_t revision = 0;  ///< rises with every write and delete of any file
  std::int64_t size = 0;      ///< bytes
  std::int64_t modified_at_ns = 0;
  std::optional<std::string> caller{};
};

struct FileContent {
  FileEntry entry{};
  std::string content{};
};

/// What `put` gets.
struct FileWrite {
  std::string_view path{};
  std::string_view content{};
  std::int64_t modified_at_ns = 0;
  std::optional<std::string_view> caller{};
};

/// The files of the control's disk. Of each the 20 newest revisions stay in the table
/// `file_revisions`, deletions among them. Paths are opaque texts that compare without regard to
/// ASCII case, as on the control.
class FilesStore {
 public:
  explicit FilesStore(sql::Connection& connection);
  ~FilesStore();

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

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
