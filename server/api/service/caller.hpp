#pragma once

#include <string>

namespace fitgauge::api {

/// Who sent a request, as the guard found out: the name of an API key, or empty where none is
/// needed.
struct Caller {
  std::string name;
};

}  // namespace fitgauge::api
