#include "plant/lsv2/collected_log.hpp"

#include "plant/kind.hpp"

namespace fitgauge::connections {
namespace {

using control_link::DirectoryEntry;
using control_link::LinkClient;
using control_link::LinkFailure;

bool is_watched(const MachineOptions& machine, std::string_view folder,
                const DirectoryEntry& entry) {
  constexpr auto kDirectory = DirectoryEntry::kDirectory | DirectoryEntry::kDirectoryOfItnc;
  return (entry.flags & kDirectory) == 0 &&
         std::ranges::any_of(machine.paths, [&](const WatchedPath& watched) {
           return watched.folder == folder && matches_glob(watched.name, entry.name);
         });
}

/// Connects to the control and logs in for lists and files.
control_link::LinkResult<LinkClient> connect(const MachineOptions& machine,
                                             const std::stop_token& stop) {
  auto control = LinkClient::connect({.address = machine.address, .stop = stop});
  if (!control) return control;
  for (const char* login : {"INSPECT", "FILE"}) {
    TRY(control->login(login));
    // Set between the logins, because INSPECT may request the buffer.
    if (login == std::string_view("INSPECT")) TRY(control->agree_buffer());
  }
  return control;
}

/// Returns each watched folder once.
std::vector<std::string> folders_of(const MachineOptions& machine) {
  std::vector<std::string> folders;
  for (const WatchedPath& path : machine.paths) {
    if (std::ranges::find(folders, path.folder) == folders.end()) folders.push_back(path.folder);
  }
  return folders;
}

/// Reads probing logs from a control over LSV-2, with its own thread and connection: a slow or
/// unreachable control delays no other. It logs in as INSPECT and FILE, and only lists and reads.
/// An unreachable machine is tried again after twice the time, up to ten minutes.
class Collector final : public Worker {
 public:
  Collector(MachineOptions options, const Plant& plant)
      : Worker(options.name, plant), options_(std::move(options)) {
    thread_ = Thread("a collector", [this](const std::stop_token& stop) { run(stop); });
  }

  void request_stop() override { thread_.request_stop(); }

 private:
  /// State of a file when it was last fetched.
  struct Seen {
    std::uint32_t bytes = 0;
    std::uint32_t unix_time = 0;
    Digest digest{};
    /// Two fetches were equal: a file can change again within a second of its time.
    bool is_settled = false;
  };

  void run(const std::stop_token& stop) {
    std::chrono::seconds wait = options_.interval;
    while (!stop.stop_requested()) {
      std::optional<std::string> why = "a defect of fitgauge ended the attempt";
      begin_attempt();
      guarded("collector", [&] { why = round(stop); });
      if (stop.stop_requested()) return;
      finish_attempt(why);
      const auto most = std::max(options_.longest_wait, options_.interval);
      wait = is_away_ ? std::min(2 * wait, most) : options_.interval;
      wait_unless_stopped(stop, wait);
    }
  }

  /// Fetches everything that has changed, over one connection. @returns why it failed.
  std::optional<std::string> round(const std::stop_token& stop) {
    is_away_ = true;
    auto control = connect(options_, stop);
    if (!control) return control.error().message;
    is_away_ = false;
    round_bytes_ = 0;
    std::optional<std::string> first;
    for (const std::string& folder : folders_of(options_)) {
      auto why = read_folder(*control, folder);
      if (why && !first) first = std::move(why);
      if (is_away_) break;
    }
    return first;
  }

  /// An unreadable folder or file delays no other, as long as the connection is open.
  std::optional<std::string> read_folder(LinkClient& control, const std::string& folder) {
    auto entries = control.list(folder, options_.most_entries);
    if (!entries) return failed(folder, entries.error());
    std::optional<std::string> first;
    for (const DirectoryEntry& entry : *entries) {
      if (!is_watched(options_, folder, entry)) continue;
      if (auto why = fetch(control, folder + entry.name, entry); why && !first)
        first = std::move(why);
      if (is_away_) break;
    }
    return first;
  }

  std::optional<std::string> fetch(LinkClient& control, const std::string& path,
                                   const DirectoryEntry& entry) {
    begin_attempt();
    const std::string key = ascii_lower(path);
    const auto known = seen_.find(key);
    const bool is_known = known != seen_.end() && known->second.bytes == entry.bytes &&
                          known->second.unix_time == entry.unix_time;
    if (is_known && known->second.is_settled) return std::nullopt;
    if (entry.bytes > options_.most_file_bytes) {
      return fmt::format("{}: has more than {} bytes: move it away on the control", path,
                         options_.most_file_bytes);
    }
    if (round_bytes_ + entry.bytes > options_.most_round_bytes) return std::nullopt;
    const auto bytes =
        control.download(path, control_link::Transfer::Binary, options_.most_file_bytes);
    if (!bytes) {
      // The file was deleted after it was listed.
      if (bytes.error().is_refusal(control_link::ControlError::NoFile)) return std::nullopt;
      return failed(path, bytes.error());
    }
    round_bytes_ += bytes->size();
    const Digest digest = sha256(*bytes);
    if (known != seen_.end() && known->second.digest == digest) {
      known->second = {entry.bytes, entry.unix_time, digest, is_known};
      return std::nullopt;
    }
    const auto taken = take_logs(plant_, options_, path, *bytes);
    if (!taken) return path + ": " + taken.error().message;
    seen_[key] = {entry.bytes, entry.unix_time, digest, false};
    change([&](ConnectionState& state) {
      ++state.files;
      state.bytes += bytes->size();
      state.logs += taken->logs;
      state.measurements += taken->measurements;
      state.values_kept += taken->values_kept;
      state.unreadable += taken->unread.size();
    });
    if (!taken->unread.empty()) {
      plant_.tell("log_not_understood", fmt::format("{}: {}: {}; the file is kept whole",
                                                    options_.name, path, taken->unread.front()));
    }
    return std::nullopt;
  }

  /// Returns the message of a failure. After any failure but a refusal the connection is over.
  std::string failed(const std::string& path, const LinkFailure& failure) {
    is_away_ = failure.kind != LinkFailure::Kind::Refused;
    return path + ": " + failure.message;
  }

  const MachineOptions options_;
  std::map<std::string, Seen> seen_;  ///< by path in lower case; of the thread alone
  std::size_t round_bytes_ = 0;
  bool is_away_ = false;  ///< the machine is not reached, or its connection broke
  Thread thread_;         // last: it uses all above
};

constexpr std::size_t kMostPatterns = 20;

Result<control_link::ControlAddress> read_address(std::string_view text) {
  if (const auto address = control_link::parse_control_address(text)) return *address;
  return invalid_field(
      fmt::format("address must be HOST or HOST:PORT; got '{}'", first_characters(text, 100)));
}

/// Reads a path such as `TNC:\nc_prog\TCHPR*.TXT`; `/` separates folders as `\` does.
Result<WatchedPath> read_watched(const JsonValue& item) {
  if (!item.is(JsonValue::Kind::String))
    return Error{ErrorCode::FieldType, "a path must be a text"};
  std::string path = item.text;
  std::ranges::replace(path, '/', '\\');
  const std::size_t stroke = path.rfind('\\');
  const bool is_path = path.size() > 5 && ascii_iequals(path.substr(0, 5), "TNC:\\") &&
                       stroke + 1 < path.size() && path.find("..") == std::string::npos &&
                       path.find_first_of("*?") >= stroke;
  if (is_path) return WatchedPath{path.substr(0, stroke + 1), path.substr(stroke + 1)};
  return invalid_field(
      fmt::format("a path must be a folder of TNC:\\ and a file name (* and ? allowed), such as "
                  "TNC:\\nc_prog\\TCHPR*.TXT; got '{}'",
                  item.text));
}

}  // namespace

std::unique_ptr<Worker> make(const MachineOptions& machine, const Plant& plant) {
  return std::make_unique<Collector>(machine, plant);
}

/// Logs in and lists the watched folders once. Waits for the control.
TestResult test_of(const MachineOptions& machine, const Plant&, const std::stop_token& stop) {
  auto control = connect(machine, stop);
  if (!control) return Error{ErrorCode::NotReady, control.error().message};
  std::size_t files = 0;
  for (const std::string& folder : folders_of(machine)) {
    const auto entries = control->list(folder, machine.most_entries);
    if (!entries) return Error{ErrorCode::NotReady, folder + ": " + entries.error().message};
    files += static_cast<std::size_t>(std::ranges::count_if(
        *entries, [&](const auto& entry) { return is_watched(machine, folder, entry); }));
  }
  return fmt::format("logged in; {} files are watched", files);
}

template <class V>
void members(V& v, NamedPattern& pattern) {
  v.member("file", pattern.file, "File name");
  v.member("text", pattern.pattern, By{0, log_reader::Pattern::parse}, "The pattern");
}

template <class V>
void members(V& v, MachineOptions& machine) {
  v.member("address", machine.address, By{0, read_address}, "host or host:port of the control");
  v.member("paths", machine.paths,
           Each{100, "paths of the control, such as TNC:\\nc_prog\\TCHPR*.TXT", api::schema::text(),
                read_watched},
           "Watched paths: TNC:\\nc_prog\\TCHPR*.TXT");
  v.optional("machine", machine.machine, api::Text{200},
             "Machine of the measurements (default: the name of the connection)");
  v.optional("interval_s", machine.interval, Within{1, 86'400},
             "Time between two attempts (default: 60)");
  v.optional("patterns", machine.patterns, "Pattern for files of FN 16");
  v.check([&](api::FieldReader& fields) {
    if (machine.patterns.size() <= kMostPatterns) return;
    fields.report(ErrorCode::FieldInvalid, "patterns",
                  fmt::format("at most {} patterns", kMostPatterns));
  });
}

Kind lsv2_kind() { return kind_of<MachineOptions>("lsv2"); }

}  // namespace fitgauge::connections
