#include "db/store/pair_statistics.hpp"

namespace fitgauge::store {

std::size_t count_of(const PairStatistics& pairs) {
  std::size_t count = 0;
  for (const auto& [value, by_values] : pairs) {
    for (const auto& [by_value, kinds] : by_values) count += kinds.size();
  }
  return count;
}

std::string encode(const PairStatistics& pairs) {
  std::string bytes;
  for (const auto& [value, by_values] : pairs) {
    std::string section;
    for (const auto& [by_value, kinds] : by_values) {
      append_text(section, by_value);
      append_number(section, kinds.size());
      for (const auto& [kind, statistics] : kinds) {
        append_number(section, static_cast<unsigned>(kind));
        statistics.pack(section);
      }
    }
    append_text(bytes, value);
    append_number(bytes, section.size());
    bytes += section;
  }
  return bytes;
}

}  // namespace fitgauge::store
