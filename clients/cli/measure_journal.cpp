#include "cli/measure_journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "base/digest.hpp"
#include "base/number.hpp"
#include "cli/json_object.hpp"
#include "cli/local_files.hpp"
#include "cli/terminal.hpp"

namespace fitgauge::cli {
namespace {

constexpr int kPrivate = 0600;
constexpr std::size_t kKeyDigits = 32;

bool read_count(const JsonValue& object, std::string_view name, std::uint64_t& out) {
  const auto read = read_number<std::uint64_t>(object.text_of(name));
  out = read.value_or(out);
  return read.has_value();
}

std::optional<CsvPosition> read_position(const JsonValue& object) {
  CsvPosition place{.sha256 = std::string(object.text_of("sha256"))};
  const bool read =
      read_count(object, "bytes", place.bytes) && read_count(object, "lines", place.lines);
  return read ? std::optional(place) : std::nullopt;
}

std::string format_position(const CsvPosition& place) {
  return JsonObject()
      .add_raw("bytes", std::to_string(place.bytes))
      .add_raw("lines", std::to_string(place.lines))
      .add("sha256", place.sha256)
      .text();
}

/// A folder of states would grow by one for every input ever sent: the newest stay.
void forget_oldest_states(const std::filesystem::path& folder) {
  constexpr std::size_t kMostStates = 1000;
  std::vector<std::pair<std::filesystem::file_time_type, std::filesystem::path>> states;
  std::error_code ignored;  // another fitgauge may remove it too
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".state") {
      states.emplace_back(entry.last_write_time(ignored), entry.path());
    }
  }
  if (states.size() <= kMostStates) return;
  const auto oldest = states.end() - static_cast<std::ptrdiff_t>(kMostStates);
  std::nth_element(states.begin(), oldest, states.end());
  for (auto state = states.begin(); state != oldest; ++state) {
    std::filesystem::remove(state->second, ignored);
  }
}

Failure state_failure(const std::string& path, const char* what) {
  return {ExitCode::LocalFile, fmt::format("{}: cannot {}: {}; give another file with --state",
                                           path, what, std::strerror(errno))};
}

}  // namespace

VerdictCounts& VerdictCounts::operator+=(const VerdictCounts& other) {
  good += other.good;
  rework += other.rework;
  reject += other.reject;
  indeterminate += other.indeterminate;
  unjudged += other.unjudged;
  return *this;
}

std::optional<MeasureState> parse_state(std::string_view line) {
  const auto document = parse_document(line);
  if (!document) return std::nullopt;
  MeasureState state{.server = std::string(document->text_of("server")),
                     .session = std::string(document->text_of("session")),
                     .complete = document->text_of("complete") == "true"};
  const auto stored = read_position(document->member("stored"));
  if (!stored || state.session.empty()) return std::nullopt;
  state.stored = *stored;
  state.pending = read_position(document->member("pending"));
  const JsonValue& counts = document->member("verdicts");
  const bool counted = read_count(counts, "good", state.counts.good) &&
                       read_count(counts, "rework", state.counts.rework) &&
                       read_count(counts, "reject", state.counts.reject) &&
                       read_count(counts, "indeterminate", state.counts.indeterminate);
  // The state of an older version has no such count.
  if (counts.find("unjudged") != nullptr) read_count(counts, "unjudged", state.counts.unjudged);
  return counted ? std::optional(std::move(state)) : std::nullopt;
}

std::string format_state(const MeasureState& state) {
  const VerdictCounts& counts = state.counts;
  return JsonObject()
      .add("server", state.server)
      .add("session", state.session)
      .add_raw("stored", format_position(state.stored))
      .add_raw("pending", state.pending ? format_position(*state.pending) : "null")
      .add_raw("verdicts", JsonObject()
                               .add_raw("good", std::to_string(counts.good))
                               .add_raw("rework", std::to_string(counts.rework))
                               .add_raw("reject", std::to_string(counts.reject))
                               .add_raw("indeterminate", std::to_string(counts.indeterminate))
                               .add_raw("unjudged", std::to_string(counts.unjudged))
                               .text())
      .add_raw("complete", state.complete ? "true" : "false")
      .text();
}

std::string chunk_key(const MeasureState& state, const CsvPosition& end) {
  return fmt::format("{}-{}", state.session, end.sha256.substr(0, kKeyDigits));
}

Outcome<MeasureJournal> MeasureJournal::open(const std::string& path) {
  std::error_code ignored;  // what matters is whether the file can be opened
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, kPrivate);
  if (descriptor < 0) return state_failure(path, "open the state");
  MeasureJournal journal(path, descriptor);
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    return Failure{ExitCode::LocalFile,
                   path + ": another fitgauge is sending this input: wait until it is done"};
  }
  TRY(journal.read_last_line());
  return journal;
}

MeasureJournal::MeasureJournal(MeasureJournal&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      state_(std::move(other.state_)) {}

MeasureJournal::~MeasureJournal() {
  if (descriptor_ >= 0) close(descriptor_);
}

Outcome<void> MeasureJournal::read_last_line() {
  const auto text = TRY(read_file(path_));
  const std::size_t end = text.rfind('\n') + 1;  // 0 when there is no whole line
  if (end < text.size() && ftruncate(descriptor_, static_cast<off_t>(end)) != 0)
    return state_failure(path_, "repair the state");
  if (end == 0) return {};
  const std::size_t before = end >= 2 ? text.rfind('\n', end - 2) : std::string::npos;
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  state_ = parse_state(std::string_view(text).substr(begin, end - 1 - begin));
  if (state_) return {};
  return Failure{ExitCode::LocalFile,
                 path_ + ": is not a state of fitgauge: give another file with --state"};
}

Outcome<void> MeasureJournal::append(const MeasureState& state) {
  state_ = state;
  if (path_.empty()) return {};
  const std::string line = format_state(state) + '\n';
  const ssize_t written = write(descriptor_, line.data(), line.size());
  const bool whole = written == static_cast<ssize_t>(line.size());
  if (whole && fdatasync(descriptor_) == 0) return {};
  return state_failure(path_, "write the state");
}

Outcome<void> MeasureJournal::clear() {
  if (!path_.empty() && ftruncate(descriptor_, 0) != 0)
    return state_failure(path_, "clear the state");
  state_.reset();
  return {};
}

Outcome<std::string> journal_path(const std::string& input, const std::string& server) {
  std::string folder = environment_variable("XDG_STATE_HOME");
  if (folder.empty()) {
    const std::string home = environment_variable("HOME");
    if (home.empty()) {
      return Failure{ExitCode::LocalFile,
                     "HOME and XDG_STATE_HOME are missing: give a file for the state with --state"};
    }
    folder = home + "/.local/state";
  }
  std::error_code ignored;  // an input that is not there fails when it is opened
  const auto absolute = std::filesystem::absolute(input, ignored);
  const std::string digest =
      to_hex(sha256(server + '\n' + std::filesystem::weakly_canonical(absolute, ignored).string()));
  folder += "/fitgauge";
  forget_oldest_states(folder);
  return folder + "/" + digest.substr(0, kKeyDigits) + ".state";
}

}  // namespace fitgauge::cli
