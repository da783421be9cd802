#include "plant/folder/folder_in.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "base/clock.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;

Error unreadable(const std::string& name) {
  return {ErrorCode::StorageUnavailable,
          fmt::format("{} cannot be read: {}", name, std::strerror(errno))};
}

}  // namespace

Look look_of(const struct stat& status) {
  return {.size = status.st_size,
          .changed_ns =
              std::int64_t{status.st_mtim.tv_sec} * kNanosecondsPerSecond + status.st_mtim.tv_nsec,
          .inode = status.st_ino};
}

Result<std::optional<RestingFile>> RestingFile::open(const Folder& folder, const std::string& name,
                                                     const Look& look) {
  auto file = folder.read(name);
  if (!file) return file.error();
  if (!*file) return std::optional<RestingFile>();
  return std::optional(RestingFile(name, **std::move(file), look));
}

Read RestingFile::from_begin() const {
  return [this, at = off_t{0}](std::span<char> into) mutable -> Result<std::size_t> {
    for (;;) {
      const ssize_t count = pread(file_.get(), into.data(), into.size(), at);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return unreadable(name_);
      at += count;
      return static_cast<std::size_t>(count);
    }
  };
}

Result<void> RestingFile::add_to(Sha256& digest) const {
  const Read read = from_begin();
  std::string piece(kPiece, '\0');
  for (;;) {
    const auto count = read(piece);
    if (!count) return count.error();
    if (*count == 0) return {};
    digest.update(std::string_view(piece).substr(0, *count));
  }
}

bool RestingFile::is_unchanged() const {
  struct stat status {};
  return fstat(file_.get(), &status) == 0 && look_of(status) == look_;
}

}  // namespace fitgauge::connections
