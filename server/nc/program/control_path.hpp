#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace fitgauge::interpreter {

/// A file of the control's disk: `TNC:\nc_prog\8255\8255.h`. Always absolute and below `TNC:\`,
/// without `.` and `..`; kept as written, compared without regard to (ASCII) case. A value type.
class ControlPath {
 public:
  /// Reads an absolute path; `/` separates as `\` does.
  /// @errors FilePathInvalid: another drive, a path that leaves `TNC:\`, a control character, no
  ///   file name, or more than 255 characters.
  static Result<ControlPath> parse(std::string_view text);

  /// Reads a path as an NC program names it: absolute, or relative to the directory of `program`.
  /// @errors as parse.
  static Result<ControlPath> resolve(std::string_view text, const ControlPath& program);

  const std::string& text() const { return text_; }
  /// The same for all spellings of one file; what a disk looks up.
  std::string key() const;
  /// With its last `\`: `TNC:\nc_prog\8255\`.
  std::string_view directory() const;
  std::string_view file_name() const;
  /// With `extension` (such as `.H`) where the file name has none.
  ControlPath with_default_extension(std::string_view extension) const;
  /// A file of the same directory. @pre `name` has no separator.
  ControlPath beside(std::string_view name) const;

  friend bool operator==(const ControlPath& a, const ControlPath& b) { return a.key() == b.key(); }

 private:
  explicit ControlPath(std::string text) : text_(std::move(text)) {}

  std::string text_;
};

}  // namespace fitgauge::interpreter
