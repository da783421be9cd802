#include "nc/program/known_m_functions.hpp"

#include <algorithm>
#include <array>

namespace fitgauge::interpreter {
namespace {

constexpr std::array kKnown{0,   1,   2,   3,   4,   5,   6,   8,   9,   13,  14,  19,  30,
                            89,  90,  91,  92,  94,  97,  98,  99,  101, 102, 103, 105, 106,
                            107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 117, 118, 120,
                            124, 126, 127, 128, 129, 130, 134, 135, 136, 137, 138, 140, 141,
                            142, 143, 144, 145, 148, 149, 150, 197, 200, 201, 202, 203, 204};

}  // namespace

bool is_m_function(int number) { return std::binary_search(kKnown.begin(), kKnown.end(), number); }

}  // namespace fitgauge::interpreter
