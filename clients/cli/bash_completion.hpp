#pragma once

#include <string_view>

namespace fitgauge::cli {

/// completion/fitgauge.bash, from the build.
extern const std::string_view kBashCompletion;

}  // namespace fitgauge::cli
