#pragma once

#include <cstdint>
#include <optional>

#include "klartext/statement.hpp"
#include "machine/machine.hpp"
#include "run/nc_error.hpp"
#include "run/plane_geometry.hpp"

namespace fitgauge::interpreter {

class Channel;

/// One positioning block as geometry: its curve in the working plane and the axes it names,
/// absolute, in mm and degrees.
struct Element {
  Curve curve;
  machine::AxisWords target;
  machine::Feed feed;
  machine::CoordinateSystem system = machine::CoordinateSystem::Input;
};

/// The programmed path as far as it takes more than one block to know it: the pole, the last
/// direction (for CT and DEP), corners that RND and CHF change, approaches. A block that is
/// followed by RND or CHF moves when the block after that is known.
class Contour {
 public:
  /// APPR LT, LN, CT, LCT: moves when the first contour element is known.
  struct Approach {
    klartext::Path path{};  ///< of the Cartesian spelling
    Element to_start;       ///< a line to the first point of the contour
    double length = 0;      ///< LEN
    double angle = 0;       ///< CCA
    double radius = 0;      ///< R
    double side = 1;        ///< of the contour the tool is on: 1 left, -1 right
  };

  /// Where the last block ends, in input coordinates, also when the machine is not there yet.
  machine::Position position(const Channel& channel) const;

  /// Moves along an element, or keeps it when a corner follows.
  NcResult<void> add(Channel& channel, Element element);
  /// RND (`size` is the radius) or CHF (the length) after the last element.
  NcResult<void> set_corner(double size, bool is_chamfer, std::optional<machine::Feed> feed);
  NcResult<void> add(Channel& channel, Approach approach);
  /// Before anything but a positioning block: moves what was kept.
  /// @errors 1022, 1024 when the element that RND, CHF or APPR refers to is missing.
  NcResult<void> finish(Channel& channel);

  std::optional<Vec2> pole;          ///< CC, in the working plane
  Vec2 last_polar;                   ///< PR, PA of the last polar block, for IPR and IPA
  std::optional<Vec2> direction;     ///< of travel at the end of the last element
  double tool_feed = 0;              ///< F AUTO: the feed of TOOL CALL
  bool feed_per_revolution = false;  ///< M136

 private:
  struct Corner {
    double size = 0;
    bool is_chamfer = false;
    std::optional<machine::Feed> feed;
  };

  NcResult<void> move(Channel& channel, const Element& element);
  NcResult<void> turn_corner(Channel& channel, Element& next);
  NcResult<void> approach(Channel& channel, Vec2 contour_direction);

  std::optional<Element> kept_;
  std::optional<Corner> corner_;
  std::optional<Approach> approach_;
};

/// The working plane of the tool in the spindle.
WorkingPlane working_plane(const Channel& channel);

}  // namespace fitgauge::interpreter
