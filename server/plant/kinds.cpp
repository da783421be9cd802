#include "plant/kind.hpp"

namespace fitgauge::connections {

#define FITGAUGE_KIND(kind, folder) Kind kind##_kind();
#include "plant_kinds.inc"
#undef FITGAUGE_KIND

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
#define FITGAUGE_KIND(kind, folder) kind##_kind(),
#include "plant_kinds.inc"
#undef FITGAUGE_KIND
  };
  return all;
}

}  // namespace fitgauge::connections
