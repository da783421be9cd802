// Positioning blocks: this parser against LinuxCNC's rs274 reading the same path as G1 lines, in
// one interleaved run. Times are of the processor, and the slope between two program lengths, so
// that starting a process does not count. Without rs274 (package linuxcnc-uspace) only our own
// figures.

#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "nc/klartext/parser.hpp"

namespace {

using fitgauge::klartext::parse_program;

constexpr int kShort = 20'000;
constexpr int kLong = 60'000;
constexpr int kRounds = 7;
constexpr double kFloor = 20;  // times as fast, that CI may fail on

double seconds_of(int who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// The words ` X+12.345 Y-6.789 Z+1.234 F500` of each block, the same for both.
std::vector<std::string> path_words(int count) {
  std::vector<std::string> words;
  std::uint32_t state = 1;
  const auto coordinate = [&state] {
    state = state * 1'664'525 + 1'013'904'223;
    return static_cast<double>(state >> 8) / 16'777'216.0 * 200 - 100;
  };
  for (int i = 0; i < count; ++i) {
    words.push_back(fmt::format(" X{:+.3f} Y{:+.3f} Z{:+.3f} F{}", coordinate(), coordinate(),
                                coordinate() / 10, 500 + i % 7));
  }
  return words;
}

std::string text_of(const std::vector<std::string>& words, int count, std::string_view begin,
                    std::string_view code, std::string_view end) {
  std::string text(begin);
  for (int i = 0; i < count; ++i) {
    text += code;
    text += words[static_cast<std::size_t>(i)];
    text += '\n';
  }
  return text += end;
}

double parse_seconds(const std::string& text) {
  std::string bytes = text;
  const double begin = seconds_of(RUSAGE_SELF);
  const auto parsed = parse_program(std::move(bytes), "bench.h");
  const double end = seconds_of(RUSAGE_SELF);
  if (!parsed.diagnostics.empty()) std::abort();
  return end - begin;
}

double rs274_seconds(const std::filesystem::path& file) {
  const double begin = seconds_of(RUSAGE_CHILDREN);
  const std::string command = "rs274 -g '" + file.string() + "' > /dev/null 2>&1";
  if (std::system(command.c_str()) == -1) std::abort();
  return seconds_of(RUSAGE_CHILDREN) - begin;
}

/// The median slope in nanoseconds for each block.
double slope(std::array<double, kRounds> shorter, std::array<double, kRounds> longer) {
  std::array<double, kRounds> slopes{};
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    slopes[i] = (longer[i] - shorter[i]) * 1e9 / (kLong - kShort);
  }
  std::nth_element(slopes.begin(), slopes.begin() + kRounds / 2, slopes.end());
  return slopes[kRounds / 2];
}

}  // namespace

int main() {
  const auto words = path_words(kLong);
  const auto klartext = [&](int count) {
    return text_of(words, count, "BEGIN PGM B MM\n", "L", "END PGM B MM\n");
  };
  const std::string short_text = klartext(kShort);
  const std::string long_text = klartext(kLong);
  const auto directory = std::filesystem::temp_directory_path();
  const auto short_file = directory / fmt::format("fitgauge-bench-{}-short.ngc", getpid());
  const auto long_file = directory / fmt::format("fitgauge-bench-{}-long.ngc", getpid());
  std::ofstream(short_file) << text_of(words, kShort, "", "G1", "M2\n");
  std::ofstream(long_file) << text_of(words, kLong, "", "G1", "M2\n");
  const bool peer = std::system("command -v rs274 > /dev/null") == 0;

  std::array<double, kRounds> ours_short{};
  std::array<double, kRounds> ours_long{};
  std::array<double, kRounds> theirs_short{};
  std::array<double, kRounds> theirs_long{};
  for (std::size_t i = 0; i < kRounds; ++i) {
    ours_short[i] = parse_seconds(short_text);
    if (peer) theirs_short[i] = rs274_seconds(short_file);
    ours_long[i] = parse_seconds(long_text);
    if (peer) theirs_long[i] = rs274_seconds(long_file);
  }
  std::filesystem::remove(short_file);
  std::filesystem::remove(long_file);

  const double ours = slope(ours_short, ours_long);
  const double bytes = static_cast<double>(long_text.size() - short_text.size()) / (kLong - kShort);
  fmt::print("parse L block: {:.0f} ns, {:.0f} MB/s\n", ours, bytes / ours * 1e3);
  if (!peer) return 0;
  const double theirs = slope(theirs_short, theirs_long);
  fmt::print("rs274 G1 line: {:.0f} ns, {:.1f} times as fast\n", theirs, theirs / ours);
  return theirs / ours >= kFloor ? 0 : 1;
}
