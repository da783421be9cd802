// Bytes as a STEP file: read as a drawing, and what was read made a plan that is JSON again.

#include "formats/step/drawing.hpp"

using namespace fitgauge;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto tables = iso286::ToleranceTables::make(iso286::compiled_in_tables(), {"1"});
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto drawing = step::read_drawing(text, *tables, 10'000);
  if (!drawing) return drawing.error().where.empty() ? (std::abort(), 0) : 0;
  const auto plan = step::plan_of(*drawing, "part", nullptr);
  if (plan && !parse_json(plan->text)) std::abort();
  return 0;
}
