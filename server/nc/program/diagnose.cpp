#include "nc/program/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace fitgauge::interpreter {
namespace {

constexpr std::array kMFunctions{0,   1,   2,   3,   4,   5,   6,   8,   9,   13,  14,  19,  30,
                                 89,  90,  91,  92,  94,  97,  98,  99,  101, 102, 103, 105, 106,
                                 107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 117, 118, 120,
                                 124, 126, 127, 128, 129, 130, 134, 135, 136, 137, 138, 140, 141,
                                 142, 143, 144, 145, 148, 149, 150, 197, 200, 201, 202, 203, 204};

}  // namespace

using klartext::Diagnostic;

Diagnostic diagnose(const klartext::Program& program, const klartext::Block& block,
                    klartext::Severity severity, klartext::DiagnosticCode code,
                    std::string message) {
  return diagnose(program, block, block.written, severity, code, std::move(message));
}

Diagnostic diagnose(const klartext::Program& program, const klartext::Block& block,
                    klartext::Slice<char> place, klartext::Severity severity,
                    klartext::DiagnosticCode code, std::string message) {
  // A finding lies within one physical line.
  const std::string_view written = program.written(place);
  place.count = static_cast<std::uint32_t>(std::min(written.find('\n'), written.size()));
  const SourceRange range = program.range(place);
  return {severity,
          code,
          std::move(message),
          std::string(program.file_name()),
          range,
          block.number,
          std::string(program.line(range.begin.line))};
}

std::string m_function_hint(int number) {
  return fmt::format(
      "M{0} is not available here; if the builder of the machine made it, say in the setup what it "
      R"(does: "m_functions":{{"{0}":"ignore"}}, or {{"call":"TNC:\\oem\\m{0}.h"}})",
      number);
}

std::string cycle_hint(bool is_probing, int number) {
  return fmt::format(
      "{0} {1} is not available here; if the builder of the machine made it, say in the setup what "
      R"(it does: "cycles":{{"{1}":"ignore"}}, or {{"call":"TNC:\\oem\\{1}.h"}})",
      is_probing ? "TCH PROBE" : "CYCL DEF", number);
}

bool is_m_function(int number) {
  return std::binary_search(kMFunctions.begin(), kMFunctions.end(), number);
}

}  // namespace fitgauge::interpreter
