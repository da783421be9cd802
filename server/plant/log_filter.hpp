#pragma once

#include <array>

#include "base/json/field_reader.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::connections {

/// What an outgoing connection takes of the log.
struct LogFilter {
  app::MeasurementQuery query{};  ///< of all but verdicts; corrections too
  std::array<bool, 4> verdicts{true, true, true, true};

  bool takes(const app::Measurement& measurement) const;
};

/// Reads the member `filter`: texts that a measurement must have, `verdict` (a list of words), and
/// `source` (gauge, simulation or all). What is wrong goes to `errors`.
LogFilter read_filter(api::FieldReader& fields, api::FieldErrors& errors);

}  // namespace fitgauge::connections
