#pragma once

namespace fitgauge::cli {

enum class Colour { Green, Yellow, Red, Blue, Cyan };

/// Abilities of a stream.
struct Terminal {
  bool interactive = false;  ///< someone looks at it
  bool unicode = false;      ///< its locale is UTF-8
  bool colour = false;

  /// `text` in a colour, or unchanged without colours.
  std::string painted(std::string_view text, Colour colour) const;

  /// µm, or um if the terminal has no µ.
  std::string_view micrometre() const { return unicode ? "µm" : "um"; }
};

/// The value of an environment variable, empty when it is not set.
using Environment = std::function<std::string(const char* name)>;

std::string environment_variable(const char* name);

/// UTF-8 by LC_ALL, LC_CTYPE or LANG, the first that is set (POSIX, 8.2); colour on a terminal that
/// is not dumb, unless NO_COLOR is set (no-color.org).
Terminal terminal_of(bool interactive, const Environment& environment);

/// The terminal of a file descriptor of this process.
Terminal terminal_of(int descriptor);

/// Progress of a long upload.
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

/// A line of standard error that is overwritten; nothing without a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(const Terminal& terminal) : terminal_(terminal) {}
  ~ProgressLine() { clear(); }
  ProgressLine& operator=(ProgressLine&&) = delete;  // neither copied nor moved

  void show(const Progress& progress);
  /// Makes room for another text.
  void clear();

 private:
  const Terminal& terminal_;
  bool shown_ = false;
};

}  // namespace fitgauge::cli
