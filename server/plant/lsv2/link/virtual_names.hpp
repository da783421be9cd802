#pragma once

#include <string_view>

// What only a virtual control of ours says.

namespace fitgauge::control_link {

/// What it says in place of a PLC's version.
inline constexpr std::string_view kVirtualPlc = "fitgauge";
/// The machine parameter that stands for the NC start key, which LSV-2 does not have: a program's
/// path written to it starts the program, an empty text stops it.
inline constexpr std::string_view kRunParameter = "Fitgauge.program";

}  // namespace fitgauge::control_link
