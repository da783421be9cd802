#pragma once

namespace fitgauge {

/// A text that may be a mapped file, whose pages need not stay in memory.
struct FileText {
  static constexpr std::size_t kStretch = std::size_t{1} << 20;

  FileText(std::string_view all = {}, bool mapped = false) : text(all), is_mapped(mapped) {}
  FileText(const std::string& all) : text(all), is_mapped(false) {}

  /// Releases pages of a mapped file; reading them again loads them again.
  void let_go(std::size_t from, std::size_t to) const;

  /// Calls `take` for the first `size` bytes in stretches, and releases each stretch afterwards.
  template <class Take>
  void each_stretch(std::size_t size, const Take& take) const {
    for (std::size_t from = 0; from < size; from += kStretch) {
      const std::size_t to = std::min(size, from + kStretch);
      take(text.substr(from, to - from));
      let_go(from, to);
    }
  }

  std::string_view text;
  bool is_mapped;
};

/// Owns a mapped file, or none.
class MappedFile {
 public:
  MappedFile() = default;
  /// A file as the kernel has it, to read. @errors StorageUnavailable with the cause.
  static Result<MappedFile> open(const std::string& path);
  /// Makes a file of `size` bytes without a name, which ends with its process. None if the file
  /// system of the folder does not support it. @errors StorageUnavailable: its disk is full.
  static Result<MappedFile> unnamed(const std::string& folder, std::size_t size);

  MappedFile(MappedFile&& other) noexcept
      : bytes_(std::exchange(other.bytes_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  MappedFile& operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~MappedFile();

  char* bytes() const { return bytes_; }  ///< null: none
  FileText text() const { return {{bytes_, size_}, true}; }

 private:
  /// @returns none, with errno, if it cannot be mapped.
  MappedFile(int fd, std::size_t size, int protection, int flags);

  char* bytes_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace fitgauge
