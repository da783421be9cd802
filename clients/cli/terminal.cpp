#include "cli/context.hpp"

#include <unistd.h>

#include <cstdio>

namespace fitgauge::cli {
namespace {

bool is_utf8(const Environment& environment) {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const std::string locale = ascii_lower(environment(name));
    if (locale.empty()) continue;
    return locale.find("utf-8") != std::string::npos || locale.find("utf8") != std::string::npos;
  }
  return false;
}

constexpr std::uint64_t kBarWidth = 20;
constexpr const char* kErase = "\r\x1b[K";

std::string bar_of(std::uint64_t bytes, std::uint64_t in_all, bool unicode) {
  const std::uint64_t whole = std::max<std::uint64_t>(in_all, 1);
  const std::uint64_t done = std::min(bytes, whole);
  std::string bar;
  for (std::uint64_t i = 0; i < kBarWidth; ++i) {
    const bool filled = i < done * kBarWidth / whole;
    bar += unicode ? (filled ? "█" : "░") : (filled ? "#" : ".");
  }
  return fmt::format("{} {:3} %  ", bar, done * 100 / whole);
}

}  // namespace

std::string Terminal::painted(std::string_view text, Colour wanted) const {
  if (!colour) return std::string(text);
  return fmt::format("\x1b[{}m{}\x1b[0m", static_cast<int>(wanted), text);
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

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
  return text;
}

std::string format_progress(const Progress& progress, const Terminal& terminal) {
  std::string text = progress.name + "  ";
  if (progress.bytes_in_all)
    text += bar_of(progress.bytes, *progress.bytes_in_all, terminal.unicode);
  text += grouped(progress.rows) + " rows";
  if (progress.seconds > 0) {
    const double rate = static_cast<double>(progress.rows) / progress.seconds;
    text += fmt::format("  {} rows/s", grouped(static_cast<std::uint64_t>(rate)));
  }
  return text;
}

void ProgressLine::show(const Progress& progress) {
  if (!terminal_.interactive) return;
  fmt::print(stderr, "{}{}", kErase, format_progress(progress, terminal_));
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::clear() {
  if (shown_) fmt::print(stderr, "{}", kErase);
  shown_ = false;
}

}  // namespace fitgauge::cli
