#include "run/formatted_printer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "run/channel.hpp"
#include "run/mask_line.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::MaskControl;
using klartext::MaskControlKind;
using klartext::MaskLanguage;

/// One run through a mask: its lines in the language of the control, and what it says about the
/// file they go to.
struct Printed {
  std::vector<std::string> lines;
  bool close = false;
  bool append = false;
  bool truncate = false;
  std::optional<std::size_t> most_bytes;
};

void apply(const MaskControl& control, Printed& printed, EmptyLines& empty) {
  switch (control.kind) {
    case MaskControlKind::Close: printed.close = true; break;
    case MaskControlKind::AppendMax:
      printed.most_bytes = static_cast<std::size_t>(control.kilobytes) * 1024;
      [[fallthrough]];
    case MaskControlKind::Append: printed.append = true; break;
    case MaskControlKind::Truncate: printed.truncate = true; break;
    case MaskControlKind::EmptyHide: empty = EmptyLines::Hide; break;
    case MaskControlKind::EmptyShow: empty = EmptyLines::Show; break;
  }
}

/// An escape `\n` in a line ends it.
void add_lines(std::string_view text, std::vector<std::string>& lines) {
  std::size_t end = 0;
  while ((end = text.find('\n')) != std::string_view::npos) {
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  lines.emplace_back(text);
}

NcResult<Printed> run_mask(Channel& channel, const klartext::MaskFile& mask) {
  Printed printed;
  EmptyLines empty = EmptyLines::Unspecified;
  bool is_spoken = true;
  std::size_t bytes = 0;
  for (const klartext::MaskLine& line : mask.lines) {
    if (auto checked = channel.budget.check(); !checked) return checked.error();
    if (const auto* control = std::get_if<MaskControl>(&line.content)) {
      apply(*control, printed, empty);
    } else if (const auto* language = std::get_if<MaskLanguage>(&line.content)) {
      is_spoken = *language == MaskLanguage::All || *language == channel.options.language;
    } else if (is_spoken) {
      const auto text = format_line(channel, std::get<klartext::MaskFormat>(line.content), empty);
      if (!text) {
        NcError error = text.error();
        error.text = fmt::format("mask {} line {}: {}", mask.file_name, line.line, error.text);
        return error;
      }
      if (!*text) continue;
      bytes += (*text)->size() + 1;
      // A short mask can make long lines: what exceeds the budget is not even kept.
      if (bytes > channel.output.left()) return channel.output.charge(bytes).error();
      add_lines(**text, printed.lines);
    }
  }
  return printed;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += line;
    text += '\n';
  }
  return text;
}

/// A device that the simulated control does not have: `RS232:`, `PRINTER:`.
bool is_device(std::string_view target) {
  return target.find(':') != std::string_view::npos && !ascii_iequals(target.substr(0, 4), "TNC:");
}

}  // namespace

NcResult<std::shared_ptr<const klartext::MaskFile>> FormattedPrinter::load(
    Channel& channel, const ControlPath& path) {
  const auto revision = channel.files.revision(path);
  Known& known = masks_[path.key()];
  if (known.mask == nullptr || known.revision != revision) {
    const auto file = channel.files.find(path);
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

NcResult<void> FormattedPrinter::print(Channel& channel, const ControlPath& mask,
                                       std::string_view target) {
  if (ascii_iequals(trim(target), "SCLR:")) return {};  // closes the window; what it showed stays
  const auto loaded = load(channel, mask);
  if (!loaded) return loaded.error();
  const auto printed = run_mask(channel, **loaded);
  if (!printed) return printed.error();
  if (ascii_iequals(trim(target), "SCREEN:")) {
    for (const std::string& line : printed->lines) {
      if (auto done = channel.log.print(line); !done) return done;
    }
    return {};
  }
  if (is_device(target)) {
    return channel.note(fmt::format("FN 16: nothing is connected to {}", target));
  }
  const auto path = channel.resolve_printed(target);
  if (!path) return path.error();
  if (auto reserved = channel.files.reserve(*path); !reserved) return reserved;
  Output& output = outputs_.try_emplace(path->key(), Output{*path, {}, false, {}}).first->second;
  if (printed->truncate) output = {*path, {}, false, {}};
  output.append = output.append || printed->append;
  if (printed->most_bytes) output.most_bytes = printed->most_bytes;
  std::string text = joined(printed->lines);
  if (auto charged = channel.output.charge(text.size()); !charged) return charged;
  output.text += text;
  if (!printed->close) return {};
  const Output closed = std::move(output);
  outputs_.erase(path->key());
  return write(channel, closed);
}

NcResult<void> FormattedPrinter::write(Channel& channel, const Output& output) {
  if (!output.append) return channel.files.write(output.path, output.text);
  std::string_view text = output.text;
  if (output.most_bytes) {
    const auto file = channel.files.find(output.path);
    const std::size_t size = file ? file->bytes->size() : 0;
    // A file that has reached its size takes no further entry.
    if (size + text.size() > *output.most_bytes) return {};
  }
  return channel.files.append(output.path, text);
}

NcResult<void> FormattedPrinter::close(Channel& channel) {
  auto outputs = std::exchange(outputs_, {});
  for (const auto& [key, output] : outputs) {
    if (auto done = write(channel, output); !done) return done;
  }
  return {};
}

}  // namespace fitgauge::interpreter
