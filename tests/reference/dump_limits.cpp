// Prints the limits of size of every class of the standard at both sides of every size step, one
// line each: `H7 25000000 25021000 25000000` (size, upper and lower limit in nanometres), or
// `t6 10000000 -` where the class is not defined.

#include <cstdio>

#include "tables/iso286/tolerance_tables.hpp"

using namespace fitgauge;
using namespace fitgauge::iso286;

namespace {

/// The first and the last nanometre of every step of the tables, of the part up to 1 mm, and of a
/// size within each.
std::set<std::int64_t> sizes() {
  std::set<std::int64_t> sizes;
  const auto add_range = [&](std::int64_t over, std::int64_t up_to) {
    sizes.insert({over + 1, (over + up_to) / 2, up_to});
  };
  for (const TableCell& cell : compiled_in_tables().cells) {
    add_range(cell.range.over.count(), cell.range.up_to.count());
  }
  constexpr std::int64_t kMillimetre = 1'000'000;
  add_range(0, kMillimetre);
  add_range(kMillimetre, 3 * kMillimetre);
  return sizes;
}

}  // namespace

int main() {
  const auto tables = ToleranceTables::make(compiled_in_tables(), {}).value();
  for (const std::int64_t nanometres : sizes()) {
    const NominalSize size = NominalSize::make(Length::nanometres(nanometres)).value();
    for (std::uint16_t index = 0; index < kStandardClassCount; ++index) {
      const auto name = std::string(tables.class_name(ClassId{index}));
      const auto limits = tables.limits_of_size(size, ClassId{index});
      if (limits) {
        std::printf("%s %ld %ld %ld\n", name.c_str(), nanometres, limits->upper_limit().count(),
                    limits->lower_limit().count());
      } else {
        std::printf("%s %ld -\n", name.c_str(), nanometres);
      }
    }
  }
}
