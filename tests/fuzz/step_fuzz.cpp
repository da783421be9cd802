// Bytes as a STEP file: read as a drawing, and what was read made a plan that is JSON again.

#include "formats/step/drawing.hpp"
#include "target.hpp"

using namespace fitgauge;

void take(std::string_view text) {
  static const auto tables = iso286::ToleranceTables::make(iso286::compiled_in_tables(), {"1"});
  const auto drawing = step::read_drawing(text, *tables, 10'000);
  require(drawing.has_value() || !drawing.error().where.empty());
  if (!drawing) return;
  const auto plan = step::plan_of(*drawing, "part", nullptr);
  require(!plan || parse_json(plan->text).has_value());
}
