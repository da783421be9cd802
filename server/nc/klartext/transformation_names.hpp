#pragma once

#include <string_view>

#include "nc/klartext/statement.hpp"

/// How planes and modes are spelled; the parser and the printer share it. Rows are in the order of
/// their enumerations.
namespace fitgauge::klartext {

struct PlaneKindName {
  PlaneKind kind;
  std::string_view name;
};

inline constexpr PlaneKindName kPlaneKinds[] = {
    {PlaneKind::Spatial, "SPATIAL"}, {PlaneKind::Projected, "PROJECTED"},
    {PlaneKind::Euler, "EULER"},     {PlaneKind::Vector, "VECTOR"},
    {PlaneKind::Points, "POINTS"},   {PlaneKind::Relativ, "RELATIV"},
    {PlaneKind::Axial, "AXIAL"},     {PlaneKind::Reset, "RESET"},
};

struct PlanePositioningName {
  PlanePositioning positioning;
  std::string_view name;
};

inline constexpr PlanePositioningName kPlanePositionings[] = {
    {PlanePositioning::Turn, "TURN"},
    {PlanePositioning::Move, "MOVE"},
    {PlanePositioning::Stay, "STAY"},
};

struct OperatingModeName {
  OperatingMode mode;
  std::string_view name;
};

inline constexpr OperatingModeName kOperatingModes[] = {
    {OperatingMode::Mill, "MILL"},
    {OperatingMode::Turn, "TURN"},
    {OperatingMode::Grind, "GRIND"},
};

}  // namespace fitgauge::klartext
