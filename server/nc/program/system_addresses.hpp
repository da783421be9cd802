#pragma once

namespace fitgauge::interpreter {

/// An ID of FN 18: SYSREAD, and its NR; none listed: the NR is a row.
struct SystemGroup {
  int id = 0;
  std::span<const int> numbers;
  bool is_written = false;  ///< FN 17: SYSWRITE too
};

std::span<const SystemGroup> system_groups();

/// Whether this control has system data; without a number, whether it has any of the ID.
bool has_system_data(int id, std::optional<int> number, bool writes);

/// Whether data that need an index, most of them an axis, have this one.
bool has_index(int id, int number, std::optional<int> index);

/// What the run needs for data, beside their index.
enum class SystemNeed : std::uint8_t { Nothing, Cycle, Text, Probe, Touch };

SystemNeed need_of(int id, int number);

}  // namespace fitgauge::interpreter
