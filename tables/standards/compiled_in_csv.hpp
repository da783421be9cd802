#pragma once

#include <string_view>

namespace fitgauge::standards {

/// A file of tables/data/standards, byte for byte: `iso2768_linear`. Empty where there is none.
std::string_view compiled_in_csv(std::string_view name);

}  // namespace fitgauge::standards
