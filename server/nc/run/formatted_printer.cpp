#include "nc/run/statements.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::MaskControl;
using klartext::MaskControlKind;
using klartext::MaskConversion;
using klartext::MaskKeyword;
using klartext::MaskLanguage;
using klartext::MaskPlaceholder;

using Value = std::variant<double, std::string>;

Value keyword_value(const Channel& channel, MaskKeyword keyword) {
  const CivilTime time = civil_time(channel.now());
  switch (keyword) {
    case MaskKeyword::CallPath: return channel.linked().path().text();
    case MaskKeyword::Hour: return double(time.hour);
    case MaskKeyword::Minute: return double(time.minute);
    case MaskKeyword::Second: return double(time.second);
    case MaskKeyword::Day: return double(time.day);
    case MaskKeyword::Month: return double(time.month);
    case MaskKeyword::MonthName: return std::string(month_name(time.month));
    case MaskKeyword::Year2: return double(time.year % 100);
    case MaskKeyword::Year4: return double(time.year);
  }
  return 0.0;
}

/// Pads digits to the width: `0` fills after the sign.
std::string padded(std::string text, const MaskPlaceholder& placeholder, bool is_number) {
  const auto width = static_cast<std::size_t>(placeholder.width);
  const std::size_t size = tabfile::count_characters(text);
  if (size >= width) return text;
  const std::size_t fill = width - size;
  if (placeholder.left) return text + std::string(fill, ' ');
  if (placeholder.zero && is_number) {
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    return text.insert(sign, fill, '0');
  }
  return std::string(fill, ' ') + text;
}

/// Truncates (decision 22); a precision is the least number of digits: `%02.2d`.
std::string integer_text(double value, const MaskPlaceholder& placeholder) {
  std::string digits = fmt::format("{:.0f}", std::abs(std::trunc(value)));
  const auto least = static_cast<std::size_t>(std::max(placeholder.decimals, 0));
  if (digits.size() < least) digits.insert(0, least - digits.size(), '0');
  if (value <= -1) digits.insert(0, 1, '-');
  return padded(std::move(digits), placeholder, true);
}

NcResult<std::string> character_text(double value, const MaskPlaceholder& placeholder) {
  // Codes beyond Latin-1 are not in the code page of a control.
  if (value < 1 || value > 255) return nc_error("%C: {} is not a character code", value);
  std::string text;
  append_utf8(text, static_cast<char32_t>(value));
  return padded(std::move(text), placeholder, false);
}

std::string string_text(std::string text, const MaskPlaceholder& placeholder) {
  if (placeholder.decimals >= 0)
    text.resize(tabfile::skip_characters(text, 0, static_cast<std::size_t>(placeholder.decimals)));
  return padded(std::move(text), placeholder, false);
}

NcResult<std::string> formatted(const Value& value, const MaskPlaceholder& placeholder) {
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) return string_text(std::get<std::string>(value), placeholder);
  constexpr int kDefaultDecimals = 6;  // of %F, as in C
  const int decimals = placeholder.decimals;
  switch (placeholder.conversion) {
    case MaskConversion::Float:
      return padded(to_char(*number, decimals < 0 ? kDefaultDecimals : decimals), placeholder,
                    true);
    case MaskConversion::Integer: return integer_text(*number, placeholder);
    case MaskConversion::Character: return character_text(*number, placeholder);
    default: return string_text(to_char(*number, -1), placeholder);
  }
}

/// The mask's treatment of lines whose QS is undefined or empty.
enum class EmptyLines : std::uint8_t {
  Unspecified,  ///< an undefined QS is an error (decision 3)
  Hide,         ///< M_EMPTY_HIDE: such lines are left out
  Show          ///< M_EMPTY_SHOW: the value prints as nothing
};

/// The value of a placeholder; nothing if its line is left out.
NcResult<std::optional<Value>> value_of(Channel& channel, const MaskPlaceholder& placeholder,
                                        EmptyLines empty) {
  if (const auto* keyword = std::get_if<MaskKeyword>(&placeholder.value))
    return std::optional(keyword_value(channel, *keyword));
  const QRef parameter = std::get<QRef>(placeholder.value);
  if (parameter.is_string()) {
    const std::string* known = channel.parameters.string(parameter.number);
    const bool is_empty = known == nullptr || known->empty();
    if (is_empty && empty == EmptyLines::Hide) return std::optional<Value>();
    if (is_empty && empty == EmptyLines::Show) return std::optional<Value>(std::string());
    return std::optional<Value>(TRY(text(channel, parameter)));
  }
  const auto value = TRY(number(channel, parameter));
  return std::optional<Value>(value);
}

/// One line of a mask with its values, or nothing when it is left out.
/// @errors an undefined parameter, a character code out of range.
NcResult<std::optional<std::string>> format_line(Channel& channel,
                                                 const klartext::MaskFormat& format,
                                                 EmptyLines empty) {
  std::string line;
  for (const klartext::MaskPiece& piece : format.pieces) {
    if (const auto* literal = std::get_if<std::string>(&piece)) {
      line += *literal;
      continue;
    }
    const auto& placeholder = std::get<MaskPlaceholder>(piece);
    const auto value = TRY(value_of(channel, placeholder, empty));
    if (!value) return std::optional<std::string>();
    const auto text = TRY(formatted(*value, placeholder));
    line += text;
  }
  return std::optional(std::move(line));
}

void apply(const MaskControl& control, PrintedMask& printed, EmptyLines& empty) {
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

}  // namespace

NcResult<std::shared_ptr<const klartext::MaskFile>> FormattedPrinter::mask(
    const ControlPath& path) {
  const auto revision = files_.revision(path);
  Known& known = masks_[path.key()];
  if (known.mask == nullptr || known.revision != revision) {
    const auto file = files_.find(path);
    if (!file) return nc_error("mask {} does not exist", path.text());
    auto parsed = klartext::parse_mask(*file->bytes, file->path.text());
    const auto error =
        std::ranges::find(parsed.diagnostics, Severity::Error, &Diagnostic::severity);
    if (error != parsed.diagnostics.end())
      return nc_error("mask {} line {}: {}", path.text(), error->range.begin.line, error->message);
    known = {file->revision, std::make_shared<const klartext::MaskFile>(std::move(parsed.mask))};
  }
  return known.mask;
}

NcResult<void> FormattedPrinter::print(const PrintedMask& printed, const ControlPath& path) {
  TRY(files_.reserve(path));
  Output& output = outputs_.try_emplace(path.key(), Output{path, {}, false, {}}).first->second;
  if (printed.truncate) output = {path, {}, false, {}};
  output.append = output.append || printed.append;
  if (printed.most_bytes) output.most_bytes = printed.most_bytes;
  std::string text;
  for (const std::string& line : printed.lines) text.append(line).append("\n");
  TRY(budget_.charge(text.size()));
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
    // A file of maximum size accepts no further entry.
    if (size + text.size() > *output.most_bytes) return {};
  }
  return files_.append(output.path, text);
}

NcResult<void> FormattedPrinter::close() {
  auto outputs = std::exchange(outputs_, {});
  for (const auto& [key, output] : outputs) TRY(write(output));
  return {};
}

NcResult<PrintedMask> run_mask(Channel& channel, const klartext::MaskFile& mask) {
  PrintedMask printed;
  EmptyLines empty = EmptyLines::Unspecified;
  bool is_spoken = true;
  std::size_t bytes = 0;
  for (const klartext::MaskLine& line : mask.lines) {
    TRY(channel.budget.check());
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
      // A short mask can make long lines: text beyond the budget is not stored at all.
      if (bytes > channel.output.left()) return channel.output.charge(bytes).error();
      // An escape `\n` in a line ends it.
      for (const std::string_view part : split(**text, '\n')) printed.lines.emplace_back(part);
    }
  }
  return printed;
}

}  // namespace fitgauge::interpreter
