#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

namespace fitgauge {

/// Owns a file descriptor; -1 is none.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }

  int get() const { return fd_; }
  bool is_open() const { return fd_ >= 0; }
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_ = -1;
};

/// A folder that others may write into, opened by its descriptor. Names are looked up once, and
/// links are not followed. Never blocks: a FIFO or a device is not a file. All errors are
/// StorageUnavailable and have the path and the cause.
class Folder {
 public:
  static Result<Folder> open(const std::filesystem::path& path);
  /// A folder in this one, created if there is none. @errors also when the name is a link.
  Result<Folder> sub(const std::string& name) const;

  const std::filesystem::path& path() const { return path_; }

  /// Calls `visit` for the names of all entries until it returns false.
  Result<void> list(const std::function<bool(const std::string& name)>& visit) const;
  /// The kind of an entry: of a link itself, not of its target. @returns none if there is none.
  std::optional<struct stat> look(const std::string& name) const;
  /// A regular file, to read. @returns none when there is no entry or another kind of entry.
  Result<std::optional<Descriptor>> read(const std::string& name) const;

  /// Writes `.NAME.part`, syncs it to disk and renames it, so that others see a whole file or none.
  Result<void> write(const std::string& name, std::string_view text) const;
  /// Moves a file into another folder under a name that is free: NAME, NAME.1, NAME.2 and so on.
  Result<void> move(const std::string& name, const Folder& to, const std::string& as) const;
  /// NAME, NAME.1, NAME.2 and so on: the first name without an entry.
  std::string free_name(const std::string& name) const;
  void remove(const std::string& name) const;

  /// Whether entries can be created and removed.
  Result<void> check_writable() const;

 private:
  Folder(Descriptor descriptor, std::filesystem::path path)
      : descriptor_(std::move(descriptor)), path_(std::move(path)) {}

  Error failed(std::string_view doing, const std::string& name) const;

  Descriptor descriptor_;
  std::filesystem::path path_;
};

/// Opens a regular file to read, also by a link. Never blocks: a FIFO or a device is refused.
/// @errors StorageUnavailable with the cause alone.
Result<Descriptor> open_regular(const std::filesystem::path& file);

/// The bytes of a regular file, at most 64 MiB. @errors as open_regular().
Result<std::string> read_regular(const std::filesystem::path& file);

/// The rest of an open file. @errors as read_regular().
Result<std::string> read_all(const Descriptor& file);

/// Writes `FILE.new`, syncs it and renames it: others see a whole file or none. A link or a file of
/// that name is replaced, since others could read it. @errors StorageUnavailable, the cause alone.
Result<void> replace_file(const std::string& file, std::string_view text, mode_t rights);

}  // namespace fitgauge
