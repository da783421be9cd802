#include "cli/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace fitgauge::cli {
namespace {

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

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
  return text;
}

std::string format_progress(const Progress& progress, const Terminal& terminal) {
  std::string text = progress.name + "  ";
  if (progress.bytes_in_all) {
    text += bar_of(progress.bytes, *progress.bytes_in_all, terminal.unicode);
  }
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
