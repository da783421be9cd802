#pragma once

#include <memory>
#include <span>
#include <string>

#include "cli/input_file.hpp"
#include "cli/outcome.hpp"

namespace fitgauge::cli {

/// Records of an NDJSON file of any size as the service takes them, also those that it exported,
/// line for line. Not thread-safe.
class NdjsonInput {
 public:
  /// @errors LocalFile
  static Outcome<NdjsonInput> open(const std::string& path);

  /// Fills the span from its front; 0 at the end. @errors LocalFile, also for a line that no
  /// request may have.
  Outcome<std::size_t> read(std::span<char> into);

 private:
  NdjsonInput(std::string name, std::shared_ptr<InputFile> file)
      : name_(std::move(name)), file_(std::move(file)) {}
  /// The next lines into `rows_`; false at the end.
  Outcome<bool> fill();

  std::string name_;
  std::shared_ptr<InputFile> file_;
  std::string unread_{};  ///< the begin of a line
  std::string rows_{};    ///< of which `taken_` bytes are read
  std::size_t taken_ = 0;
  std::uint64_t lines_ = 0;
  bool is_at_end_ = false;
};

}  // namespace fitgauge::cli
