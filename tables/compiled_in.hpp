#pragma once

namespace fitgauge {

/// Returns a file of tables/data or tables/data/standards, such as `it_grades` or `iso2768_linear`,
/// byte for byte; empty if it does not exist. Sizes are in mm, deviations and tolerances in µm.
std::string_view compiled_in_csv(std::string_view name);

}  // namespace fitgauge
