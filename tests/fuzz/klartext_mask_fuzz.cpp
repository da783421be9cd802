// Any bytes as a mask of FN 16: every finding has its place.

#include "nc/klartext/mask_file.hpp"
#include "target.hpp"

using namespace fitgauge::klartext;

void take(std::string_view bytes) {
  const ParsedMask parsed = parse_mask(std::string(bytes), "fuzz.a");
  for (const Diagnostic& diagnostic : parsed.diagnostics) {
    require(!render(diagnostic).empty() && !(diagnostic.range.end < diagnostic.range.begin));
  }
}
