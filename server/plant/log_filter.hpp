#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "base/json/body.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::connections {

/// What an outgoing connection takes of the log.
struct LogFilter {
  LogFilter() { query.history = true; }

  app::MeasurementQuery query{};  ///< of all but verdicts; corrections too
  std::set<std::string, std::less<>> verdicts{"good", "rework", "reject", "indeterminate",
                                              "unjudged"};
  enum class From : std::uint8_t { Gauge, Simulation, All } from = From::Gauge;

  bool takes(const app::Measurement& measurement) const;
};

/// The form of a LogFilter: an object of texts that a measurement must have, `verdict` (a list of
/// words), and `source`.
struct FilterForm {
  std::string schema(api::Side side) const;
  bool read(api::FieldReader& fields, std::string_view name, LogFilter& to) const;
};

}  // namespace fitgauge::connections
