#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "aqdef/lines.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace fitgauge::aqdef {

/// How many bytes are looked at together. The fields of a DFQ are short, so that a branch for each
/// byte would be guessed wrong at each of them.
inline constexpr std::size_t kBlock = 64;

/// Bit i: the byte i of the block is a separator of fields or of values.
inline std::uint64_t separators_of(const char* block) {
  std::uint64_t found = 0;
#if defined(__SSE2__)
  constexpr std::size_t kStep = sizeof(__m128i);
  for (std::size_t at = 0; at < kBlock; at += kStep) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(block + at));
    const __m128i is_one = _mm_or_si128(_mm_cmpeq_epi8(bytes, _mm_set1_epi8(kFieldSeparator)),
                                        _mm_cmpeq_epi8(bytes, _mm_set1_epi8(kValueSeparator)));
    found |= std::uint64_t{static_cast<std::uint32_t>(_mm_movemask_epi8(is_one))} << at;
  }
#else
  for (std::size_t at = 0; at < kBlock; ++at) {
    const bool is_one = block[at] == kFieldSeparator || block[at] == kValueSeparator;
    found |= std::uint64_t{is_one} << at;
  }
#endif
  return found;
}

/// Calls `each` with the place of every separator, until it returns false.
template <class Each>
void for_each_separator(std::string_view text, Each each) {
  std::array<char, kBlock> last{};  // what is left at the end, and zeros
  for (std::size_t at = 0; at < text.size(); at += kBlock) {
    const char* block = text.data() + at;
    if (text.size() - at < kBlock) {
      text.copy(last.data(), kBlock, at);
      block = last.data();
    }
    for (std::uint64_t found = separators_of(block); found != 0; found &= found - 1) {
      if (!each(at + static_cast<std::size_t>(std::countr_zero(found)))) return;
    }
  }
}

}  // namespace fitgauge::aqdef
