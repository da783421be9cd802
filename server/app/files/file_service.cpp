#include "app/files/file_service.hpp"

#include "store/database.hpp"

namespace fitgauge::app {
namespace {

Error unknown(const interpreter::ControlPath& path) {
  return {ErrorCode::FileUnknown, "there is no file " + path.text() + " on the control's disk"};
}

DiskFile disk_file(store::FileEntry entry) {
  return {.path = std::move(entry.path),
          .revision = entry.revision,
          .size = entry.size,
          .modified_at = {entry.modified_at_ns}};
}

}  // namespace

void FileService::write(interpreter::ControlPath path, std::string_view bytes,
                        std::optional<std::string> caller, Done<Written> done) {
  database_.writer().submit(
      [path = std::move(path), bytes, caller = std::move(caller),
       now = clock_.now()](store::Stores& stores) -> Result<Written> {
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
                         Done<bool> done) {
  database_.writer().submit(
      [path = std::move(path), caller = std::move(caller),
       now = clock_.now()](store::Stores& stores) -> Result<bool> {
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
