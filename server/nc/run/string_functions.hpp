#pragma once

#include "base/clock.hpp"
#include "nc/klartext/expression.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

class Channel;

/// Concat, ToChar, SubString, SystemString.
NcResult<std::string> string_value(Channel& channel, klartext::NodeIndex index);
/// ToNumber, InString, StringLength, StringCompare.
NcResult<double> string_number(Channel& channel, klartext::NodeIndex index);

/// A number as TOCHAR writes it: with that many decimals, or without a number of them (-1) up to 6
/// without trailing zeros (decision 22).
std::string to_char(double value, int decimals);

/// SYSSTR( ID10321 NRn ): date and time in the formats 0 to 16 of the control, UTC.
std::optional<std::string> format_system_time(Timestamp time, std::int64_t format);

/// The three letters of a month (1 to 12) as STR_MONTH of FN 16 prints them.
std::string_view month_name(int month);

}  // namespace fitgauge::interpreter
