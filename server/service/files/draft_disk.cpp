#include "service/files/draft_disk.hpp"

namespace fitgauge::app {

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
