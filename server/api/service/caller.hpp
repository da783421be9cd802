#pragma once

#include <cstdint>
#include <string>

namespace fitgauge::api {

/// Who sent a request, as the guard found out: the name of an API key, or empty where none is
/// needed.
struct Caller {
  std::string name;
  std::int64_t key = 0;  ///< of app::KeyService
};

}  // namespace fitgauge::api
