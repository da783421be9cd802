#include "nc/klartext/diagnostic_list.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "nc/klartext/source_text.hpp"

namespace fitgauge::klartext {
namespace {

/// Findings beyond this number are counted, not kept.
constexpr std::size_t kMostDiagnostics = 200;

/// A longer line is cut: two hundred findings in a line of megabytes must stay small.
constexpr std::size_t kLongestShownLine = 1000;

std::string_view shown(std::string_view line) { return first_characters(line, kLongestShownLine); }

}  // namespace

void DiagnosticList::add(Severity severity, DiagnosticCode code, Slice<char> place,
                         std::string message, std::optional<std::uint32_t> block,
                         bool is_unreadable) {
  if (kept_.size() == kMostDiagnostics) {
    ++dropped_;
    worst_dropped_ = std::max(worst_dropped_, severity);
    if (severity == Severity::Error && !is_unreadable) all_dropped_unreadable_ = false;
    return;
  }
  const SourcePosition begin = position_of(source_, line_starts_, place.first);
  SourcePosition end = position_of(source_, line_starts_, std::size_t{place.first} + place.count);
  if (end.line != begin.line) end = begin;
  kept_.push_back({.severity = severity,
                   .code = code,
                   .message = std::move(message),
                   .program = program_,
                   .range = {begin, end},
                   .block = block,
                   .source = std::string(shown(line_of(source_, line_starts_, begin.line))),
                   .is_unreadable = is_unreadable});
}

std::vector<Diagnostic> DiagnosticList::take() {
  if (dropped_ > 0) {
    Diagnostic last = kept_.back();
    last.severity = worst_dropped_;
    last.is_unreadable = all_dropped_unreadable_;
    last.code = DiagnosticCode::TooManyDiagnostics;
    last.message = std::to_string(dropped_) + " more findings are not shown; correct these first";
    kept_.push_back(std::move(last));
  }
  return std::move(kept_);
}

}  // namespace fitgauge::klartext
