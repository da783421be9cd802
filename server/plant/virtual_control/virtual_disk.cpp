#include "plant/virtual_control/virtual_disk.hpp"

namespace fitgauge::virtual_control {
namespace {

using control_link::ControlError;

std::string absolute(std::string_view text, std::string_view directory) {
  std::string path(text);
  std::ranges::replace(path, '/', '\\');
  if (path.find(':') != std::string::npos) return path;
  if (path.starts_with('\\')) return std::string(kRoot.substr(0, 4)) + path;
  return std::string(directory) + path;
}

/// Maximum wait for the files of a running program.
constexpr std::chrono::milliseconds kPatience{50};
/// Maximum bytes of the names of directories that clients make.
constexpr std::size_t kMostMadeBytes = std::size_t{1} << 20;
constexpr std::string_view kEveryControls[] = {"TNC:\\", "TNC:\\nc_prog\\", "TNC:\\table\\"};

bool is_every_controls(std::string_view directory) {
  return std::ranges::any_of(kEveryControls,
                             [&](std::string_view each) { return ascii_iequals(each, directory); });
}

ControlError refusal_of(const Error& error) {
  switch (error.code) {
    case ErrorCode::FileUnknown: return ControlError::NoFile;
    case ErrorCode::StorageBusy:
    case ErrorCode::StorageUnavailable: return ControlError::NoSpace;
    default: return ControlError::Failed;
  }
}

/// Waits for a function that calls `done` on another thread.
template <class T, class Begin>
control_link::ControlResult<T> wait_for(const Begin& begin) {
  auto result = wait_for_result<T>(begin);
  if (!result) return refusal_of(result.error());
  return *std::move(result);
}

std::string_view file_name_of(std::string_view path) { return path.substr(path.rfind('\\') + 1); }

}  // namespace

control_link::ControlResult<interpreter::ControlPath> file_path(std::string_view text,
                                                                std::string_view directory) {
  auto path = interpreter::ControlPath::parse(absolute(text, directory));
  if (!path) return ControlError::BadFileName;
  return *std::move(path);
}

control_link::ControlResult<std::string> directory_path(std::string_view text,
                                                        std::string_view directory) {
  std::string path = absolute(text, directory);
  while (path.ends_with('\\')) path.pop_back();
  if (ascii_iequals(path, kRoot.substr(0, 4))) return std::string(kRoot);
  const auto parsed = interpreter::ControlPath::parse(path);
  if (!parsed) return ControlError::BadFileName;
  return parsed->text() + "\\";
}

std::string_view parent_of(std::string_view directory) {
  directory.remove_suffix(1);
  const std::string_view parent = directory.substr(0, directory.rfind('\\') + 1);
  return parent.empty() ? kRoot : parent;
}

std::map<std::string, std::pair<const interpreter::WrittenFile*, Timestamp>>
VirtualDisk::run_files() {
  std::map<std::string, std::pair<const interpreter::WrittenFile*, Timestamp>> found;
  const auto run = runs_.newest();
  if (run == nullptr) return found;
  if (run->id() != run_) hidden_.clear();
  run_ = run->id();
  newest_files_ = run->look(app::Look::StateAndFiles, kPatience).files;
  if (newest_files_ == nullptr) return found;
  for (const interpreter::WrittenFile& file : *newest_files_) {
    std::string key = file.path.key();
    if (!hidden_.contains(key)) found.emplace(std::move(key), std::pair(&file, run->created_at()));
  }
  return found;
}

VirtualDisk::Answer<std::map<std::string, DiskEntry>> VirtualDisk::files_below(
    std::string_view prefix) {
  auto stored = TRY(wait_for<std::vector<app::DiskFile>>(
      [&](auto done) { files_.list(std::string(prefix), std::move(done)); }));
  std::map<std::string, DiskEntry> entries;
  for (app::DiskFile& file : stored) {
    std::string key = ascii_lower(file.path);
    entries[std::move(key)] = {.name = std::move(file.path),
                               .is_directory = false,
                               .size = file.size,
                               .modified_at = file.modified_at};
  }
  const std::string below = ascii_lower(prefix);
  for (const auto& [key, written] : run_files()) {
    const auto& [file, time] = written;
    if (!ascii_lower(key).starts_with(below)) continue;
    entries[ascii_lower(key)] = {.name = file->path.text(),
                                 .is_directory = false,
                                 .size = static_cast<std::int64_t>(file->bytes.size()),
                                 .modified_at = time};
  }
  return entries;
}

bool VirtualDisk::has_directory(std::string_view directory) {
  if (is_every_controls(directory)) return true;
  const std::string key = ascii_lower(directory);
  const auto made = made_.lower_bound(key);
  if (made != made_.end() && made->first.starts_with(key)) return true;
  const auto below = files_below(directory);
  return below && !below->empty();
}

VirtualDisk::Answer<std::vector<DiskEntry>> VirtualDisk::list(std::string_view directory) {
  if (!has_directory(directory)) return ControlError::NoDirectory;
  const auto below = TRY(files_below(directory));
  std::map<std::string, DiskEntry> directories;
  std::vector<DiskEntry> files;
  const auto add_directory = [&](std::string_view path, Timestamp time) {
    const std::string_view rest = path.substr(directory.size());
    const std::string_view name = rest.substr(0, rest.find('\\'));
    if (name.empty() || name.size() == rest.size()) return;
    DiskEntry& entry = directories[ascii_lower(name)];
    if (entry.name.empty()) entry.name = name;
    entry.is_directory = true;
    entry.modified_at = std::max(entry.modified_at, time);
  };
  for (const std::string_view path : kEveryControls) {
    if (path.size() > directory.size() &&
        ascii_iequals(path.substr(0, directory.size()), directory)) {
      add_directory(path, {});
    }
  }
  const std::string key = ascii_lower(directory);
  for (auto made = made_.lower_bound(key); made != made_.end() && made->first.starts_with(key);
       ++made) {
    add_directory(made->second, {});
  }
  for (const auto& [path, entry] : below) {
    add_directory(entry.name, entry.modified_at);
    if (entry.name.find('\\', directory.size()) != std::string::npos) continue;
    files.push_back(entry);
    files.back().name = file_name_of(entry.name);
  }
  std::vector<DiskEntry> entries;
  for (auto& [name, entry] : directories) entries.push_back(std::move(entry));
  std::move(files.begin(), files.end(), std::back_inserter(entries));
  return entries;
}

void VirtualDisk::keep_directory(std::string_view directory) {
  if (made_bytes_ + directory.size() > kMostMadeBytes) return;
  if (made_.emplace(ascii_lower(directory), directory).second) made_bytes_ += directory.size();
}

VirtualDisk::Answer<void> VirtualDisk::make_directory(std::string_view directory) {
  if (has_directory(directory)) return ControlError::FileExists;
  if (!has_directory(parent_of(directory))) return ControlError::NoDirectory;
  if (made_bytes_ + directory.size() > kMostMadeBytes) return ControlError::NoSpace;
  keep_directory(directory);
  return {};
}

VirtualDisk::Answer<void> VirtualDisk::remove_directory(std::string_view directory) {
  if (is_every_controls(directory)) return ControlError::InUse;
  const auto entries = TRY(list(directory));
  if (!entries.empty()) return ControlError::DirectoryNotEmpty;
  // The directory above may have been there only for this one.
  if (!is_every_controls(parent_of(directory))) keep_directory(parent_of(directory));
  made_bytes_ -= made_.erase(ascii_lower(directory)) * directory.size();
  return {};
}

VirtualDisk::Answer<DiskEntry> VirtualDisk::find(const Path& path) {
  auto entries = TRY(files_below(path.text()));
  const auto found = entries.find(ascii_lower(path.text()));
  if (found == entries.end()) return ControlError::NoFile;
  DiskEntry entry = std::move(found->second);
  entry.name = file_name_of(entry.name);
  return entry;
}

VirtualDisk::Answer<std::shared_ptr<const std::string>> VirtualDisk::read(const Path& path) {
  const auto written = run_files();
  if (const auto found = written.find(path.key()); found != written.end()) {
    return std::make_shared<const std::string>(found->second.first->bytes);
  }
  auto file = TRY(wait_for<app::DiskFile>([&](auto done) { files_.read(path, std::move(done)); }));
  return std::make_shared<const std::string>(std::move(file.bytes));
}

VirtualDisk::Answer<void> VirtualDisk::write(const Path& path, std::string_view bytes) {
  if (!has_directory(path.directory())) return ControlError::NoDirectory;
  TRY(wait_for<bool>(
      [&](auto done) { files_.write(path, bytes, std::nullopt, {}, std::move(done)); }));
  hide(path);
  return {};
}

VirtualDisk::Answer<void> VirtualDisk::remove(const Path& path) {
  TRY(find(path));
  const auto removed = wait_for<bool>(
      [&](auto done) { files_.remove(path, std::nullopt, {}, {}, std::move(done)); });
  // A file of only the run: nothing is stored of it.
  if (!removed && removed.error() != ControlError::NoFile) return removed.error();
  hide(path);
  keep_directory(path.directory());
  return {};
}

VirtualDisk::Answer<void> VirtualDisk::copy(const Path& source, const Path& target) {
  const auto bytes = TRY(read(source));
  if (find(target)) return ControlError::FileExists;
  return write(target, *bytes);
}

}  // namespace fitgauge::virtual_control
