#include "nc/machine/machine_state.hpp"
#include "nc/program/diagnose.hpp"

namespace fitgauge::interpreter {
namespace {

/// Data that FN 18 reads by ID and NR, and the last IDX of those that need one.
struct SystemDatum {
  int id;
  int number;
  int last;
  SystemNeed need;
};

constexpr int kRow = -1;  ///< NR is a row
constexpr SystemDatum kData[] = {
    {50, kRow, 0, SystemNeed::Nothing},
    {500, kRow, 6, SystemNeed::Nothing},
    {502, kRow, 6, SystemNeed::Nothing},
    {503, kRow, 6, SystemNeed::Nothing},
#define FITGAUGE_DATA(id, number, last, need, value) {id, number, last, SystemNeed::need},
#include "nc/program/system_data.inc"
};

const SystemDatum* find_datum(int id, int number) {
  const auto* datum = std::ranges::find_if(kData, [=](const SystemDatum& each) {
    return each.id == id && (each.number == number || each.number == kRow);
  });
  return datum == std::end(kData) ? nullptr : datum;
}

/// NR of ID50: a column of tool.t, TL, DIRECT, or the calibration of a probe, which is in
/// tchprobe.tp.
bool is_tool_datum(int number, bool writes) {
  if (number >= 24 && number <= 26) return !writes;
  return number == 7 || number == 18 || machine::tool_column(number) != nullptr;
}

}  // namespace

bool has_system_data(int id, std::optional<int> number, bool writes) {
  if (writes && id != 50 && id != 500 && id != 503) return false;
  if (!number) return std::ranges::count(kData, id, &SystemDatum::id) > 0;
  return id == 50 ? is_tool_datum(*number, writes) : find_datum(id, *number) != nullptr;
}

bool has_index(int id, int number, std::optional<int> index) {
  const SystemDatum* datum = find_datum(id, number);
  if (datum == nullptr || datum->last == 0) return true;
  const int first = id == 10 ? 0 : 1;
  return index.value_or(first == 0 ? -1 : 1) >= first && index.value_or(1) <= datum->last;
}

SystemNeed need_of(int id, int number) {
  const SystemDatum* datum = find_datum(id, number);
  return datum == nullptr ? SystemNeed::Nothing : datum->need;
}

}  // namespace fitgauge::interpreter
