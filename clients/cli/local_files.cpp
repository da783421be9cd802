#include "cli/local_files.hpp"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <iostream>

namespace fitgauge::cli {
namespace {

constexpr std::size_t kReadSize = std::size_t{64} << 10;
constexpr int kMostLinks = 40;  // as Linux follows

Failure failed(const std::string& name, const char* what) {
  return Failure::of(ExitCode::LocalFile, "{}: cannot {}: {}", name, what, std::strerror(errno));
}

namespace fs = std::filesystem;

/// Returns the usual rights of a new file: mkstemp() gives fewer.
mode_t usual_rights() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

/// Name of the temporary file that a signal removes.
std::atomic<const char*> unfinished{nullptr};

void remove_unfinished(int number) {
  if (const char* const name = unfinished) unlink(name);
  signal(number, SIG_DFL);
  raise(number);
}

void remove_at_signals(const char* name) {
  unfinished = name;
  for (const int number : {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM}) {
    const auto before = signal(number, remove_unfinished);
    if (before != SIG_DFL && before != remove_unfinished) signal(number, before);
  }
}

/// Returns whether a path such as /dev/fd/5 names an open descriptor of this process.
bool names_descriptor(const fs::path& path) {
  std::error_code none;
  return fs::equivalent(path.parent_path(), "/proc/self/fd", none);
}

/// Returns the file, which may be missing, or the open descriptor that links lead to.
fs::path followed(fs::path path) {
  std::error_code none;
  for (int links = 0; links < kMostLinks && !names_descriptor(path); ++links) {
    if (!fs::is_symlink(path, none)) break;
    const fs::path next = path.parent_path() / fs::read_symlink(path, none);
    if (fs::exists(path, none) && !fs::exists(next, none)) break;  // as /proc/7/fd/1 to a pipe
    path = next;
  }
  return path;
}

/// Opens a pipe or a device. A pipe may get its reader soon: waits some seconds for it.
int open_directly(const fs::path& path) {
  constexpr timespec kPause{.tv_sec = 0, .tv_nsec = 50'000'000};
  for (int tries = 100;; --tries) {
    const int opened = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (opened >= 0) fcntl(opened, F_SETFL, fcntl(opened, F_GETFL) & ~O_NONBLOCK);
    if (opened >= 0 || errno != ENXIO || tries == 0) return opened;
    nanosleep(&kPause, nullptr);
  }
}

}  // namespace

Outcome<InputFile> InputFile::open(const std::string& path) {
  // A copy of standard input: the file closes its descriptor.
  InputFile input = path == "-"
                        ? InputFile("standard input", fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0))
                        : InputFile(path, ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!input.file_.is_open()) return failed(input.name_, "open it");
  return input;
}

Outcome<std::size_t> InputFile::read(std::span<char> into) {
  for (;;) {
    const ssize_t count = ::read(file_.get(), into.data(), into.size());
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) return failed(name_, "read it");
  }
}

std::optional<std::uint64_t> InputFile::size() const {
  struct stat facts {};
  if (fstat(file_.get(), &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
  return static_cast<std::uint64_t>(facts.st_size);
}

Outcome<void> InputFile::rewind() {
  if (lseek(file_.get(), 0, SEEK_SET) < 0) return failed(name_, "read it again");
  return {};
}

Outcome<InputFile> open_to_read_again(const std::string& path) {
  auto input = InputFile::open(path);
  if (!input || input->size()) return input;
  std::string folder = std::filesystem::temp_directory_path().string();
  InputFile kept(input->name_, ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
  if (!kept.file_.is_open()) return failed(folder, "store the input there");
  std::string piece(kReadSize, '\0');
  for (;;) {
    const auto count = TRY(input->read(piece));
    if (count == 0) break;
    for (std::string_view rest(piece.data(), count); !rest.empty();) {
      const ssize_t written = ::write(kept.file_.get(), rest.data(), rest.size());
      if (written < 0 && errno != EINTR) return failed(folder, "store the input there");
      rest.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
  }
  TRY(kept.rewind());
  return kept;
}

Outcome<std::string> read_file(const std::string& path) {
  auto file = TRY(InputFile::open(path));
  std::string bytes;
  for (;;) {
    const std::size_t size = bytes.size();
    bytes.resize(size + kReadSize);
    const auto count = TRY(file.read(std::span(bytes).subspan(size)));
    bytes.resize(size + count);
    if (count == 0) return bytes;
  }
}

Outcome<void> may_replace(const std::string& path, bool force) {
  const fs::path target = followed(path);
  std::error_code none;
  const bool is_replaced = !names_descriptor(target) && fs::is_regular_file(target, none);
  if (force || path == "-" || !is_replaced) return {};
  if (::isatty(STDIN_FILENO) == 1) {
    fmt::print(stderr, "fitgauge: {} exists: replace it? [y/N] ", path);
    std::string line;
    if (std::getline(std::cin, line) && (line == "y" || line == "Y")) return {};
  }
  return Failure{ExitCode::LocalFile, path + ": exists; --force replaces it"};
}

OutputFile::~OutputFile() {
  if (draft_.empty()) return;
  unlink(draft_.c_str());
  unfinished = nullptr;
}

bool OutputFile::open(int descriptor) {
  if (descriptor >= 0) file_.reset(fdopen(descriptor, "wb"));
  if (descriptor >= 0 && !file_) {  // opened for reading, or occupied
    close(descriptor);
    errno = EBADF;
  }
  return file_ != nullptr;
}

bool OutputFile::open() {
  if (path_.empty() || path_ == "-") return open(dup(STDOUT_FILENO));
  const fs::path target = followed(path_);
  if (names_descriptor(target)) return open(dup(std::atoi(target.filename().c_str())));
  struct stat status {};
  const bool is_there = stat(target.c_str(), &status) == 0;
  if (is_there ? ::access(target.c_str(), W_OK) != 0 : errno != ENOENT) return false;
  if (is_there && !S_ISREG(status.st_mode)) {
    const bool is_open = open(open_directly(target));
    if (!is_open && S_ISFIFO(status.st_mode) && errno == ENXIO) failure_ = "no program reads it";
    return is_open;
  }
  target_ = target.string();
  draft_ = (target.parent_path() / fmt::format(".{}.XXXXXX", target.filename().string())).string();
  remove_at_signals(draft_.c_str());
  const int descriptor = mkostemp(draft_.data(), O_CLOEXEC);
  if (descriptor < 0) {
    unfinished = nullptr;
    draft_.clear();
    return false;
  }
  return open(descriptor) &&
         fchmod(descriptor, is_there ? status.st_mode & 07777 : usual_rights()) == 0;
}

bool OutputFile::write(std::string_view bytes) {
  if (!failure_.empty()) return false;
  const bool good =
      (file_ || open()) && std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size();
  if (!good && failure_.empty()) failure_ = std::strerror(errno);
  return good;
}

Outcome<void> OutputFile::finish() {
  bool good = write("") && std::fflush(file_.get()) == 0;
  if (good && !draft_.empty()) {
    good = fsync(fileno(file_.get())) == 0 && std::rename(draft_.c_str(), target_.c_str()) == 0;
    if (good) {
      unfinished = nullptr;
      draft_.clear();
    }
  }
  if (good) return {};
  if (failure_.empty()) failure_ = std::strerror(errno);
  const bool is_standard = path_.empty() || path_ == "-";
  return Failure::of(ExitCode::LocalFile, "{}: cannot write it: {}",
                     is_standard ? "standard output" : path_, failure_);
}

Outcome<void> write_file(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  return file.finish();
}

}  // namespace fitgauge::cli
