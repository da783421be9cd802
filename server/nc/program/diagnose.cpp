#include "nc/program/diagnose.hpp"

#include <algorithm>

namespace fitgauge::interpreter {

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

}  // namespace fitgauge::interpreter
