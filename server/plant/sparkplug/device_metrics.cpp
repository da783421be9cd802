#include "plant/sparkplug/device_metrics.hpp"

#include <optional>

namespace fitgauge::connections {
namespace {

using app::Measurement;
using app::MeasurementFields;
using Type = SparkplugType;
using Value = SparkplugValue;

Value text_or_null(const std::optional<std::string_view>& text) {
  return text ? Value(std::string(*text)) : Value();
}

template <std::optional<std::string_view> MeasurementFields::*kText>
Value text(const Measurement& measurement) {
  return text_or_null(measurement.*kText);
}

/// The nearest double: from nanometres, so that 13 µm are 13 and not 13.000000000000002.
double um(Length length) { return static_cast<double>(length.count()) / 1e3; }

}  // namespace

const std::array<DeviceMetric, 17> kDeviceMetrics = {{
    {"id", Type::String,
     [](const Measurement& m) { return Value(app::measurement_id_text(m.id, m.origin)); }},
    {"measured_mm", Type::Double, [](const Measurement& m) { return Value(m.measured.to_mm()); }},
    {"verdict", Type::String,
     [](const Measurement& m) { return Value(std::string(word(m.result.verdict))); }},
    {"deviation_um", Type::Double,
     [](const Measurement& m) {
       return m.has_nominal ? Value(um(m.decisive() - m.nominal_size)) : Value();
     }},
    {"excess_um", Type::Double,
     [](const Measurement& m) { return m.is_judged() ? Value(um(m.result.excess)) : Value(); }},
    {"nominal_mm", Type::Double,
     [](const Measurement& m) { return m.has_nominal ? Value(m.nominal_size.to_mm()) : Value(); }},
    {"upper_limit_mm", Type::Double,
     [](const Measurement& m) {
       return m.has_upper_limit() ? Value(m.upper_limit().to_mm()) : Value();
     }},
    {"lower_limit_mm", Type::Double,
     [](const Measurement& m) {
       return m.has_lower_limit() ? Value(m.lower_limit().to_mm()) : Value();
     }},
    {"tolerance_class", Type::String,
     [](const Measurement& m) { return text_or_null(m.class_name); }},
    {"measured_at", Type::DateTime,
     [](const Measurement& m) { return Value(milliseconds(m.measured_at)); }},
    {"part_id", Type::String, text<&MeasurementFields::part_id>},
    {"characteristic", Type::String, text<&MeasurementFields::characteristic>},
    {"order", Type::String, text<&MeasurementFields::order>},
    {"operation", Type::String, text<&MeasurementFields::operation>},
    {"machine", Type::String, text<&MeasurementFields::machine>},
    {"operator", Type::String, text<&MeasurementFields::operator_id>},
    {"gauge", Type::String, text<&MeasurementFields::gauge>},
}};

}  // namespace fitgauge::connections
