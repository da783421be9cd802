#include "nc/program/followed_values.hpp"

#include "base/number.hpp"
#include "nc/program/diagnose.hpp"

namespace fitgauge::interpreter {

std::optional<klartext::DiagnosticEdit> written_value(const klartext::Program& program,
                                                      const FollowedValue& followed) {
  auto written = written_number(program, followed.place);
  if (!written) return written;
  std::string text = written->by.substr(written->by.starts_with('+') ? 1 : 0);
  std::ranges::replace(text, ',', '.');
  return read_number<double>(text) == followed.value ? written : std::nullopt;
}

bool is_read_once(const klartext::Program& program, const FollowedValue& followed) {
  const auto* source = std::get_if<klartext::Assignment>(&followed.block->statement);
  if (source == nullptr) return true;
  std::size_t count = 0;
  for (const klartext::Block& block : program.blocks()) {
    count += places_of(program, block.written, source->target).size();
    if (count > 2) return false;
  }
  return true;
}

}  // namespace fitgauge::interpreter
