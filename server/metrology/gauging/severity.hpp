#pragma once

#include "metrology/gauging/gauge.hpp"

namespace fitgauge::gauging {

/// Orders verdicts: reject is the worst, before rework, indeterminate and good; least is none.
constexpr int severity(std::optional<Verdict> verdict) {
  constexpr std::array<int, kVerdicts> kSeverity = {1, 3, 4, 2, 0};
  return verdict ? kSeverity.at(static_cast<std::size_t>(*verdict)) : 0;
}

}  // namespace fitgauge::gauging
