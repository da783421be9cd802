#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace fitgauge::cli {

enum class Colour { Green, Yellow, Red, Blue, Cyan };

/// What a stream shows.
struct Terminal {
  bool interactive = false;  ///< someone looks at it
  bool unicode = false;      ///< its locale is UTF-8
  bool colour = false;

  /// `text` in a colour, or as it is where there are none.
  std::string painted(std::string_view text, Colour colour) const;

  /// µm, or um where there is no µ.
  std::string_view micrometre() const { return unicode ? "µm" : "um"; }
};

/// The value of an environment variable, empty when it is not set.
using Environment = std::function<std::string(const char* name)>;

std::string environment_variable(const char* name);

/// UTF-8 by LC_ALL, LC_CTYPE or LANG, the first that says anything (POSIX, 8.2); colour on a
/// terminal that is not dumb, unless NO_COLOR is set (no-color.org).
Terminal terminal_of(bool interactive, const Environment& environment);

/// The terminal behind a file descriptor of this process.
Terminal terminal_of(int descriptor);

}  // namespace fitgauge::cli
