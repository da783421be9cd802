#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>

#include "base/result.hpp"

namespace fitgauge {

/// Fills the span from its front; 0 at the end of the input.
using Read = std::function<Result<std::size_t>(std::span<char>)>;

/// Reads a text from memory. @param text outlives it.
inline Read read_text(std::string_view text) {
  return [text](std::span<char> into) mutable -> Result<std::size_t> {
    const std::size_t count = text.copy(into.data(), into.size());
    text.remove_prefix(count);
    return count;
  };
}

}  // namespace fitgauge
