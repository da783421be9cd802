#include "plant/folder/folder_in.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <utility>

#include "base/guarded.hpp"
#include "base/text.hpp"
#include "base/thread.hpp"
#include "http/request.hpp"
#include "plant/folder/file_rows.hpp"
#include "plant/folder/file_taking.hpp"
#include "plant/folder/resting_file.hpp"
#include "plant/folder/whole_file.hpp"
#include "plant/lsv2/link/descriptor.hpp"

namespace fitgauge::connections {
namespace {

namespace fs = std::filesystem;
using control_link::Descriptor;

constexpr int kStopSliceMs = 100;  ///< how soon a stop is seen
constexpr std::size_t kInotifyBuffer = 16'384;
constexpr int kWaitsForDescription = 6;  ///< looks that a DFX waits for its DFD

std::string because() { return std::strerror(errno); }

/// NAME, NAME.1, NAME.2 and so on: the first that the folder does not have.
std::string free_name(const std::string& name, const fs::path& folder) {
  std::error_code failure;
  std::string free = name;
  for (int number = 1; fs::exists(fs::symlink_status(folder / free, failure)); ++number) {
    free = fmt::format("{}.{}", name, number);
  }
  return free;
}

/// Nothing gives way for it: this connection alone writes to the folder. @returns why it stays.
std::optional<std::string> move_to(const fs::path& from, const fs::path& to) {
  if (std::rename(from.c_str(), to.c_str()) == 0) return std::nullopt;
  return fmt::format("{} cannot be moved to {}: {}", from.filename().string(), to.string(),
                     because());
}

class FolderIn final : public Worker {
 public:
  FolderIn(FolderInOptions options, const Plant& plant)
      : Worker(options.name, plant), options_(std::move(options)) {
    thread_ = Thread("folder_in", [this](const std::stop_token& stop) { run(stop); });
  }

  void request_stop() override { thread_.request_stop(); }

 private:
  using Time = std::chrono::steady_clock::time_point;
  struct Seen {
    Look look{};
    Time since{};
    bool is_taken = false;  ///< and could not be moved away yet
  };

  void run(const std::stop_token& stop);
  void watch();
  /// Until something happens, the time is over, or a stop.
  void wait(const std::stop_token& stop, std::chrono::milliseconds most);
  /// Takes what is at rest. @returns why not.
  std::optional<std::string> look(const std::stop_token& stop);
  std::optional<std::string> take(const std::string& name, Seen& seen);
  /// The DFD of a DFX: empty while it has to be waited for. @errors it is not there.
  Result<std::string> description_of(const std::string& name, const Seen& seen);
  /// Of files that are taken. @returns why one stays, until the next look.
  std::optional<std::string> move_away(const std::vector<std::string>& names) const;
  /// @param names of the file, and of its description where it has one
  std::optional<std::string> fail(const std::vector<std::string>& names, const Error& error);
  bool is_wanted(const std::string& name) const;

  const FolderInOptions options_;

  // Of the thread.
  Descriptor inotify_;
  int watch_ = -1;
  std::map<std::string, Seen> seen_;
  std::set<std::string> at_rest_;   ///< of these
  std::set<std::string> moved_in_;  ///< whole from the first moment on
  bool is_restless_ = false;        ///< a file is not yet at rest

  Thread thread_;  // last: it uses all above
};

void FolderIn::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (watch_ < 0) watch();
    std::optional<std::string> why = "a defect of fitgauge ended the attempt";
    guarded("folder_in", [&] { why = look(stop); });
    if (stop.stop_requested()) return;
    finish_attempt(why);
    const auto most =
        is_restless_ && !why ? std::min(options_.interval, options_.rest) : options_.interval;
    wait(stop, std::max<std::chrono::milliseconds>(most, std::chrono::milliseconds(200)));
  }
}

void FolderIn::watch() {
  inotify_ = Descriptor(inotify_init1(IN_NONBLOCK | IN_CLOEXEC));
  if (inotify_.get() < 0) return;  // then it is looked at from time to time
  watch_ = inotify_add_watch(inotify_.get(), options_.folder.c_str(),
                             IN_MOVED_TO | IN_CLOSE_WRITE | IN_DELETE_SELF | IN_MOVE_SELF);
}

void FolderIn::wait(const std::stop_token& stop, std::chrono::milliseconds most) {
  const Time until = std::chrono::steady_clock::now() + most;
  while (!stop.stop_requested() && std::chrono::steady_clock::now() < until) {
    pollfd waited{.fd = watch_ < 0 ? -1 : inotify_.get(), .events = POLLIN, .revents = 0};
    if (poll(&waited, 1, kStopSliceMs) <= 0) continue;
    alignas(inotify_event) std::array<char, kInotifyBuffer> buffer;
    const ssize_t count = read(inotify_.get(), buffer.data(), buffer.size());
    bool has_come = false;
    for (std::size_t at = 0; count > 0 && at < static_cast<std::size_t>(count);) {
      inotify_event event{};
      std::memcpy(&event, buffer.data() + at, sizeof event);
      const char* const name = buffer.data() + at + sizeof event;
      if ((event.mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED)) != 0) watch_ = -1;
      if ((event.mask & IN_MOVED_TO) != 0 && event.len > 0) moved_in_.insert(name);
      has_come = has_come || (event.mask & (IN_MOVED_TO | IN_CLOSE_WRITE)) != 0;
      at += sizeof event + event.len;
    }
    if (has_come || watch_ < 0) return;
  }
}

bool FolderIn::is_wanted(const std::string& name) const {
  return !name.starts_with('.') &&
         std::any_of(options_.names.begin(), options_.names.end(),
                     [&](const std::string& glob) { return matches_glob(glob, name); });
}

std::optional<std::string> FolderIn::look(const std::stop_token& stop) {
  std::error_code failure;
  fs::directory_iterator entries(options_.folder, failure);
  if (failure) {
    return fmt::format("{} cannot be read: {}", options_.folder.string(), failure.message());
  }
  std::map<std::string, Seen> now;
  const Time at = std::chrono::steady_clock::now();
  is_restless_ = false;
  std::vector<std::pair<std::int64_t, std::string>> ready;
  for (const fs::directory_iterator end; entries != end; entries.increment(failure)) {
    if (failure || now.size() == options_.most_entries) break;
    const std::string name = entries->path().filename().string();
    struct stat status {};
    if (!is_wanted(name) || lstat(entries->path().c_str(), &status) != 0 ||
        !S_ISREG(status.st_mode)) {
      continue;
    }
    Seen seen{.look = look_of(status), .since = at};
    const auto known = seen_.find(name);
    if (known != seen_.end() && known->second.look == seen.look) seen = known->second;
    const bool is_whole = moved_in_.contains(name) || at - seen.since >= options_.rest;
    if (is_whole) ready.emplace_back(seen.look.changed_ns, name);
    is_restless_ = is_restless_ || !is_whole;
    now.emplace(name, seen);
  }
  seen_ = std::move(now);
  moved_in_.clear();
  std::sort(ready.begin(), ready.end());
  std::optional<std::string> first;
  at_rest_.clear();
  for (const auto& [time, name] : ready) at_rest_.insert(name);
  for (const auto& [time, name] : ready) {
    if (stop.stop_requested()) break;
    if (is_description(name)) continue;  // it goes with its DFX
    if (auto why = take(name, seen_[name]); why && !first) first = std::move(why);
  }
  return first;
}

Result<std::string> FolderIn::description_of(const std::string& name, const Seen& seen) {
  const std::string stem = name.substr(0, name.rfind('.'));
  for (const auto& [other, looked] : seen_) {
    if (!is_description(other) || other.substr(0, other.rfind('.')) != stem) continue;
    if (at_rest_.contains(other)) return other;
    is_restless_ = true;
    return std::string();
  }
  if (std::chrono::steady_clock::now() - seen.since < kWaitsForDescription * options_.interval) {
    is_restless_ = true;
    return std::string();
  }
  return Error{
      ErrorCode::RequestInvalid,
      fmt::format("its description, {}.dfd, is not in the folder: put both into it", stem)};
}

std::optional<std::string> FolderIn::take(const std::string& name, Seen& seen) {
  std::vector<std::string> names = {name};
  if (is_values_alone(name)) {
    const auto description = description_of(name, seen);
    if (!description) return fail(names, description.error());
    if (description->empty()) return std::nullopt;
    names.push_back(*description);
  }
  if (seen.is_taken) return move_away(names);
  std::vector<RestingFile> files;
  std::int64_t size = 0;
  for (const std::string& one : names) {
    const Look& look = seen_[one].look;
    size += look.size;
    if (look.size > static_cast<std::int64_t>(options_.most_file_bytes)) {
      return fail(names, {ErrorCode::BodyTooLarge,
                          fmt::format("it has more than {} MiB: cut it into several files",
                                      options_.most_file_bytes >> 20)});
    }
    auto file = RestingFile::open(options_.folder / one, look);
    if (!file) return file.error().message;
    if (!*file) return std::nullopt;  // taken away since
    files.push_back(**std::move(file));
  }
  const auto taken =
      take_file(options_, plant_, name, files[0], files.size() > 1 ? &files[1] : nullptr);
  if (!taken) {
    if (is_of_storage(taken.error())) return taken.error().message;
    return fail(names, taken.error());
  }
  if (!*taken) {
    is_restless_ = true;  // it changes yet: the next look begins anew
    for (const std::string& one : names) seen_[one].since = std::chrono::steady_clock::now();
    return std::nullopt;
  }
  change([&](ConnectionState& state) {
    state.measurements += (*taken)->measurements;
    if ((*taken)->was_taken_before) return;
    ++state.files;
    state.bytes += static_cast<std::uint64_t>(size);
  });
  if ((*taken)->was_taken_before) {
    plant_.tell("file_taken_before", fmt::format("{}: {}: the same bytes are stored; it is moved "
                                                 "to done",
                                                 options_.name, name));
  }
  seen.is_taken = true;
  return move_away(names);
}

std::optional<std::string> FolderIn::move_away(const std::vector<std::string>& names) const {
  const fs::path done = options_.folder / "done";
  std::error_code failure;
  fs::create_directories(done, failure);
  for (const std::string& name : names) {
    if (auto why = move_to(options_.folder / name, done / free_name(name, done))) return why;
  }
  return std::nullopt;
}

std::optional<std::string> FolderIn::fail(const std::vector<std::string>& names,
                                          const Error& error) {
  const fs::path folder = options_.folder / "failed";
  std::error_code failure;
  fs::create_directories(folder, failure);
  const std::string& name = names.front();
  const std::string to = free_name(name, folder);
  // The text is there before the file is, so that a file in `failed` always has one.
  if (!write_whole_file(folder / (to + ".error.txt"), told(name, error))) {
    return fmt::format("{}: cannot write into {}: {}", name, folder.string(), because());
  }
  change([](ConnectionState& state) { ++state.unreadable; });
  plant_.tell("file_refused",
              fmt::format("{}: {}: {}", options_.name, name,
                          error.details.empty() ? error.message : error.details.front().message));
  if (auto why = move_to(options_.folder / name, folder / to)) return why;
  for (const std::string& beside : std::span(names).subspan(1)) {
    if (auto why = move_to(options_.folder / beside, folder / free_name(beside, folder)))
      return why;
  }
  return std::nullopt;
}

}  // namespace

std::unique_ptr<Worker> make(const FolderInOptions& options, const Plant& plant) {
  return std::make_unique<FolderIn>(options, plant);
}

ConnectionTest test_of(const FolderInOptions& options, const Plant&, const std::stop_token&) {
  std::error_code failure;
  if (!fs::is_directory(options.folder, failure)) {
    return {.ok = false, .detail = options.folder.string() + " is no folder"};
  }
  for (const char* name : {"done", "failed"}) {
    const fs::path folder = options.folder / name;
    fs::create_directories(folder, failure);
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
      return {.ok = false,
              .detail = fmt::format("{} cannot be written: {}", folder.string(), because())};
    }
  }
  if (access(options.folder.c_str(), R_OK | W_OK | X_OK) != 0) {
    return {.ok = false,
            .detail = fmt::format("files cannot be moved out of {}: {}", options.folder.string(),
                                  because())};
  }
  return {.ok = true, .detail = "the folder can be read, and files moved in it"};
}

}  // namespace fitgauge::connections
