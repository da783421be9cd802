#pragma once

#include <string_view>

namespace fitgauge::api {

/// The version of the service, from the build.
inline constexpr std::string_view kVersion = FITGAUGE_VERSION;

}  // namespace fitgauge::api
