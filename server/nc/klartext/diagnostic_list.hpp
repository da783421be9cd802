#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nc/klartext/diagnostic.hpp"
#include "nc/klartext/expression.hpp"

namespace fitgauge::klartext {

/// Collects the findings of one text and places them. Keeps references to the text and its line
/// starts, which must know every line a finding is reported in. Single-threaded.
class DiagnosticList {
 public:
  DiagnosticList(const std::string& source, const std::vector<std::uint32_t>& line_starts,
                 std::string program)
      : source_(source), line_starts_(line_starts), program_(std::move(program)) {}

  void add(Severity severity, DiagnosticCode code, Slice<char> place, std::string message,
           std::optional<std::uint32_t> block = std::nullopt, bool is_unreadable = false);

  /// The findings; when there were too many, the last says how many are missing, and is an error
  /// when one of those is.
  std::vector<Diagnostic> take();

 private:
  const std::string& source_;
  const std::vector<std::uint32_t>& line_starts_;
  std::string program_;
  std::vector<Diagnostic> kept_;
  std::size_t dropped_ = 0;
  Severity worst_dropped_ = Severity::Warning;
  bool all_dropped_unreadable_ = true;  ///< of the errors
};

}  // namespace fitgauge::klartext
