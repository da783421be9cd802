#pragma once

#include <string>
#include <vector>

#include "api/services.hpp"
#include "api/wire/json_value.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// The route of a figure that is computed from a JSON body and nothing else. It is computed where
/// it may take long, not on an I/O thread.
/// @param compute gives the JSON of the answer
http::Route computation(const Services& services, std::string pattern,
                        Result<std::string> (*compute)(const JsonValue& body), std::string summary,
                        std::string description);

/// Bodies of values are as large as those of measurements.
inline constexpr std::size_t kLargestValuesBody = std::size_t{32} << 20;

}  // namespace fitgauge::api
