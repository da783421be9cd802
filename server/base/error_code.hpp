#pragma once

#include <cstdint>
#include <string_view>

namespace fitgauge {

/// Every expected failure of the service, from one table (error_code.cpp). The text id is part of
/// the HTTP contract and never changes.
enum class ErrorCode : std::uint8_t {
#define FITGAUGE_ERROR(name, id, title) name,
#include "base/error_codes.inc"
#undef FITGAUGE_ERROR
};

/// The stable dotted id, such as `length.too_fine`.
std::string_view id(ErrorCode code);

/// A short English title of the kind of problem, such as "Length is finer than one nanometre".
std::string_view title(ErrorCode code);

}  // namespace fitgauge
