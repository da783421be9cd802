#include "base/regular_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>

namespace fitgauge {
namespace {

constexpr std::size_t kLongestText = std::size_t{64} << 20;
constexpr std::size_t kPieceOfFile = std::size_t{16} << 10;

Error unreadable(std::string cause) { return {ErrorCode::StorageUnavailable, std::move(cause)}; }
Error system_cause() { return unreadable(std::generic_category().message(errno)); }

}  // namespace

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

}  // namespace fitgauge
