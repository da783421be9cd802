#include "nc/program/system_addresses.hpp"

#include <algorithm>

namespace fitgauge::interpreter {
namespace {

constexpr int kDataProgram[] = {1, 3, 6, 8, 103, 110, 111};
constexpr int kDataMachine[] = {1, 2, 3, 4, 5, 8, 9, 11};
constexpr int kDataCalibration[] = {24, 25, 26};
constexpr int kDataTool[] = {1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 13, 14, 15,
                             16, 17, 18, 19, 20, 21, 22, 24, 25, 26, 28, 32, 33, 36};
constexpr int kDataToolCall[] = {1, 2, 3, 4, 5, 6, 7};
constexpr int kDataTwo[] = {1, 2};
constexpr int kDataTransformation[] = {1, 2, 3, 4, 5, 6, 7};
constexpr int kDataShift[] = {2, 3, 4};
constexpr int kDataLimits[] = {2, 3, 5};
constexpr int kDataNose[] = {1, 8};
constexpr int kDataOne[] = {1};
constexpr int kDataMFunctions[] = {116, 128, 144};
constexpr int kDataProbe[] = {10, 11, 12, 14, 15, 20, 21, 50, 51, 52, 53, 54, 55, 56, 57};
constexpr int kDataTouch[] = {1, 2, 3};
constexpr int kDataModes[] = {6, 16};

constexpr SystemGroup kDataGroups[] = {
    {10, kDataProgram},  {20, kDataMachine}, {50, kDataTool, true},
    {60, kDataToolCall}, {200, kDataTwo},    {210, kDataTransformation},
    {220, kDataShift},   {230, kDataLimits}, {240, kDataNose},
    {270, kDataOne},     {280, kDataTwo},    {310, kDataMFunctions},
    {320, kDataOne},     {350, kDataProbe},  {360, kDataTouch},
    {500, {}, true},     {502, {}},          {503, {}, true},
    {505, kDataOne},     {990, kDataModes}};

}  // namespace

std::span<const SystemGroup> system_groups() { return kDataGroups; }

bool has_system_data(int id, std::optional<int> number, bool writes) {
  const auto* group = std::ranges::find(kDataGroups, id, &SystemGroup::id);
  if (group == std::end(kDataGroups) || (writes && !group->is_written)) return false;
  if (!number || group->numbers.empty()) return true;
  // The calibration of a probe is in tchprobe.tp.
  if (writes && std::ranges::find(kDataCalibration, *number) != std::end(kDataCalibration))
    return false;
  return std::ranges::find(group->numbers, *number) != group->numbers.end();
}

}  // namespace fitgauge::interpreter
