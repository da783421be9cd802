#pragma once

#include "nc/machine/axis.hpp"

namespace fitgauge::machine {

enum class MoveKind : std::uint8_t { Rapid, Feed, Probe, Arc };

/// "rapid", "feed", "probe", "arc".
std::string_view name(MoveKind kind);

/// Data of an arc except its ends, for the machine's forms without an additional scaling factor.
struct TracedArc {
  Vec3 centre;          ///< in input coordinates, at the height of the start
  double sweep_deg;     ///< as programmed; positive counter-clockwise seen from the axis' tip
  Axis axis = Axis::Z;  ///< of the input coordinates, across the arc's plane
  Vec3 machine_centre{};
  Vec3 machine_axis{};  ///< unit vector
};

/// The contact of a probing move.
struct TracedContact {
  Vec3 surface;  ///< the point of the surface, in input coordinates
  Vec3 machine_surface;
  std::optional<Vec3> normal;  ///< away from the material, in Machine coordinates, if it is known
};

/// One move of the trace: of the tool tip, in input and in machine coordinates.
struct TracedMove {
  MoveKind kind = MoveKind::Rapid;
  Position start;
  Position end;
  double feed_mm_min = 0;  ///< of a rapid the rate it is limited to
  double seconds = 0;
  Vec3 machine_start;  ///< Machine coordinates: a preset or a rotation does not break the line
  Vec3 machine_end;
  std::optional<TracedArc> arc{};
  std::optional<TracedContact> contact{};
};

}  // namespace fitgauge::machine
