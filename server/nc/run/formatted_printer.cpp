#include "nc/run/formatted_printer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace fitgauge::interpreter {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += line;
    text += '\n';
  }
  return text;
}

}  // namespace

NcResult<std::shared_ptr<const klartext::MaskFile>> FormattedPrinter::mask(
    const ControlPath& path) {
  const auto revision = files_.revision(path);
  Known& known = masks_[path.key()];
  if (known.mask == nullptr || known.revision != revision) {
    const auto file = files_.find(path);
    if (!file) return nc_error(fmt::format("mask {} does not exist", path.text()));
    auto parsed = klartext::parse_mask(*file->bytes, file->path.text());
    const auto error =
        std::find_if(parsed.diagnostics.begin(), parsed.diagnostics.end(),
                     [](const auto& found) { return found.severity == klartext::Severity::Error; });
    if (error != parsed.diagnostics.end()) {
      return nc_error(
          fmt::format("mask {} line {}: {}", path.text(), error->range.begin.line, error->message));
    }
    known = {file->revision, std::make_shared<const klartext::MaskFile>(std::move(parsed.mask))};
  }
  return known.mask;
}

NcResult<void> FormattedPrinter::print(const PrintedMask& printed, const ControlPath& path) {
  if (auto reserved = files_.reserve(path); !reserved) return reserved;
  Output& output = outputs_.try_emplace(path.key(), Output{path, {}, false, {}}).first->second;
  if (printed.truncate) output = {path, {}, false, {}};
  output.append = output.append || printed.append;
  if (printed.most_bytes) output.most_bytes = printed.most_bytes;
  std::string text = joined(printed.lines);
  if (auto charged = budget_.charge(text.size()); !charged) return charged;
  output.text += text;
  if (!printed.close) return {};
  const Output closed = std::move(output);
  outputs_.erase(path.key());
  return write(closed);
}

NcResult<void> FormattedPrinter::write(const Output& output) {
  if (!output.append) return files_.write(output.path, output.text);
  std::string_view text = output.text;
  if (output.most_bytes) {
    const auto file = files_.find(output.path);
    const std::size_t size = file ? file->bytes->size() : 0;
    // A file that has reached its size takes no further entry.
    if (size + text.size() > *output.most_bytes) return {};
  }
  return files_.append(output.path, text);
}

NcResult<void> FormattedPrinter::close() {
  auto outputs = std::exchange(outputs_, {});
  for (const auto& [key, output] : outputs) {
    if (auto done = write(output); !done) return done;
  }
  return {};
}

}  // namespace fitgauge::interpreter
