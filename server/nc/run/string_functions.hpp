#pragma once

#include <string>
#include <string_view>

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

}  // namespace fitgauge::interpreter
