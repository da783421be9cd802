#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "base/read.hpp"
#include "base/result.hpp"
#include "formats/sheet/text_encoding.hpp"

namespace fitgauge::sheet {

/// Records of an NDJSON file of any size as /v1/measurements takes them, also those that it
/// exported, line for line, so that errors name the lines of the file. Of no more use after an
/// error.
class NdjsonRows {
 public:
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20;

  /// @param first and again as for Utf8Input. @errors TextEncoding
  static Result<NdjsonRows> open(const Read& first, Read again, Encoding encoding);

  /// Appends the next line. @returns false at the end.
  /// @errors TextEncoding; CsvMalformed, whose `where` is the line.
  Result<bool> append(std::string& rows);

 private:
  explicit NdjsonRows(Utf8Input input) : input_(std::move(input)) {}

  Utf8Input input_;
  std::string room_{};  ///< read, and taken up to `at_`
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  bool is_at_end_ = false;
};

}  // namespace fitgauge::sheet
