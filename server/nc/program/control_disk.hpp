#pragma once

namespace fitgauge::tabfile {
class TabTable;
}

namespace fitgauge::interpreter {

/// A file of the control's disk: `TNC:\nc_prog\8255\8255.h`. Always absolute and below `TNC:\`,
/// without `.` and `..`; stored as written, compared without regard to (ASCII) case. A value type.
class ControlPath {
 public:
  /// Reads an absolute path; `/` separates as `\` does.
  /// @errors FilePathInvalid: another drive, a path that leaves `TNC:\`, a control character, no
  ///   file name, or more than 255 characters.
  static Result<ControlPath> parse(std::string_view text);

  /// Reads a path as an NC program names it: absolute, or relative to the directory of `program`.
  /// @errors as parse.
  static Result<ControlPath> resolve(std::string_view text, const ControlPath& program);

  const std::string& text() const { return text_; }
  /// Returns the key of a disk, which is equal for all spellings of a file.
  std::string key() const;
  /// Returns the directory with its last `\`: `TNC:\nc_prog\8255\`.
  std::string_view directory() const;
  std::string_view file_name() const;
  /// Returns the path, with `extension` (such as `.H`) if its file name has none.
  ControlPath with_default_extension(std::string_view extension) const;
  /// A file of the same directory. @pre `name` has no separator.
  ControlPath beside(std::string_view name) const;

  friend bool operator==(const ControlPath& a, const ControlPath& b) { return a.key() == b.key(); }

 private:
  explicit ControlPath(std::string text) : text_(std::move(text)) {}

  std::string text_;
};

enum class FileSource : std::uint8_t {
  Stored,  ///< uploaded
  Live,    ///< projected from the tolerance tables
  Run,     ///< written by the run itself
};

/// `stored`, `live`, `run`.
std::string_view word(FileSource source);

/// One revision of a file. The bytes are shared and immutable.
struct ControlFile {
  ControlPath path;                          ///< as stored
  std::shared_ptr<const std::string> bytes;  ///< never null
  /// Changes with the content: path and revision name one content for ever.
  std::string revision;
  FileSource source = FileSource::Stored;
  /// The table in the bytes, if the disk has read it; else null.
  std::shared_ptr<const tabfile::TabTable> table = nullptr;
};

/// The control's disk of a run: read-only. Files that a run writes are in its overlay.
/// Implementations are thread-safe; broken storage throws.
class ControlDisk {
 public:
  ControlDisk& operator=(ControlDisk&&) = delete;  // neither copied nor moved
  virtual ~ControlDisk() = default;

  /// The file, or nothing when there is none.
  virtual std::optional<ControlFile> find(const ControlPath& path) const = 0;
  /// Revision of the file of `find`, without reading its bytes.
  virtual std::optional<std::string> revision(const ControlPath& path) const = 0;
  bool exists(const ControlPath& path) const { return revision(path).has_value(); }

  /// Whether a file is in that directory or below it.
  /// @param directory ends with `\`.
  virtual bool has_directory(std::string_view directory) const = 0;
};

/// A disk in memory. Not to be changed while another thread reads it.
class MemoryDisk final : public ControlDisk {
 public:
  /// Adds or replaces a file.
  void write(const ControlPath& path, std::string bytes);
  /// @pre `path` is valid for ControlPath::parse.
  void write(std::string_view path, std::string bytes);

  std::optional<ControlFile> find(const ControlPath& path) const override;
  std::optional<std::string> revision(const ControlPath& path) const override;
  bool has_directory(std::string_view directory) const override;

 private:
  std::map<std::string, ControlFile> files_;  // by key
};

/// Default files of every directory without a file of that name: 82553_hole.tab and
/// 82553_shaft.tab, from the current tolerance tables.
class ProjectingDisk final : public ControlDisk {
 public:
  struct Projection {
    std::string file_name;
    std::shared_ptr<const std::string> bytes;
    std::string revision;  ///< of the tables it was projected from
    std::shared_ptr<const tabfile::TabTable> table = nullptr;  ///< the same, read already
  };

  /// @param inner must outlive this disk.
  ProjectingDisk(const ControlDisk& inner, std::vector<Projection> projections);

  std::optional<ControlFile> find(const ControlPath& path) const override;
  std::optional<std::string> revision(const ControlPath& path) const override;
  bool has_directory(std::string_view directory) const override;

 private:
  const Projection* projection(const ControlPath& path) const;

  const ControlDisk& inner_;
  std::vector<Projection> projections_;
};

}  // namespace fitgauge::interpreter
