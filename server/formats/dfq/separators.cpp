#include "formats/dfq/separators.hpp"

#include <array>
#include <bit>
#include <cstddef>

#include "formats/dfq/lines.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

// One form for processors that count and clear bits in one instruction, which all do since 2013;
// the loader chooses. Sanitizers are not up yet when it does.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FITGAUGE_IN_BOTH_FORMS __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define FITGAUGE_IN_BOTH_FORMS
#endif

namespace fitgauge::aqdef {
namespace {

/// How many bytes are looked at together. The fields of a DFQ are short, so that a branch for each
/// byte, or for each field, would be guessed wrong too often.
constexpr std::size_t kBlock = 64;

/// Bit i: the byte i of a block is a separator, and one of values.
struct Masks {
  std::uint64_t all = 0;
  std::uint64_t of_values = 0;
};

#if defined(__SSE2__)
[[gnu::always_inline]] inline std::uint64_t where(__m128i bytes, char separator) {
  const int found = _mm_movemask_epi8(_mm_cmpeq_epi8(bytes, _mm_set1_epi8(separator)));
  return static_cast<std::uint32_t>(found);
}
#endif

[[gnu::always_inline]] inline Masks masks_of(const char* block) {
  Masks masks;
#if defined(__SSE2__)
#pragma GCC unroll 4
  for (std::size_t at = 0; at < kBlock; at += sizeof(__m128i)) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(block + at));
    masks.all |= where(bytes, kFieldSeparator) << at;
    masks.of_values |= where(bytes, kValueSeparator) << at;
  }
#else
  for (std::size_t at = 0; at < kBlock; ++at) {
    masks.all |= std::uint64_t{block[at] == kFieldSeparator} << at;
    masks.of_values |= std::uint64_t{block[at] == kValueSeparator} << at;
  }
#endif
  masks.all |= masks.of_values;
  return masks;
}

}  // namespace

FITGAUGE_IN_BOTH_FORMS Separated separate(std::string_view text, std::uint32_t* starts,
                                          std::uint32_t* values) {
  constexpr std::uint32_t kAtOnce = kSeparateRoom;
  std::uint32_t found = 0;
  std::array<char, kBlock> last{};  // what is left at the end, and zeros
  for (std::size_t at = 0; at < text.size(); at += kBlock) {
    const char* block = text.data() + at;
    if (text.size() - at < kBlock) {
      text.copy(last.data(), kBlock, at);
      block = last.data();
    }
    const Masks masks = masks_of(block);
    for (std::uint64_t left = masks.of_values; left != 0; left &= left - 1) {
      const std::uint64_t up_to = left ^ (left - 1);
      *values++ = found + static_cast<std::uint32_t>(std::popcount(masks.all & up_to));
    }
    // Eight at a time, some of them for nothing: so that nothing is to be guessed.
    const auto count = static_cast<std::uint32_t>(std::popcount(masks.all));
    const auto behind = static_cast<std::uint32_t>(at) + 1;
    std::uint64_t left = masks.all;
    for (std::uint32_t done = 0; done < count; done += kAtOnce) {
#pragma GCC unroll 8
      for (std::uint32_t i = 0; i < kAtOnce; ++i) {
        starts[found + done + i] = behind + static_cast<std::uint32_t>(std::countr_zero(left));
        left &= left - 1;
      }
    }
    found += count;
  }
  return {.starts = starts + found, .values = values};
}

}  // namespace fitgauge::aqdef
