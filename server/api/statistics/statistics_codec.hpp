#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "base/json/applicable.hpp"
#include "base/json/json_writer.hpp"
#include "metrology/statistics/anova.hpp"
#include "metrology/statistics/capability.hpp"
#include "metrology/statistics/control_chart.hpp"
#include "metrology/statistics/gauge_study.hpp"
#include "metrology/statistics/summary.hpp"

// The answers of /v1/statistics. Figures have 17 significant digits; what is undefined is null.

namespace fitgauge::api {

/// What charts of some kinds alone take, of what is sent as of what is stored.
std::span<const Applicable> chart_members();

void write_summary(JsonWriter& json, const metrology::Summary& summary);

/// degrees_of_freedom, sum_of_squares and mean_square, without braces.
void write_variation_members(JsonWriter& json, const metrology::Variation& variation);
void write_test_members(JsonWriter& json, const metrology::FTest& test);

/// Writes members that name the point of a violation, beside its index.
using PointName = std::function<void(JsonWriter&, const metrology::ChartViolation&)>;

/// The members of a chart's answer, without braces.
void write_chart_members(JsonWriter& json, const metrology::ControlCharts& charts,
                         const PointName& name = {});

/// The same of a capability.
void write_capability_members(JsonWriter& json, const metrology::Capability& capability,
                              const metrology::SpecificationLimits& limits, long double confidence,
                              const PointName& name = {});

/// @param tolerance none: its shares are null
void write_gauge_study(JsonWriter& json, const metrology::GaugeStudy& study,
                       metrology::StudyMethod method, const std::optional<long double>& tolerance);

void write_linearity(JsonWriter& json, const metrology::LinearityStudy& study);

}  // namespace fitgauge::api
