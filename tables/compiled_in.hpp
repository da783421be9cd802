#pragma once

namespace fitgauge {

/// Returns a file of tables/data or tables/data/standards, such as `it_grades` or `iso2768_linear`,
/// byte for byte; empty if it does not exist. Sizes are in mm, deviations and tolerances in µm.
std::string_view compiled_in_csv(std::string_view name);

/// Removes the text up to the next separator.
inline std::string_view take_field(std::string_view& rest, char separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view text = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return text;
}

inline std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  const auto count = 1 + std::count(line.begin(), line.end(), ',');
  for (std::ptrdiff_t i = 0; i < count; ++i) cells.push_back(take_field(line, ','));
  return cells;
}

}  // namespace fitgauge
