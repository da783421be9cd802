#pragma once

#include <array>
#include <string_view>

#include "plant/sparkplug/payload.hpp"
#include "record/measurement.hpp"

namespace fitgauge::connections {

/// What every device reports of its last measurement: the same metrics, whatever is measured, so
/// that a birth names all that will ever come.
struct DeviceMetric {
  std::string_view name;
  SparkplugType type;
  SparkplugValue (*value)(const app::Measurement& measurement);
};

extern const std::array<DeviceMetric, 17> kDeviceMetrics;

}  // namespace fitgauge::connections
