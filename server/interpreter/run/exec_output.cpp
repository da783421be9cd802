#include <fmt/format.h>

#include <algorithm>

#include "run/channel.hpp"
#include "run/statements.hpp"
#include "run/string_functions.hpp"
#include "run/values.hpp"

namespace fitgauge::interpreter {
namespace {

/// FN 15: what a control collects during a program run.
constexpr std::string_view kPrintFile = "%FN15RUN.A";

/// A number with its sign always, a text as it is.
NcResult<std::string> printed(Channel& channel, const klartext::Expr& item) {
  const auto* parameter = std::get_if<klartext::QRef>(&item);
  if (std::holds_alternative<klartext::Text>(item) ||
      (parameter != nullptr && parameter->is_string())) {
    return text(channel, item);
  }
  const auto value = number(channel, item);
  if (!value) return value.error();
  // Four decimals without trailing zeros, as controls print them.
  constexpr int kDecimals = 4;
  std::string text = to_char(*value, kDecimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  if (channel.options.decimal_comma) std::replace(text.begin(), text.end(), '.', ',');
  return (text.front() == '-' ? "" : "+") + text;
}

}  // namespace

NcResult<void> execute(Channel& channel, const klartext::ErrorStop& stop) {
  const auto code = whole(channel, stop.number);
  if (!code) return code.error();
  if (*code >= 1000 && *code < 1200 && !probing::error_text(*code).empty()) {
    return nc_error(*code);
  }
  return NcError{NcErrorKind::Error, *code, fmt::format("FN 14: Error code {}", *code)};
}

NcResult<void> execute(Channel& channel, const klartext::Print& print) {
  std::string line;
  for (const klartext::Expr& item : channel.program().view(print.items)) {
    const auto part = printed(channel, item);
    if (!part) return part.error();
    if (!line.empty()) line += "  ";
    line += *part;
  }
  line += '\n';
  return channel.files.append(channel.linked().path().beside(kPrintFile), line);
}

NcResult<void> execute(Channel& channel, const klartext::FormattedPrint& print) {
  const auto mask = text(channel, print.mask);
  if (!mask) return mask.error();
  const auto target = text(channel, print.target);
  if (!target) return target.error();
  const auto path = channel.resolve(*mask);
  if (!path) return path.error();
  return channel.printer.print(channel, *path, *target);
}

NcResult<void> execute(Channel& channel, const klartext::ExternalFunction& function) {
  return channel.note(
      fmt::format("FN {} reaches outside of the program and has no effect here", function.fn));
}

NcResult<void> execute(Channel& channel, const klartext::WaitFor& wait) {
  const std::string_view condition = channel.program().text(wait.condition);
  if (condition.empty() || condition == "SYNC") return {};
  return channel.note(fmt::format("FN 20: WAIT FOR {} does not wait here", condition));
}

}  // namespace fitgauge::interpreter
