#include "cli/nc_commands.hpp"

#include "cli/local_files.hpp"
#include "service/runs/control_files.hpp"

namespace fitgauge::cli {
namespace {

namespace fs = std::filesystem;

bool is_made(const interpreter::ControlPath& path) {
  const std::string_view name = path.file_name();
  return ascii_iequals(name, "82553_hole.tab") || ascii_iequals(name, "82553_shaft.tab");
}

/// The tables are made when a program reads one, because this takes longer than a check.
const interpreter::ControlDisk& made_tables() {
  static const interpreter::MemoryDisk kNothing;
  static const interpreter::ProjectingDisk kTables(
      kNothing,
      app::project(iso286::ToleranceTables::make(iso286::compiled_in_tables(), {}).value()));
  return kTables;
}

}  // namespace

std::string relative_of(std::string_view path) {
  std::string relative(path.substr(path.find('\\') + 1));
  std::ranges::replace(relative, '\\', '/');
  return relative;
}

std::optional<fs::path> find_below(const fs::path& folder, std::string_view path) {
  fs::path found = folder;
  std::error_code failed;
  for (const fs::path& part : fs::path(relative_of(path))) {
    if (fs::exists(found / part, failed)) {
      found /= part;
      continue;
    }
    const auto entries = fs::directory_iterator(found, failed);
    const auto same = std::find_if(begin(entries), end(entries), [&part](const auto& entry) {
      return ascii_iequals(entry.path().filename().string(), part.string());
    });
    if (same == end(entries)) return std::nullopt;
    found = same->path();
  }
  return fs::is_regular_file(found, failed) ? std::optional(found) : std::nullopt;
}

FolderDisk::FolderDisk(const std::string& file) : folder_(fs::path(file).parent_path()) {
  if (folder_.empty()) folder_ = ".";
}

std::optional<interpreter::ControlFile> FolderDisk::find(
    const interpreter::ControlPath& path) const {
  const auto found = local(path.text());
  if (!found) return is_made(path) ? made_tables().find(path) : std::nullopt;
  auto bytes = read_file(found->string());
  if (!bytes) return std::nullopt;
  return interpreter::ControlFile{path, std::make_shared<const std::string>(*std::move(bytes)),
                                  "local"};
}

std::optional<std::string> FolderDisk::revision(const interpreter::ControlPath& path) const {
  return local(path.text()) || is_made(path) ? std::optional<std::string>("local") : std::nullopt;
}

bool FolderDisk::has_directory(std::string_view directory) const {
  std::error_code failed;
  return fs::is_directory(folder_ / relative_of(directory), failed);
}

std::string FolderDisk::name_here(const std::string& path) const {
  const auto here = local(path);
  return here ? here->lexically_normal().generic_string() : path;
}

Outcome<interpreter::ControlPath> local_program(const std::string& file) {
  if (std::error_code failed; fs::exists(file, failed) && !fs::is_regular_file(file, failed))
    return Failure{ExitCode::LocalFile, file + ": is not a file: save the program to a file"};
  if (const auto readable = read_file(file); !readable) {
    const std::string& why = readable.error().message;
    return Failure{ExitCode::LocalFile, why + "; --from-control uses a program of the service"};
  }
  auto name = interpreter::ControlPath::parse("TNC:\\" + fs::path(file).filename().string());
  if (name) return *std::move(name);
  return Failure{ExitCode::LocalFile, file + ": " + name.error().message};
}

}  // namespace fitgauge::cli
