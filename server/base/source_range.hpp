#pragma once

#include <compare>
#include <cstdint>

namespace fitgauge {

/// A place in a text: line and column count from 1, columns in characters (code points).
struct SourcePosition {
  std::uint32_t line = 1;
  std::uint32_t column = 1;

  friend auto operator<=>(const SourcePosition&, const SourcePosition&) = default;
};

/// From `begin` up to and not including `end`.
struct SourceRange {
  SourcePosition begin;
  SourcePosition end;

  friend auto operator<=>(const SourceRange&, const SourceRange&) = default;
};

}  // namespace fitgauge
