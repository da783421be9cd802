#include "cli/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace fitgauge::cli {
namespace {

namespace fs = std::filesystem;

/// The rights of a new file, which mkstemp() does not give.
mode_t usual_rights() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

}  // namespace

OutputFile::~OutputFile() {
  if (!draft_.empty()) unlink(draft_.c_str());
}

bool OutputFile::open() {
  if (path_.empty() || path_ == "-") {
    file_.reset(fdopen(dup(STDOUT_FILENO), "wb"));
    return file_ != nullptr;
  }
  struct stat status {};
  const bool is_there = stat(path_.c_str(), &status) == 0;
  if (is_there && !S_ISREG(status.st_mode)) {
    file_.reset(std::fopen(path_.c_str(), "wb"));
    return file_ != nullptr;
  }
  std::error_code none;
  target_ = is_there ? fs::canonical(path_, none).string() : path_;
  const fs::path target(target_);
  draft_ = (target.parent_path() / fmt::format(".{}.XXXXXX", target.filename().string())).string();
  const int descriptor = mkostemp(draft_.data(), O_CLOEXEC);
  if (descriptor < 0) {
    draft_.clear();
    return false;
  }
  file_.reset(fdopen(descriptor, "wb"));
  return file_ != nullptr &&
         fchmod(descriptor, is_there ? status.st_mode & 07777 : usual_rights()) == 0;
}

bool OutputFile::write(std::string_view bytes) {
  if (!failure_.empty()) return false;
  const bool good =
      (file_ || open()) && std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size();
  if (!good) failure_ = std::strerror(errno);
  return good;
}

Outcome<void> OutputFile::finish() {
  bool good = write("") && std::fflush(file_.get()) == 0;
  if (good && !draft_.empty()) {
    good = fsync(fileno(file_.get())) == 0 && std::rename(draft_.c_str(), target_.c_str()) == 0;
    if (good) draft_.clear();
  }
  if (good) return {};
  if (failure_.empty()) failure_ = std::strerror(errno);
  const bool is_standard = path_.empty() || path_ == "-";
  return Failure{
      ExitCode::LocalFile,
      fmt::format("{}: cannot write it: {}", is_standard ? "standard output" : path_, failure_)};
}

Outcome<void> write_file(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  return file.finish();
}

}  // namespace fitgauge::cli
