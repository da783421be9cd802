#include "service/files/file_service.hpp"

#include "db/store/database.hpp"

namespace fitgauge::app {
namespace {

Error unknown(const interpreter::ControlPath& path) {
  return {ErrorCode::FileUnknown, "there is no file " + path.text() + " on the control's disk"};
}

Error changed(const interpreter::ControlPath& path) {
  return {
      ErrorCode::PreconditionFailed,
      path.text() + " is not in the state that the request's precondition names: read it again"};
}

std::optional<std::int64_t> revision_of(const store::Stores& stores,
                                        const interpreter::ControlPath& path) {
  const auto file = stores.files.stat(path.text());
  return file ? std::optional(file->revision) : std::nullopt;
}

DiskFile disk_file(store::FileEntry entry) {
  return {.path = std::move(entry.path),
          .revision = entry.revision,
          .size = entry.size,
          .modified_at = {entry.modified_at_ns}};
}

}  // namespace

void FileService::write(interpreter::ControlPath path, std::string_view bytes,
                        std::optional<std::string> caller, Precondition precondition,
                        Done<Written> done) {
  database_.writer().submit(
      [path = std::move(path), bytes, caller = std::move(caller),
       precondition = std::move(precondition),
       now = clock_.now()](store::Stores& stores) -> Result<Written> {
        if (precondition && !precondition(revision_of(stores, path))) return changed(path);
        const auto put = stores.files.put({.path = path.text(),
                                           .content = bytes,
                                           .modified_at_ns = now.nanoseconds,
                                           .caller = caller});
        return Written{.created = put.created, .revision = put.revision};
      },
      std::move(done));
}

void FileService::read(interpreter::ControlPath path, Done<DiskFile> done) {
  database_.readers().submit(
      [path = std::move(path)](const store::Stores& stores) -> Result<DiskFile> {
        auto found = stores.files.find(path.text());
        if (!found) return unknown(path);
        DiskFile file = disk_file(std::move(found->entry));
        file.bytes = std::move(found->content);
        return file;
      },
      std::move(done));
}

void FileService::remove(interpreter::ControlPath path, std::optional<std::string> caller,
                         Precondition precondition, Done<bool> done) {
  database_.writer().submit(
      [path = std::move(path), caller = std::move(caller), precondition = std::move(precondition),
       now = clock_.now()](store::Stores& stores) -> Result<bool> {
        const auto revision = revision_of(stores, path);
        if (!revision) return unknown(path);
        if (precondition && !precondition(revision)) return changed(path);
        if (!stores.files.remove(path.text(), now.nanoseconds, caller)) return unknown(path);
        return true;
      },
      std::move(done));
}

void FileService::list(std::string prefix, Done<std::vector<DiskFile>> done) {
  database_.readers().submit(
      [prefix = std::move(prefix)](const store::Stores& stores) -> Result<std::vector<DiskFile>> {
        std::vector<DiskFile> files;
        for (store::FileEntry& entry : stores.files.list(prefix)) {
          files.push_back(disk_file(std::move(entry)));
        }
        return files;
      },
      std::move(done));
}

}  // namespace fitgauge::app
