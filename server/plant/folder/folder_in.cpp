#include "plant/folder/folder_in.hpp"

#include <poll.h>
#include <sys/inotify.h>

#include "api/services.hpp"
#include "base/thread.hpp"
#include "plant/kind.hpp"

namespace fitgauge::connections {
namespace {

constexpr int kStopSliceMs = 100;  ///< how soon a stop is seen
constexpr std::size_t kInotifyBuffer = 16'384;
constexpr int kWaitsForDescription = 6;  ///< looks that a DFX waits for its DFD

/// Whether a file has values and no description: a DFX.
bool is_values_alone(std::string_view name) { return ascii_lower(name).ends_with(".dfx"); }
/// Whether it is the description of such a file: a DFD.
bool is_description(std::string_view name) { return ascii_lower(name).ends_with(".dfd"); }

/// Whether an error is one of the service, not of the file.
bool is_of_service(const Error& error) {
  return http::is_server_error(api::status_of(error.code)) ||
         error.code == ErrorCode::IdempotencyInProgress;
}

/// Stores the files of a folder, each once, and moves them to its folder `done`; a wrong file goes
/// to `failed`, with a text that names its wrong lines and their remedy.
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
    bool is_taken = false;  ///< and could not be moved yet
  };

  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      if (watch_ < 0) watch();
      std::optional<std::string> why = "a defect of fitgauge ended the attempt";
      begin_attempt();
      guarded("folder_in", [&] { why = look(stop); });
      if (stop.stop_requested()) return;
      finish_attempt(why);
      const auto most =
          is_restless_ && !why ? std::min(options_.interval, options_.rest) : options_.interval;
      wait(stop, std::max<std::chrono::milliseconds>(most, std::chrono::milliseconds(200)));
    }
  }

  void watch() {
    inotify_ = Descriptor(inotify_init1(IN_NONBLOCK | IN_CLOEXEC));
    if (inotify_.get() < 0) return;  // then it is looked at from time to time
    watch_ = inotify_add_watch(inotify_.get(), options_.folder.c_str(),
                               IN_MOVED_TO | IN_CLOSE_WRITE | IN_DELETE_SELF | IN_MOVE_SELF);
  }

  /// Waits until something happens in the folder, the time is over, or a stop is requested.
  void wait(const std::stop_token& stop, std::chrono::milliseconds most) {
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

  /// Stores the files that no longer change. @returns why one could not be stored.
  std::optional<std::string> look(const std::stop_token& stop) {
    const auto folder = Folder::open(options_.folder);
    if (!folder) return folder.error().message;
    std::map<std::string, Seen> now;
    const Time at = std::chrono::steady_clock::now();
    is_restless_ = false;
    std::vector<std::pair<std::int64_t, std::string>> ready;
    const auto listed = folder->list([&](const std::string& name) {
      const auto status = is_wanted(name) ? folder->look(name) : std::nullopt;
      if (!status || !S_ISREG(status->st_mode)) return true;
      Seen seen{.look = Look::of(*status), .since = at};
      const auto known = seen_.find(name);
      if (known != seen_.end() && known->second.look == seen.look) seen = known->second;
      const bool is_whole = moved_in_.contains(name) || at - seen.since >= options_.rest;
      if (is_whole) ready.emplace_back(seen.look.changed_ns, name);
      is_restless_ = is_restless_ || !is_whole;
      now.emplace(name, seen);
      return now.size() < options_.most_entries;
    });
    if (!listed) return listed.error().message;
    seen_ = std::move(now);
    moved_in_.clear();
    std::ranges::sort(ready);
    std::optional<std::string> first;
    at_rest_.clear();
    for (const auto& [time, name] : ready) at_rest_.insert(name);
    for (const auto& [time, name] : ready) {
      if (stop.stop_requested()) break;
      if (is_description(name)) continue;  // read together with its DFX
      begin_attempt();
      if (auto why = take(*folder, name, seen_[name], stop); why && !first) first = std::move(why);
    }
    return first;
  }

  std::optional<std::string> take(const Folder& folder, const std::string& name, Seen& seen,
                                  const std::stop_token& stop) {
    std::vector<std::string> names = {name};
    if (is_values_alone(name)) {
      const auto description = description_of(name, seen);
      if (!description) return fail(folder, names, description.error());
      if (description->empty()) return std::nullopt;
      names.push_back(*description);
    }
    if (seen.is_taken) return move_away(folder, names);
    std::vector<RestingFile> files;
    std::int64_t size = 0;
    for (const std::string& one : names) {
      const Look& look = seen_[one].look;
      size += look.size;
      if (look.size > static_cast<std::int64_t>(options_.most_file_bytes)) {
        return fail(folder, names,
                    {ErrorCode::BodyTooLarge,
                     fmt::format("it has more than {} MiB: split it into several files",
                                 options_.most_file_bytes >> 20)});
      }
      auto file = folder.read(one);
      if (!file) return file.error().message;
      if (!*file) return std::nullopt;  // taken away since
      files.emplace_back(one, **std::move(file), look);
    }
    const auto taken =
        take_file(options_, plant_, name, files[0], files.size() > 1 ? &files[1] : nullptr, stop);
    if (!taken) {
      if (is_of_service(taken.error())) return taken.error().message;
      return fail(folder, names, taken.error());
    }
    if (!*taken) {
      is_restless_ = true;  // it changes yet: the next look begins anew
      for (const std::string& one : names) seen_[one].since = std::chrono::steady_clock::now();
      return std::nullopt;
    }
    change([&](ConnectionState& state) {
      if (**taken == 0) return;
      state.measurements += **taken;
      ++state.files;
      state.bytes += static_cast<std::uint64_t>(size);
    });
    if (**taken == 0) {
      plant_.tell("file_taken_before", fmt::format("{}: {}: the same bytes are stored; it is moved "
                                                   "to done",
                                                   options_.name, name));
    }
    seen.is_taken = true;
    return move_away(folder, names);
  }

  /// Returns the name of the DFD of a DFX; empty: wait for it. @errors it did not come.
  Result<std::string> description_of(const std::string& name, const Seen& seen) {
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
        fmt::format("its description {}.dfd is not in the folder: copy both files into it", stem)};
  }

  /// Moves stored files to `done`. @returns why a file stays until the next scan.
  static std::optional<std::string> move_away(const Folder& folder,
                                              const std::vector<std::string>& names) {
    const auto done = folder.sub("done");
    if (!done) return fmt::format("{} cannot be moved: {}", names.front(), done.error().message);
    for (const std::string& name : names) {
      if (const auto moved = folder.move(name, *done, name); !moved) return moved.error().message;
    }
    return std::nullopt;
  }

  /// @param names of the file, and of its description if it has one
  std::optional<std::string> fail(const Folder& folder, const std::vector<std::string>& names,
                                  const Error& error) {
    const std::string& name = names.front();
    const auto failed = folder.sub("failed");
    if (!failed) return fmt::format("{} cannot be moved: {}", name, failed.error().message);
    const std::string to = failed->free_name(name);
    // Writes the text before it moves the file: each file in `failed` has its text.
    if (const auto written = failed->write(to + ".error.txt", told(name, error)); !written) {
      return fmt::format("{}: {}", name, written.error().message);
    }
    change([](ConnectionState& state) { ++state.unreadable; });
    plant_.tell("file_refused",
                fmt::format("{}: {}: {}", options_.name, name,
                            error.details.empty() ? error.message : error.details.front().message));
    for (const std::string& one : names) {
      const auto moved = folder.move(one, *failed, one == name ? to : one);
      if (!moved) return moved.error().message;
    }
    return std::nullopt;
  }

  bool is_wanted(const std::string& name) const {
    return !name.starts_with('.') &&
           std::ranges::any_of(options_.names,
                               [&](const std::string& glob) { return matches_glob(glob, name); });
  }

  const FolderInOptions options_;

  // Used only by the thread.
  Descriptor inotify_;
  int watch_ = -1;
  std::map<std::string, Seen> seen_;
  std::set<std::string> at_rest_;   ///< of these
  std::set<std::string> moved_in_;  ///< whole from the first moment on
  bool is_restless_ = false;        ///< a file is not yet at rest

  Thread thread_;  // last: it uses all above
};

constexpr std::size_t kMostWords = 200;
constexpr std::size_t kLongestGlob = 100;

bool is_field(std::string_view name) {
  return std::ranges::any_of(api::kRowFields,
                             [&](const api::RowField& field) { return field.name == name; });
}

Result<std::string> read_glob(const JsonValue& item) {
  const bool is_glob = item.is(JsonValue::Kind::String) && !item.text.empty() &&
                       item.text.size() <= kLongestGlob && item.text.find('/') == std::string::npos;
  if (is_glob) return item.text;
  return invalid_field("must be a file name without a folder (* and ? allowed), such as *.csv");
}

/// The form of an object of texts; `fault` returns what is wrong with a member, or nothing.
template <class Fault>
auto texts_by(Fault fault) {
  using Word = std::pair<std::string, std::string>;
  const auto take = [fault](std::string_view key, const JsonValue& value) -> Result<Word> {
    const bool is_text = value.is(JsonValue::Kind::String) || value.is(JsonValue::Kind::Number);
    if (!is_text) return Error{ErrorCode::FieldType, "must be a text"};
    if (std::string why = fault(key, value.text); !why.empty())
      return invalid_field(std::move(why));
    return Word(key, value.text);
  };
  return EachMember{kMostWords, "", api::schema::text(), take};
}

std::string fault_of_column(std::string_view, std::string_view to) {
  if (to.empty() || to == "date" || to == "time" || is_field(to)) return {};
  return fmt::format("unknown field {}; an empty text ignores the column",
                     first_characters(to, 100));
}

std::string fault_of_constant(std::string_view field, std::string_view) {
  if (is_field(field) && field != "measured_mm") return {};
  return fmt::format("{} must not be set for all rows", first_characters(field, 100));
}

Result<sheet::Encoding> read_encoding(std::string_view word) {
  if (const auto encoding = sheet::encoding_from_word(word)) return *encoding;
  return invalid_field("encoding must be one of: auto, utf-8, utf-16, windows-1252");
}

Result<sheet::LengthUnit> read_unit(std::string_view name) {
  if (const auto unit = sheet::length_unit(name)) return *unit;
  return invalid_field("length_unit must be one of: mm, \xC2\xB5m, cm, m, inch");
}

}  // namespace

template <class V>
void members(V& v, FolderInOptions& options) {
  v.member("folder", options.folder, path_for(v), "Absolute path on this machine");
  v.optional("names", options.names, Each{20, "names", api::schema::text(kLongestGlob), read_glob},
             "Names of files, with * and ?, such as *.csv");
  v.optional("map", options.csv.columns, texts_by(fault_of_column),
             "Name of a column and its field, date or time; empty ignores the column");
  v.optional("set", options.csv.constants, texts_by(fault_of_constant),
             "A field and its value for every row");
  v.optional("time_zone", options.csv.zone, By{0, sheet::TimeZone::load},
             "Time zone of times without an offset, such as Europe/Berlin");
  v.optional("encoding", options.csv.encoding, By{0, read_encoding},
             "Encoding: auto, utf-8, utf-16 or windows-1252 (default: auto)");
  v.optional("other_columns", options.csv.leaves_out_others, Choice{"refuse", "leave_out"},
             "Columns without a field: refuse the file, or leave_out (default: refuse)");
  v.optional("length_unit", options.csv.length_unit, By{0, read_unit},
             "Unit of a DFQ without a unit: mm, inch");
  v.optional("interval_s", options.interval, Within{1, 3600},
             "Seconds between two scans of the folder (default: 10)");
  v.optional("rest_s", options.rest, Within{1, 3600},
             "Seconds without a change of a file's size and time (default: 2)");
}

FolderUse folder_of(const FolderInOptions& options) {
  return {.folder = options.folder, .reads = options.names};
}

std::unique_ptr<Worker> make(const FolderInOptions& options, const Plant& plant) {
  return std::make_unique<FolderIn>(options, plant);
}

/// Whether the folder can be read, and files moved in it.
TestResult test_of(const FolderInOptions& options, const Plant&, const std::stop_token&) {
  const auto folder = TRY(Folder::open(options.folder));
  for (const char* name : {"done", "failed"}) {
    const auto sub = TRY(folder.sub(name));
    TRY(sub.check_writable());
  }
  TRY(folder.check_writable());
  return "the folder can be read, and files moved in it";
}

Kind folder_in_kind() { return kind_of<FolderInOptions>("folder_in"); }

}  // namespace fitgauge::connections
