// Any bytes as a mask of FN 16: every finding has its place.

#include "nc/klartext/mask_file.hpp"

using namespace fitgauge::klartext;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ParsedMask parsed =
      parse_mask(std::string(reinterpret_cast<const char*>(data), size), "fuzz.a");
  for (const Diagnostic& diagnostic : parsed.diagnostics) {
    if (render(diagnostic).empty() || diagnostic.range.end < diagnostic.range.begin) std::abort();
  }
  return 0;
}
