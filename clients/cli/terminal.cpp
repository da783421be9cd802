#include "cli/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

#include "base/text.hpp"

namespace fitgauge::cli {
namespace {

int code_of(Colour colour) {
  switch (colour) {
    case Colour::Red: return 31;
    case Colour::Green: return 32;
    case Colour::Yellow: return 33;
    case Colour::Blue: return 34;
    case Colour::Cyan: break;
  }
  return 36;
}

bool is_utf8(const Environment& environment) {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const std::string locale = ascii_lower(environment(name));
    if (locale.empty()) continue;
    return locale.find("utf-8") != std::string::npos || locale.find("utf8") != std::string::npos;
  }
  return false;
}

}  // namespace

std::string Terminal::painted(std::string_view text, Colour wanted) const {
  if (!colour) return std::string(text);
  return fmt::format("\x1b[{}m{}\x1b[0m", code_of(wanted), text);
}

std::string environment_variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

Terminal terminal_of(bool interactive, const Environment& environment) {
  return {
      .interactive = interactive,
      .unicode = is_utf8(environment),
      .colour = interactive && environment("NO_COLOR").empty() && environment("TERM") != "dumb"};
}

Terminal terminal_of(int descriptor) {
  return terminal_of(isatty(descriptor) != 0, environment_variable);
}

}  // namespace fitgauge::cli
