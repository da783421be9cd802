#include "plant/folder/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>

#include "plant/lsv2/link/descriptor.hpp"

namespace fitgauge::connections {

bool write_whole_file(const std::filesystem::path& path, std::string_view text) {
  const std::string beside =
      (path.parent_path() / ("." + path.filename().string() + ".part")).string();
  const control_link::Descriptor file(
      open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0644));
  if (file.get() < 0) return false;
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t count = write(file.get(), text.data() + at, text.size() - at);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    at += static_cast<std::size_t>(count);
  }
  if (fsync(file.get()) != 0 || std::rename(beside.c_str(), path.c_str()) != 0) return false;
  // Some file systems of a network cannot do this, and need it not.
  const control_link::Descriptor folder(
      open(path.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() >= 0) fsync(folder.get());
  return true;
}

}  // namespace fitgauge::connections
