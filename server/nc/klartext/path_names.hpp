#pragma once

#include <string_view>

#include "nc/klartext/statement.hpp"

/// How positioning blocks are spelled; the parser and the printer share it.
namespace fitgauge::klartext {

/// In the order of Path.
inline constexpr std::string_view kPaths[] = {
#define FITGAUGE_PATH(path, spelling, words) spelling,
#include "nc/klartext/paths.inc"
#undef FITGAUGE_PATH
};

}  // namespace fitgauge::klartext
