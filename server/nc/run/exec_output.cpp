#include "nc/program/link_check.hpp"
#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::MaskControl;
using klartext::MaskControlKind;
using klartext::MaskLanguage;

/// FN 15: output that a control collects during a program run.
constexpr std::string_view kPrintFile = "%FN15RUN.A";

/// Prints a number with its sign, a text unchanged.
NcResult<std::string> printed(Channel& channel, const Expr& item) {
  if (is_text(item)) return text(channel, item);
  const auto value = TRY(number(channel, item));
  // Four decimals without trailing zeros, as controls print them.
  constexpr int kDecimals = 4;
  std::string text = to_char(value, kDecimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  if (channel.options.decimal_comma) std::replace(text.begin(), text.end(), '.', ',');
  return (text.front() == '-' ? "" : "+") + text;
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

/// An escape `\n` in a line ends it.
void add_lines(std::string_view text, std::vector<std::string>& lines) {
  std::size_t end = 0;
  while ((end = text.find('\n')) != std::string_view::npos) {
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  lines.emplace_back(text);
}

/// @errors those of its lines, with their place in the mask; limit.
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
      add_lines(**text, printed.lines);
    }
  }
  return printed;
}

/// A device that the simulated control does not have: `RS232:`, `PRINTER:`.
bool is_device(std::string_view target) {
  return target.find(':') != std::string_view::npos && !ascii_iequals(target.substr(0, 4), "TNC:");
}

}  // namespace

NcResult<void> execute(Channel& channel, const klartext::ErrorStop& stop) {
  const auto code = TRY(whole(channel, stop.number));
  if (code >= 1000 && code < 1200 && !probing::error_text(code).empty()) return nc_error(code);
  return NcError{FaultKind::Error, code, fmt::format("FN 14: Error code {}", code)};
}

NcResult<void> execute(Channel& channel, const klartext::Print& print) {
  std::string line;
  for (const Expr& item : channel.program().view(print.items)) {
    const auto part = TRY(printed(channel, item));
    if (!line.empty()) line += "  ";
    line += part;
  }
  line += '\n';
  return channel.files.append(channel.linked().path().beside(kPrintFile), line);
}

NcResult<void> execute(Channel& channel, const klartext::FormattedPrint& print) {
  const auto name = TRY(text(channel, print.mask));
  const auto target = TRY(text(channel, print.target));
  const auto path = TRY(channel.resolve(name));
  if (ascii_iequals(trim(target), "SCLR:")) return {};  // closes the window; its lines stay
  const auto mask = TRY(channel.printer.mask(path));
  const auto printed = TRY(run_mask(channel, *mask));
  if (ascii_iequals(trim(target), "SCREEN:")) {
    for (const std::string& line : printed.lines) TRY(channel.log.print(line));
    return {};
  }
  if (is_device(target)) return channel.note("FN 16: nothing is connected to {}", target);
  const auto file = TRY(channel.resolve_printed(target));
  return channel.printer.print(printed, file);
}

NcResult<void> execute(Channel& channel, const klartext::ExternalFunction& function) {
  return channel.note("FN {} reaches outside of the program and has no effect here", function.fn);
}

NcResult<void> execute(Channel& channel, const klartext::BlankForm&) {
  const auto value = [&](const Expr& written) {
    const auto known = number(channel, written);
    return known ? std::optional(*known) : std::nullopt;
  };
  const auto gives_corner = [&](const Place& call) {
    return call.program != &channel.linked() && has_lower_corner(call.program->program());
  };
  for (std::string& fault : blank_faults(channel.program(), channel.place().source(), value)) {
    if (fault == kNoLowerCorner && std::ranges::any_of(channel.calls.behind_calls(), gives_corner))
      continue;
    TRY(channel.note(std::move(fault)));
  }
  return {};
}

NcResult<void> execute(Channel& channel, const klartext::WaitFor& wait) {
  const std::string_view condition = channel.program().text(wait.condition);
  if (condition.empty() || condition == "SYNC") return {};
  return channel.note("FN 20: WAIT FOR {} does not wait here", condition);
}

}  // namespace fitgauge::interpreter
