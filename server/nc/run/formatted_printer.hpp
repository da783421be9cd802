#pragma once

#include "nc/klartext/mask_file.hpp"
#include "nc/run/run_files.hpp"

namespace fitgauge::interpreter {

/// One run through a mask: its lines in the language of the control, and its settings for the file.
struct PrintedMask {
  std::vector<std::string> lines;
  bool close = false;
  bool append = false;
  bool truncate = false;
  std::optional<std::size_t> most_bytes;  ///< M_APPEND_MAX
};

/// The masks and files of FN 16: F-PRINT. Lines of one file are collected and written at M_CLOSE or
/// at the end of the run. Not thread-safe.
class FormattedPrinter {
 public:
  /// Both must outlive this object.
  FormattedPrinter(RunFiles& files, OutputBudget& budget) : files_(files), budget_(budget) {}

  /// A mask, as its file is now. @errors missing or malformed file.
  NcResult<std::shared_ptr<const klartext::MaskFile>> mask(const ControlPath& path);
  /// @errors limit.
  NcResult<void> print(const PrintedMask& printed, const ControlPath& path);
  /// Writes the collected lines. @errors limit.
  NcResult<void> close();

 private:
  struct Output {
    ControlPath path;
    std::string text;
    bool append = false;
    std::optional<std::size_t> most_bytes;
  };
  struct Known {
    std::string revision;
    std::shared_ptr<const klartext::MaskFile> mask;
  };

  NcResult<void> write(const Output& output);

  RunFiles& files_;
  OutputBudget& budget_;
  std::map<std::string, Output> outputs_;  // by key
  std::map<std::string, Known> masks_;     // by key
};

class Channel;

/// The mask's treatment of lines whose QS is undefined or empty.
enum class EmptyLines : std::uint8_t {
  Unspecified,  ///< an undefined QS is an error (decision 3)
  Hide,         ///< M_EMPTY_HIDE: such lines are left out
  Show          ///< M_EMPTY_SHOW: the value prints as nothing
};

/// One line of a mask with its values, or nothing when it is left out.
/// @errors an undefined parameter, a character code out of range.
NcResult<std::optional<std::string>> format_line(Channel& channel,
                                                 const klartext::MaskFormat& format,
                                                 EmptyLines empty);

}  // namespace fitgauge::interpreter
