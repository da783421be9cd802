#include "service/files/file_service.hpp"

#include "db/store/database.hpp"
#include "db/store/stores.hpp"
#include "service/documents/document_service.hpp"

namespace fitgauge::app {
namespace {

Error unknown(const interpreter::ControlPath& path) {
  return {ErrorCode::FileUnknown, "file not found: " + path.text()};
}

/// @errors PreconditionFailed
Result<void> check_change(const FileService::Precondition& precondition, const Stores& stores,
                          const interpreter::ControlPath& path) {
  if (!precondition) return {};
  const auto file = stores.files.find(path.text());
  if (precondition(file ? std::optional<std::string_view>(file->content) : std::nullopt)) return {};
  return precondition_failed(path.text(), file.has_value());
}

}  // namespace

Result<interpreter::ControlPath> parse_file_path(std::string_view text) {
  constexpr std::string_view kLetters = kDrive.substr(0, kDrive.size() - 1);  // before \ or /
  if (ascii_iequals(trim(text).substr(0, kLetters.size()), kLetters) || text.empty()) {
    return interpreter::ControlPath::parse(text);
  }
  if (text.starts_with(kFiles)) text.remove_prefix(kFiles.size());
  return interpreter::ControlPath::parse(std::string(kDrive).append(text));
}

std::optional<interpreter::ControlFile> StoredDisk::find(
    const interpreter::ControlPath& path) const {
  auto found = database_.readers().wait(
      [&path](const Stores& stores) { return stores.files.find(path.text()); });
  if (!found) throw store::StorageFailure(found.error());
  if (!*found) return std::nullopt;
  store::FileContent& file = **found;
  return interpreter::ControlFile{
      .path = interpreter::ControlPath::parse(file.path).value(),
      .bytes = std::make_shared<const std::string>(std::move(file.content)),
      .revision = std::to_string(file.revision),
      .source = interpreter::FileSource::Stored};
}

std::optional<std::string> StoredDisk::revision(const interpreter::ControlPath& path) const {
  const auto found = database_.readers().wait(
      [&path](const Stores& stores) { return stores.files.stat(path.text()); });
  if (!found) throw store::StorageFailure(found.error());
  if (!*found) return std::nullopt;
  return std::to_string((*found)->revision);
}

bool StoredDisk::has_directory(std::string_view directory) const {
  const auto found = database_.readers().wait(
      [directory](const Stores& stores) { return !stores.files.list(directory).empty(); });
  if (!found) throw store::StorageFailure(found.error());
  return *found;
}

void FileService::write(interpreter::ControlPath path, std::string_view bytes,
                        std::optional<std::string> caller, Precondition precondition,
                        Done<bool> done) {
  database_.writer().submit(
      [path = std::move(path), bytes, caller = std::move(caller),
       precondition = std::move(precondition), now = clock_.now()](Stores& stores) -> Result<bool> {
        TRY(check_change(precondition, stores, path));
        return stores.files
            .put({.path = path.text(),
                  .content = bytes,
                  .modified_at_ns = now.nanoseconds,
                  .caller = caller})
            .created;
      },
      std::move(done));
}

void FileService::read(interpreter::ControlPath path, Done<store::FileContent> done) {
  database_.readers().submit(
      [path = std::move(path)](const Stores& stores) -> Result<store::FileContent> {
        auto found = stores.files.find(path.text());
        if (!found) return unknown(path);
        return *std::move(found);
      },
      std::move(done));
}

void FileService::remove(interpreter::ControlPath path, std::optional<std::string> caller,
                         Precondition precondition, std::vector<std::string> users,
                         Done<bool> done) {
  database_.writer().submit(
      [path = std::move(path), caller = std::move(caller), precondition = std::move(precondition),
       users = std::move(users), now = clock_.now()](Stores& stores) mutable -> Result<bool> {
        if (!stores.files.stat(path.text())) return unknown(path);
        for (const auto& [kind, member] :
             {std::pair{DocumentKind::Setup, "file"}, std::pair{DocumentKind::Plan, "picture"}}) {
          add_users(users, stores, kind, [&path, name = member](const JsonValue& each) {
            const auto named = parse_file_path(each.text_of(name));
            return named && *named == path;
          });
        }
        TRY(check_unused(path.text(), users));
        TRY(check_change(precondition, stores, path));
        if (!stores.files.remove(path.text(), now.nanoseconds, caller)) return unknown(path);
        return true;
      },
      std::move(done));
}

void FileService::list(std::string prefix, Done<std::vector<store::FileEntry>> done) {
  database_.readers().submit(
      [prefix = std::move(prefix)](const Stores& stores) { return stores.files.list(prefix); },
      std::move(done));
}

}  // namespace fitgauge::app
