#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "api/services.hpp"
#include "base/json/json_value.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// A figure that is computed from a JSON body and nothing else.
struct Computation {
  std::string pattern;
  Result<std::string> (*compute)(const JsonValue& body);  ///< gives the JSON of the answer
  std::string summary;
  std::string description{};
  std::string operation;
  std::string tag = "statistics";
  std::string reads;    ///< the schema of the body, by name
  std::string answers;  ///< the schema of the answer, by name
};

/// Its route. It is computed where it may take long, not on an I/O thread.
http::Route route_of(const Services& services, Computation computation);

/// Bodies of values are as large as those of measurements.
inline constexpr std::size_t kLargestValuesBody = std::size_t{32} << 20;
/// What is done with more values than a body may have.
inline constexpr std::string_view kOfManyValues =
    "store the values with POST /v1/measurements and take the figures of what is stored from GET "
    "/v1/measurements/summary, /capability and /chart";

}  // namespace fitgauge::api
