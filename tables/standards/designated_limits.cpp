#include "tables/standards/designated_limits.hpp"

#include "base/text.hpp"
#include "tables/standards/general_tolerance.hpp"
#include "tables/standards/thread.hpp"

namespace fitgauge::standards {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A thread's class is its designation; no name of ISO 286 or of a shop has a hyphen.
bool is_thread_class(std::string_view text) {
  return text.size() > 1 && text[0] == 'M' && is_digit(text[1]) &&
         text.find('-') != std::string_view::npos;
}

}  // namespace

bool is_designation(std::string_view text) {
  const bool begins =
      text.size() > 1 && (text[0] == 'M' || text[0] == 'R' || text[0] == 'C') && is_digit(text[1]);
  return begins || text.find(kGeneralTolerance) != std::string_view::npos;
}

bool is_class(std::string_view text) {
  return text.find(kGeneralTolerance) != std::string_view::npos;
}

Result<DesignatedLimits> limits_of(std::string_view designation) {
  return designation.starts_with('M') ? thread_limits(designation) : general_tolerance(designation);
}

Result<DesignatedLimits> limits_of(Length nominal, std::string_view tolerance_class) {
  return general_tolerance(nominal, tolerance_class);
}

void append_designation(std::string& out, Length nominal, std::string_view tolerance_class) {
  if (is_thread_class(tolerance_class)) {
    out += tolerance_class;
    return;
  }
  const bool is_edge = tolerance_class.size() > 2 && tolerance_class[1] == ' ';
  if (is_edge) out += tolerance_class.front();
  append_mm(out, nominal);
  if (!is_edge) out += ' ';
  out += tolerance_class.substr(is_edge ? 1 : 0);
}

std::string DesignatedLimits::designation() const {
  std::string text;
  append_designation(text, nominal, tolerance_class);
  return text;
}

}  // namespace fitgauge::standards
