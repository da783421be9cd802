#include "db/sqlite/data_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/descriptor.hpp"
#include "db/sqlite/migrator.hpp"

namespace fitgauge::store {
namespace {

Descriptor open_file(const std::filesystem::path& path, int flags) {
  return Descriptor(::open(path.c_str(), flags | O_CLOEXEC, 0640));
}

Error system_error(std::string_view doing, const std::filesystem::path& path) {
  return {ErrorCode::StorageUnavailable,
          fmt::format("cannot {} {}: {}", doing, path.string(), std::strerror(errno))};
}

/// What root makes in the folder of a service's user belongs to that user, who is to open it later.
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
    return Error{ErrorCode::DatabaseInUse,
                 fmt::format("{} is in use by another fitgauged; stop it, or choose another data "
                             "directory",
                             directory.string())};
  }
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) return system_error("look at", file);
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
  return Error{
      ErrorCode::StorageUnavailable,
      fmt::format("{} was {} while the service had it open: nothing more is stored. Put the "
                  "file back, or end the service and start it again",
                  path_.string(), now ? "replaced" : "removed")};
}

Result<void> inspect_file(const std::filesystem::path& file, Access access) {
  const Descriptor descriptor = open_file(file, access == Access::Serve ? O_RDWR : O_RDONLY);
  if (!descriptor.is_open()) return system_error("open", file);
  Header header{};
  const ssize_t size = ::pread(descriptor.get(), header.data(), header.size(), 0);
  if (size < 0) return system_error("read", file);
  const auto foreign = [&](std::string_view what) {
    return Error{ErrorCode::DatabaseForeign,
                 fmt::format("{} {}; it was left as it is. Restore a backup in its place, or move "
                             "it away to start with a new database",
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
  for (const std::string_view suffix : {"", "-wal", "-shm"}) {
    std::filesystem::path file = database;
    std::error_code ignored;
    std::filesystem::permissions(file += suffix, perms::others_all,
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
  // Some network file systems cannot: link() takes no name that is taken either.
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
