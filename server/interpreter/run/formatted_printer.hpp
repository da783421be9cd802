#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "klartext/mask_file.hpp"
#include "program/control_path.hpp"
#include "run/nc_error.hpp"

namespace fitgauge::interpreter {

class Channel;

/// FN 16: F-PRINT. What goes to one file is collected and written at M_CLOSE or at the end of the
/// run; what goes to the screen is shown at once. Not thread-safe.
class FormattedPrinter {
 public:
  /// @param target a path as the program names it, `SCREEN:` or `SCLR:`
  /// @errors missing or malformed mask, undefined value, limit.
  NcResult<void> print(Channel& channel, const ControlPath& mask, std::string_view target);
  /// Writes what has been collected. @errors limit.
  NcResult<void> close(Channel& channel);

 private:
  struct Output {
    ControlPath path;
    std::string text;
    bool append = false;
    std::optional<std::size_t> most_bytes;  ///< M_APPEND_MAX
  };
  struct Known {
    std::string revision;
    std::shared_ptr<const klartext::MaskFile> mask;
  };

  NcResult<std::shared_ptr<const klartext::MaskFile>> load(Channel& channel,
                                                           const ControlPath& path);
  static NcResult<void> write(Channel& channel, const Output& output);

  std::map<std::string, Output> outputs_;  // by key
  std::map<std::string, Known> masks_;     // by key
};

}  // namespace fitgauge::interpreter
