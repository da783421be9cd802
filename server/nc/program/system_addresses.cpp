#include "nc/program/link_check.hpp"

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

struct Indexed {
  int id;
  int number;  ///< 0: all of the ID
  int last;
};
/// Data of an axis, 1 to 3 or 1 to 6, and of a Q or QS parameter, which has no default.
constexpr Indexed kIndexed[] = {{10, 103, 1999}, {10, 110, 1999}, {10, 111, 1999}, {210, 5, 3},
                                {220, 0, 6},     {230, 2, 6},     {230, 3, 6},     {240, 0, 6},
                                {270, 0, 6},     {350, 20, 3},    {360, 1, 3},     {360, 2, 6},
                                {360, 3, 3},     {500, 0, 6},     {502, 0, 6},     {503, 0, 6}};

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

bool has_index(int id, int number, std::optional<int> index) {
  const auto* data = std::ranges::find_if(kIndexed, [&](const Indexed& each) {
    return each.id == id && (each.number == 0 || each.number == number);
  });
  if (data == std::end(kIndexed)) return true;
  const int first = id == 10 ? 0 : 1;
  return index.value_or(first == 0 ? -1 : 1) >= first && index.value_or(1) <= data->last;
}

SystemNeed need_of(int id, int number) {
  if (id == 360) return SystemNeed::Touch;
  if (id == 350) return number == 20 || number == 21 ? SystemNeed::Nothing : SystemNeed::Probe;
  if (id != 10 || number < 100) return SystemNeed::Nothing;
  return number == 103 ? SystemNeed::Cycle : SystemNeed::Text;
}

}  // namespace fitgauge::interpreter
