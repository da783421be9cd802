#include "db/sqlite/data_directory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "db/sqlite/database_file.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store::sqlite {
namespace {

/// Whether a system call may have failed: only then errno is valid.
bool is_of_the_system(int code) {
  const int primary = code & 0xFF;
  return primary == SQLITE_IOERR || primary == SQLITE_FULL || primary == SQLITE_CANTOPEN ||
         primary == SQLITE_READONLY || primary == SQLITE_PERM;
}

std::filesystem::path file_of(sqlite3* handle) {
  const char* const name = handle == nullptr ? nullptr : sqlite3_db_filename(handle, "main");
  return name == nullptr ? "" : name;
}

/// The errno of creating a file next to this one.
std::optional<int> error_of_creating(const std::filesystem::path& file) {
  if (file.empty()) return std::nullopt;
  const Descriptor nameless(
      ::open(folder_of(file).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
  return nameless.is_open() || errno == EOPNOTSUPP ? std::nullopt : std::optional(errno);
}

/// The errno of writing to this file, or next to it.
std::optional<int> error_of_writing(const std::filesystem::path& file) {
  if (file.empty()) return std::nullopt;
  return ::access(file.c_str(), W_OK) != 0 ? std::optional(errno) : error_of_creating(file);
}

/// `storage: disk I/O error (SQLite code 778, errno 27: File too large)`
std::string describe(sqlite3* handle, int code, int system_error, std::string_view doing) {
  std::string text = fmt::format("{}: {}", doing, sqlite3_errstr(code));
  if (handle != nullptr) {
    const std::string_view message = sqlite3_errmsg(handle);
    if (message != sqlite3_errstr(code)) text += fmt::format(": {}", message);
  }
  text += fmt::format(" (SQLite code {}", code);
  if (is_of_the_system(code) && system_error != 0) {
    text += fmt::format(", errno {}: {}", system_error, std::strerror(system_error));
  }
  return text + ")";
}

}  // namespace

void throw_failure(sqlite3* handle, int code, std::string_view doing) {
  // SQLite loses the number if a commit fails, so the last call's errno is used.
  const int last_error = errno;
  const int kept = handle == nullptr ? 0 : sqlite3_system_errno(handle);
  int system_error = kept != 0 ? kept : last_error;
  // If a file cannot be created, SQLite tries to open it for reading, and reports that error.
  if ((code & 0xFF) == SQLITE_CANTOPEN && system_error == ENOENT) {
    system_error = error_of_creating(file_of(handle)).value_or(system_error);
  }
  // SQLite has opened the file for reading then, and forgotten why.
  if ((code & 0xFF) == SQLITE_READONLY) {
    system_error = error_of_writing(file_of(handle)).value_or(system_error);
  }
  const std::string what = describe(handle, code, system_error, doing);
  switch (code & 0xFF) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB: throw StorageFailure({ErrorCode::StorageCorrupt, what});
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_PROTOCOL:
    case SQLITE_NOMEM:
    case SQLITE_INTERRUPT: throw StorageFailure({ErrorCode::StorageUnavailable, what});
    default: throw std::logic_error(what);
  }
}

}  // namespace fitgauge::store::sqlite

namespace fitgauge::store {
namespace {

Descriptor open_file(const std::filesystem::path& path, int flags) {
  return Descriptor(::open(path.c_str(), flags | O_NONBLOCK | O_CLOEXEC, 0640));
}

Error system_error(std::string_view doing, const std::filesystem::path& path) {
  return {ErrorCode::StorageUnavailable,
          fmt::format("cannot {} {}: {}", doing, path.string(), std::strerror(errno))};
}

constexpr std::array<const char*, 2> kLogSuffixes{"-wal", "-shm"};

Error not_regular(const std::filesystem::path& file) {
  return {ErrorCode::StorageUnavailable,
          fmt::format("{} is not a regular file: move it away", file.string())};
}

/// Gives files that root makes in the folder of a service's user to that user, who opens them
/// later.
bool give_to_owner_of_folder(const Descriptor& descriptor, const std::filesystem::path& file) {
  if (::geteuid() != 0) return true;
  struct stat folder {};
  return ::stat(folder_of(file).c_str(), &folder) == 0 &&
         ::fchown(descriptor.get(), folder.st_uid, folder.st_gid) == 0;
}

/// SQLite's header: the first 16 bytes and the application id at 68, big-endian.
constexpr std::size_t kHeaderSize = 100;
using Header = std::array<unsigned char, kHeaderSize>;

std::string_view magic_of(const Header& header) {
  return {reinterpret_cast<const char*>(header.data()), 16};
}

std::uint32_t application_id_of(const Header& header) {
  return std::uint32_t{header[68]} << 24U | std::uint32_t{header[69]} << 16U |
         std::uint32_t{header[70]} << 8U | std::uint32_t{header[71]};
}

}  // namespace

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

Result<DirectoryLock> DirectoryLock::acquire(const std::filesystem::path& directory) {
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  if (failure) {
    errno = failure.value();
    return system_error("create the data directory", directory);
  }
  const std::filesystem::path file = directory / "fitgauge.lock";
  Descriptor descriptor = open_file(file, O_RDWR | O_CREAT);
  if (!descriptor.is_open() || !give_to_owner_of_folder(descriptor, file)) {
    return system_error("write to the data directory:", file);
  }
  if (::flock(descriptor.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) return system_error("lock", file);
    return Error{
        ErrorCode::DatabaseInUse,
        fmt::format("{} is in use by another fitgauged: stop it, or choose another data directory",
                    directory.string())};
  }
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) return system_error("look at", file);
  if (!S_ISREG(status.st_mode)) return not_regular(file);
  return DirectoryLock(std::move(descriptor), FileIdentity{file, status.st_dev, status.st_ino});
}

Result<FileIdentity> FileIdentity::of(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return system_error("look at", file);
  return FileIdentity{file, status.st_dev, status.st_ino};
}

Result<void> FileIdentity::check() const {
  const auto now = of(path_);
  if (now && now->device_ == device_ && now->inode_ == inode_) return {};
  return Error{ErrorCode::StorageUnavailable,
               fmt::format("{} was {} while the service used it: the service stores nothing now. "
                           "Put the file back, or restart the service",
                           path_.string(), now ? "replaced" : "removed")};
}

void LogFiles::remember() {
  const std::lock_guard lock(mutex_);
  files_.clear();
  for (const std::string_view suffix : kLogSuffixes) {
    if (const auto file = FileIdentity::of(with_suffix(database_, suffix))) files_.push_back(*file);
  }
}

void LogFiles::forget() {
  const std::lock_guard lock(mutex_);
  files_.clear();
}

Result<void> LogFiles::check() const {
  const std::lock_guard lock(mutex_);
  for (const FileIdentity& file : files_) TRY(file.check());
  return {};
}

bool LogFiles::is_log_gone() const {
  struct stat status {};
  const auto log = with_suffix(database_, kLogSuffixes.front());
  return ::stat(log.c_str(), &status) != 0 ? errno == ENOENT : status.st_size == 0;
}

Result<void> check_kinds(const std::filesystem::path& database) {
  for (const char* const suffix : {"", "-journal", kLogSuffixes[0], kLogSuffixes[1]}) {
    const std::filesystem::path file = with_suffix(database, suffix);
    struct stat status {};
    if (::stat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) return not_regular(file);
  }
  return {};
}

Result<void> inspect_file(const std::filesystem::path& file, Access access) {
  const Descriptor descriptor = open_file(file, access == Access::Serve ? O_RDWR : O_RDONLY);
  if (!descriptor.is_open()) return system_error("open", file);
  Header header{};
  const ssize_t size = ::pread(descriptor.get(), header.data(), header.size(), 0);
  if (size < 0) return system_error("read", file);
  const auto foreign = [&](std::string_view what) {
    return Error{ErrorCode::DatabaseForeign,
                 fmt::format("{} {}, and is unchanged: restore a backup, or move the file away to "
                             "start with a new database",
                             file.string(), what)};
  };
  using namespace std::string_view_literals;
  if (size == 0) return foreign("is empty");
  if (magic_of(header) != "SQLite format 3\0"sv) return foreign("is not a database");
  if (application_id_of(header) != std::uint32_t{sqlite::kApplicationId}) {
    return foreign("is not a fitgauge database");
  }
  return {};
}

void close_to_others(const std::filesystem::path& database) {
  using std::filesystem::perms;
  for (const std::string_view suffix : {"", kLogSuffixes[0], kLogSuffixes[1]}) {
    std::error_code ignored;
    std::filesystem::permissions(with_suffix(database, suffix), perms::others_all,
                                 std::filesystem::perm_options::remove, ignored);
  }
}

Result<void> reserve_name(const std::filesystem::path& file) {
  const Descriptor descriptor = open_file(file, O_WRONLY | O_CREAT | O_EXCL);
  if (descriptor.is_open() && give_to_owner_of_folder(descriptor, file)) return {};
  return system_error("create", file);
}

Result<void> rename_to_new(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return {};
  // Some network file systems cannot: link() also fails if the name exists.
  if (errno == EINVAL && ::link(from.c_str(), to.c_str()) == 0 && ::unlink(from.c_str()) == 0) {
    return {};
  }
  return system_error("create", to);
}

Result<void> sync_file(const std::filesystem::path& file) {
  const Descriptor content = open_file(file, O_RDONLY);
  if (!content.is_open() || ::fsync(content.get()) != 0) return system_error("write", file);
  const std::filesystem::path parent = folder_of(file);
  const Descriptor directory = open_file(parent, O_RDONLY | O_DIRECTORY);
  if (!directory.is_open() || ::fsync(directory.get()) != 0) return system_error("write", parent);
  return {};
}

}  // namespace fitgauge::store
