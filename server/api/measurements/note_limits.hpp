#pragma once

#include <cstddef>

namespace fitgauge::api {

// In bytes.
inline constexpr std::size_t kLongestEntry = 200;  ///< a cause, a measure, a name
inline constexpr std::size_t kLongestNoteText = 2000;

}  // namespace fitgauge::api
