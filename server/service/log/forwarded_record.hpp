#pragma once

#include <string_view>

#include "record/measurement.hpp"

namespace fitgauge::app {

/// Why a record of another folder cannot be stored as this one; empty: it can. It is taken only if
/// this version reads all of it: it has to give its own text again.
/// @param text the record, of which `measurement` was read.
std::string_view finding_in(const Measurement& measurement, std::string_view text);

}  // namespace fitgauge::app
