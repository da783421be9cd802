#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/terminal.hpp"

namespace fitgauge::cli {

/// How far a long upload is.
struct Progress {
  std::string name;
  std::uint64_t bytes = 0;
  std::optional<std::uint64_t> bytes_in_all{};  ///< none for a pipe
  std::uint64_t rows = 0;                       ///< stored by this run
  double seconds = 0;
};

/// One line of at most 79 columns for an ordinary name: the name, a bar, rows, rows a second.
std::string format_progress(const Progress& progress, const Terminal& terminal);

/// `1234567` as `1,234,567`.
std::string grouped(std::uint64_t number);

/// A line of standard error that is written over again; nothing where nobody looks.
class ProgressLine {
 public:
  explicit ProgressLine(const Terminal& terminal) : terminal_(terminal) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const Progress& progress);
  /// Makes room for another text.
  void clear();

 private:
  const Terminal& terminal_;
  bool shown_ = false;
};

}  // namespace fitgauge::cli
