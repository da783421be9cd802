#include "service/files/disks.hpp"

#include <utility>

#include "db/store/database.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::app {

std::optional<interpreter::ControlFile> StoredDisk::find(
    const interpreter::ControlPath& path) const {
  auto found = database_.readers().wait(
      [&path](const store::Stores& stores) -> Result<std::optional<store::FileContent>> {
        return stores.files.find(path.text());
      });
  if (!found) throw store::StorageFailure(found.error());
  if (!*found) return std::nullopt;
  store::FileContent& file = **found;
  return interpreter::ControlFile{
      .path = interpreter::ControlPath::parse(file.entry.path).value(),
      .bytes = std::make_shared<const std::string>(std::move(file.content)),
      .revision = std::to_string(file.entry.revision),
      .source = interpreter::FileSource::Stored};
}

std::optional<std::string> StoredDisk::revision(const interpreter::ControlPath& path) const {
  const auto found = database_.readers().wait(
      [&path](const store::Stores& stores) -> Result<std::optional<store::FileEntry>> {
        return stores.files.stat(path.text());
      });
  if (!found) throw store::StorageFailure(found.error());
  if (!*found) return std::nullopt;
  return std::to_string((*found)->revision);
}

bool StoredDisk::has_directory(std::string_view directory) const {
  const auto found = database_.readers().wait([directory](const store::Stores& stores) {
    return Result<bool>(!stores.files.list(directory).empty());
  });
  if (!found) throw store::StorageFailure(found.error());
  return *found;
}

using interpreter::ControlFile;
using interpreter::ControlPath;

// Like what a run writes, a draft has no revision that a cache could know it by.
DraftDisk::DraftDisk(const interpreter::ControlDisk& inner, const ControlPath& path,
                     std::string text)
    : inner_(inner),
      draft_{.path = path,
             .bytes = std::make_shared<const std::string>(std::move(text)),
             .revision = "draft",
             .source = interpreter::FileSource::Run} {}

std::optional<ControlFile> DraftDisk::find(const ControlPath& path) const {
  return path.key() == draft_.path.key() ? draft_ : inner_.find(path);
}

std::optional<std::string> DraftDisk::revision(const ControlPath& path) const {
  return path.key() == draft_.path.key() ? draft_.revision : inner_.revision(path);
}

bool DraftDisk::has_directory(std::string_view directory) const {
  return inner_.has_directory(directory);
}

}  // namespace fitgauge::app
