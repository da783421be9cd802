#pragma once

#include <string>
#include <string_view>

#include "plant/mtconnect/mtconnect_document.hpp"

// SHDR, which an adapter tells an agent: `time|data item|value|data item|value` and a line end. The
// data items are those of the device Gauge, by their ids.

namespace fitgauge::api::mtconnect {

std::string shdr_availability(Timestamp at);
/// The part and the feature, whose table has one entry.
std::string shdr_line(const app::Measurement& measurement);
std::string shdr_line(const Counts& counts, Timestamp at);

/// A text as a value between `|`: in quotes where it has one or begins with a quote, without
/// control characters, and UNAVAILABLE where there is none.
std::string shdr_text(std::string_view text);

}  // namespace fitgauge::api::mtconnect
