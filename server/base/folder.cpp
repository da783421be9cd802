#include "base/folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>

#include <cerrno>

namespace fitgauge {
namespace {

Error failure(std::string_view doing, const std::filesystem::path& path) {
  return Error::of(ErrorCode::StorageUnavailable, "cannot {} {}: {}", doing, path.string(),
                   std::strerror(errno));
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

constexpr std::size_t kLongestText = std::size_t{64} << 20;
constexpr std::size_t kPieceOfFile = std::size_t{16} << 10;

Error unreadable(std::string cause) { return {ErrorCode::StorageUnavailable, std::move(cause)}; }
Error system_cause() { return unreadable(std::generic_category().message(errno)); }

}  // namespace

Error Folder::failed(std::string_view doing, const std::string& name) const {
  return failure(doing, path_ / name);
}

Result<Folder> Folder::open(const std::filesystem::path& path) {
  Descriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.is_open()) return failure("open the folder", path);
  return Folder(std::move(folder), path);
}

Result<Folder> Folder::sub(const std::string& name) const {
  if (mkdirat(descriptor_.get(), name.c_str(), 0777) != 0 && errno != EEXIST)
    return failed("create the folder", name);
  Descriptor folder(
      openat(descriptor_.get(), name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (!folder.is_open()) return failed("open the folder (links are not followed)", name);
  return Folder(std::move(folder), path_ / name);
}

Result<void> Folder::list(const std::function<bool(const std::string& name)>& visit) const {
  const int own = openat(descriptor_.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(own < 0 ? nullptr : fdopendir(own), &closedir);
  if (!entries) {
    const Error error = failure("read the folder", path_);
    if (own >= 0) ::close(own);
    return error;
  }
  for (;;) {
    errno = 0;
    const dirent* const entry = readdir(entries.get());
    if (entry == nullptr && errno != 0) return failure("read the folder", path_);
    if (entry == nullptr || !visit(entry->d_name)) return {};
  }
}

std::optional<struct stat> Folder::look(const std::string& name) const {
  struct stat status {};
  const bool is_there = fstatat(descriptor_.get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
  return is_there ? std::optional(status) : std::nullopt;
}

Result<std::optional<Descriptor>> Folder::read(const std::string& name) const {
  // Without O_NONBLOCK a FIFO waits for a writer.
  Descriptor file(openat(descriptor_.get(), name.c_str(),
                         O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  const bool is_none = errno == ENOENT || errno == ELOOP || errno == ENXIO;
  if (!file.is_open() && is_none) return std::optional<Descriptor>();
  struct stat status {};
  if (!file.is_open() || fstat(file.get(), &status) != 0) return failed("read", name);
  if (!S_ISREG(status.st_mode)) return std::optional<Descriptor>();
  return std::optional(std::move(file));
}

Result<void> Folder::write(const std::string& name, std::string_view text) const {
  const std::string draft = "." + name + ".part";
  remove(draft);
  const Descriptor file(openat(descriptor_.get(), draft.c_str(),
                               O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
  if (!file.is_open()) return failed("create", draft);
  const bool is_written =
      write_all(file.get(), text) && fsync(file.get()) == 0 &&
      renameat(descriptor_.get(), draft.c_str(), descriptor_.get(), name.c_str()) == 0;
  if (!is_written) {
    const Error error = failed("write", name);
    remove(draft);
    return error;
  }
  fsync(descriptor_.get());  // some file systems of a network cannot do this, and need it not
  return {};
}

Result<void> Folder::move(const std::string& name, const Folder& to, const std::string& as) const {
  for (;;) {
    const std::string free = to.free_name(as);
    const int from_folder = descriptor_.get();
    const int to_folder = to.descriptor_.get();
    if (renameat2(from_folder, name.c_str(), to_folder, free.c_str(), RENAME_NOREPLACE) == 0)
      return {};
    if (errno == EEXIST) continue;
    // Some file systems of a network know no flags.
    if (errno == EINVAL && renameat(from_folder, name.c_str(), to_folder, free.c_str()) == 0)
      return {};
    return Error::of(ErrorCode::StorageUnavailable, "{} cannot be moved to {}: {}", name,
                     (to.path_ / free).string(), std::strerror(errno));
  }
}

std::string Folder::free_name(const std::string& name) const {
  std::string free = name;
  for (int number = 1; look(free); ++number) free = fmt::format("{}.{}", name, number);
  return free;
}

void Folder::remove(const std::string& name) const { unlinkat(descriptor_.get(), name.c_str(), 0); }

Result<void> Folder::check_writable() const {
  if (faccessat(descriptor_.get(), ".", W_OK | X_OK, 0) == 0) return {};
  return failure("write into", path_);
}

Result<Descriptor> open_regular(const std::filesystem::path& file) {
  // Without O_NONBLOCK a FIFO waits for a writer.
  Descriptor opened(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  struct stat status {};
  if (!opened.is_open() || ::fstat(opened.get(), &status) != 0) return system_cause();
  if (!S_ISREG(status.st_mode)) return unreadable("it is not a regular file");
  return opened;
}

Result<std::string> read_all(const Descriptor& file) {
  std::string text;
  std::array<char, kPieceOfFile> piece{};
  for (;;) {
    const ssize_t count = ::read(file.get(), piece.data(), piece.size());
    if (count == 0) return text;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return system_cause();
    text.append(piece.data(), static_cast<std::size_t>(count));
    if (text.size() > kLongestText) return unreadable("it has more than 64 MiB");
  }
}

Result<std::string> read_regular(const std::filesystem::path& file) {
  return read_all(TRY(open_regular(file)));
}

Result<void> replace_file(const std::string& file, std::string_view text, mode_t rights) {
  const std::string draft = file + ".new";
  ::unlink(draft.c_str());
  const Descriptor out(  // without O_EXCL a FIFO waits for a reader
      ::open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, rights));
  if (out.is_open() && write_all(out.get(), text) && fsync(out.get()) == 0 &&
      ::rename(draft.c_str(), file.c_str()) == 0) {
    return {};
  }
  const Error cause = system_cause();
  ::unlink(draft.c_str());
  return cause;
}

}  // namespace fitgauge
