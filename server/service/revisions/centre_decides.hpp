#pragma once

#include <string_view>

#include "base/error.hpp"

namespace fitgauge::app {

/// The refusal to change at a station what its centre has given. @param what `the plan 'X'`
inline Error centre_decides(std::string_view what) {
  return {ErrorCode::Forbidden,
          std::string(what) +
              " came from the centre: change it there, and it is here within half a minute"};
}

}  // namespace fitgauge::app
