#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/clock.hpp"

namespace fitgauge::interpreter {

/// SYSSTR( ID10321 NRn ): date and time in the formats 0 to 16 of the control, UTC.
std::optional<std::string> format_system_time(Timestamp time, std::int64_t format);

/// The three letters of a month (1 to 12) as STR_MONTH of FN 16 prints them.
std::string_view month_name(int month);

}  // namespace fitgauge::interpreter
