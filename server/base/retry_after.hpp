#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace fitgauge {

/// What a line of an HTTP head asks a client to wait (RFC 9110, 10.2.3); none of another field, or
/// where it is a date.
std::optional<std::chrono::seconds> retry_after(std::string_view line);

}  // namespace fitgauge
