#pragma once

#include "nc/machine/geometry.hpp"
#include "nc/probing/arguments.hpp"
#include "nc/probing/parameters.hpp"

/// The words of the dotted cycles 0, 1, 3, 4 and 30 to 33.
namespace fitgauge::probing::parameter {

constexpr CycleParameter in_part(std::uint8_t part, CycleParameter parameter) {
  parameter.part = part;
  return parameter;
}

constexpr CycleParameter result_parameter(std::uint8_t part, double last = 1999) {
  return in_part(part, {.id = ParameterId::WordResult,
                        .meaning = "Q parameter for the result",
                        .kind = ValueKind::Whole,
                        .range = {0, last}});
}

constexpr CycleParameter pre_position(std::uint8_t part, ParameterId axis) {
  return in_part(part, {.id = axis,
                        .meaning = "Position before probing",
                        .unit = Unit::Length,
                        .range = {-kLongest, kLongest},
                        .required = false});
}

inline constexpr CycleParameter kWordAxis{.id = ParameterId::WordAxis,
                                          .meaning = "Probing axis: 0 X, 1 Y, 2 Z",
                                          .kind = ValueKind::Whole,
                                          .range = {0, 2}};
inline constexpr CycleParameter kWordDirection{.id = ParameterId::WordDirection,
                                               .meaning = "Probing direction: -1 or +1",
                                               .kind = ValueKind::Whole,
                                               .range = {-1, 1}};
inline constexpr CycleParameter kWordAngle{.id = ParameterId::WordAngle,
                                           .meaning = "Probing angle from the axis",
                                           .unit = Unit::Angle,
                                           .range = {-360, 360},
                                           .default_value = 0};

constexpr CycleParameter height_parameter(std::uint8_t part) {
  return in_part(part, {.id = ParameterId::WordHeight,
                        .meaning = kClearanceHeight.meaning,
                        .unit = Unit::Length,
                        .range = kClearanceHeight.range});
}

inline constexpr std::array<CycleOutput, 5> kTouchResults{
    {{115, "Spindle position X at contact", Unit::Length},
     {116, "Spindle position Y at contact", Unit::Length},
     {117, "Spindle position Z at contact", Unit::Length},
     {118, "Fourth axis at contact", Unit::Angle},
     {119, "Fifth axis at contact", Unit::Angle}}};

}  // namespace fitgauge::probing::parameter

namespace fitgauge::probing {

/// The direction of ANGLE from the named axis towards the next one: X to Y, Y to Z, Z to X, as the
/// control counts angles in the planes XY, YZ and ZX.
machine::Vec3 angled_direction(const Arguments& arguments);

}  // namespace fitgauge::probing
