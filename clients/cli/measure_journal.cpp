#include "cli/measure_command.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "cli/local_files.hpp"

namespace fitgauge::cli {
namespace {

constexpr int kPrivate = 0600;
constexpr std::size_t kKeyDigits = 32;

/// A place, or null.
struct PlaceOrNull : api::Object<CsvPosition> {
  bool read(api::FieldReader& fields, std::string_view name, CsvPosition& to) const {
    const JsonValue* place = fields.any(name);
    return place != nullptr && place->is(JsonValue::Kind::Object) && read_known(*place, to);
  }
};

/// A folder of states would grow by one for every input ever sent: the newest stay.
void forget_oldest_states(const std::filesystem::path& folder) {
  constexpr std::size_t kMostStates = 1000;
  std::vector<std::pair<std::filesystem::file_time_type, std::filesystem::path>> states;
  std::error_code ignored;  // another fitgauge may remove it too
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".state")
      states.emplace_back(entry.last_write_time(ignored), entry.path());
  }
  if (states.size() <= kMostStates) return;
  const auto oldest = states.end() - static_cast<std::ptrdiff_t>(kMostStates);
  std::nth_element(states.begin(), oldest, states.end());
  for (auto state = states.begin(); state != oldest; ++state) {
    std::filesystem::remove(state->second, ignored);
  }
}

Failure state_failure(const std::string& path, const char* what) {
  return Failure::of(ExitCode::LocalFile, "{}: cannot {}: {}; give another file with --state", path,
                     what, std::strerror(errno));
}

}  // namespace

void members(auto& v, CsvPosition& place) {
  v.member("bytes", place.bytes);
  v.member("lines", place.lines);
  v.member("sha256", place.sha256);
}

void members(auto& v, MeasureState& state) {
  v.member("server", state.server);
  v.member("session", state.session);
  // A newer version may have more members, in the inner objects too.
  v.member("stored", state.stored, api::Object<CsvPosition>({}, api::schema::Others::Allowed));
  v.member("pending", state.pending, PlaceOrNull{});
  v.member("verdicts", state.counts, api::Object<VerdictCounts>({}, api::schema::Others::Allowed));
  v.member("complete", state.complete);
  v.optional("last_id", state.last_id);  // absent in the state of an older version
}

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
  MeasureState state;
  if (!document || !read_known(*document, state) || state.session.empty()) return std::nullopt;
  return state;
}

std::string format_state(const MeasureState& state) { return api::body_json(state); }

std::string chunk_key(const MeasureState& state, const CsvPosition& end) {
  return fmt::format("{}-{}", state.session, end.sha256.substr(0, kKeyDigits));
}

Outcome<MeasureJournal> MeasureJournal::open(const std::string& path) {
  std::error_code ignored;  // what matters is whether the file can be opened
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  MeasureJournal journal(path,
                         ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, kPrivate));
  if (!journal.file_.is_open()) return state_failure(path, "open the state");
  if (flock(journal.file_.get(), LOCK_EX | LOCK_NB) != 0) {
    return Failure{ExitCode::LocalFile,
                   path + ": another fitgauge is sending this input: wait until it is done"};
  }
  TRY(journal.read_last_line());
  return journal;
}

Outcome<void> MeasureJournal::read_last_line() {
  const auto text = TRY(read_file(path_));
  const std::size_t end = text.rfind('\n') + 1;  // 0 when there is no whole line
  if (end < text.size() && ftruncate(file_.get(), static_cast<off_t>(end)) != 0)
    return state_failure(path_, "repair the state");
  if (end == 0) return {};
  const std::size_t before = end >= 2 ? text.rfind('\n', end - 2) : std::string::npos;
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  state_ = parse_state(std::string_view(text).substr(begin, end - 1 - begin));
  if (state_) return {};
  return Failure{ExitCode::LocalFile,
                 path_ + ": is not a state of fitgauge: give another file with --state"};
}

Outcome<std::vector<MeasureState>> MeasureJournal::states() const {
  const auto text = TRY(read_file(path_));
  std::vector<MeasureState> states;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    if (auto state = parse_state(rest.substr(0, end))) states.push_back(*std::move(state));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return states;
}

Outcome<void> MeasureJournal::append(const MeasureState& state) {
  state_ = state;
  if (path_.empty()) return {};
  const std::string line = format_state(state) + '\n';
  const ssize_t written = write(file_.get(), line.data(), line.size());
  const bool whole = written == static_cast<ssize_t>(line.size());
  if (whole && fdatasync(file_.get()) == 0) return {};
  return state_failure(path_, "write the state");
}

Outcome<void> MeasureJournal::clear() {
  if (!path_.empty() && ftruncate(file_.get(), 0) != 0)
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
