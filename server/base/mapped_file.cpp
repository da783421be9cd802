#include "base/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>

#include "base/folder.hpp"

namespace fitgauge {
namespace {

Error failed() { return {ErrorCode::StorageUnavailable, std::generic_category().message(errno)}; }

}  // namespace

void FileText::let_go(std::size_t from, std::size_t to) const {
  static const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  if (!is_mapped || from >= to) return;
  from -= from % page;
  // The mapping is of a file and shared, or never written: its bytes stay in the file.
  ::madvise(const_cast<char*>(text.data()) + from, to - from, MADV_DONTNEED);
}

MappedFile::MappedFile(int fd, std::size_t size, int protection, int flags) {
  void* const bytes = ::mmap(nullptr, size, protection, flags, fd, 0);
  if (bytes == MAP_FAILED) return;
  bytes_ = static_cast<char*>(bytes);
  size_ = size;
}

MappedFile::~MappedFile() {
  if (bytes_ != nullptr) ::munmap(bytes_, size_);
}

Result<MappedFile> MappedFile::open(const std::string& path) {
  const Descriptor file = TRY(open_regular(path));
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) return failed();
  if (status.st_size == 0) return MappedFile();
  MappedFile mapped(file.get(), static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE);
  if (mapped.bytes() == nullptr) return failed();
  return mapped;
}

Result<MappedFile> MappedFile::unnamed(const std::string& folder, std::size_t size) {
  const Descriptor file(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
  if (!file.is_open()) return MappedFile();
  // Allots the whole file now: a full disk would later end the process.
  if (::fallocate(file.get(), 0, 0, static_cast<off_t>(size)) != 0) {
    if (errno == ENOSPC || errno == EDQUOT) return failed();
    return MappedFile();
  }
  return MappedFile(file.get(), size, PROT_READ | PROT_WRITE, MAP_SHARED);
}

}  // namespace fitgauge
