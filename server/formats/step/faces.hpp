#pragma once

#include "formats/step/part21.hpp"
#include "tables/iso286/nominal_size.hpp"

namespace fitgauge::step {

/// A face on a surface with an axis: of a plane its normal, out of the material.
struct Face {
  bool is_round = false;
  bool is_same_sense = true;
  bool is_open = false;  ///< of an open shell, such as a construction copy: it shows no side
  double radius = 0;     ///< of a cylinder
  std::array<double, 3> point{};
  std::array<double, 3> axis{0, 0, 1};
};

/// @param id instance of a face, or any other instance
std::optional<Face> read_face(const Part21& file, std::uint32_t id);

/// Opens a face. A cylinder gets the side of the solids' cylinders that it is on, if they agree.
void lay_on(Face& face, std::span<const Face> solids);

/// The shape of a dimension, as its faces show it.
struct Shape {
  std::optional<iso286::Feature> feature{};  ///< none unless all faces agree
  std::int64_t count = 1;                    ///< of axes: `4X` is four bores
  std::int64_t faces = 0;                    ///< that were read: `4X R2` are four
  bool is_round = false;                     ///< the first of them is
  bool is_open = false;                      ///< true if all faces are
};

/// Returns the shape of faces. Round faces: material outside of them is a hole, inside a shaft.
/// Planes: each with the nearest plane that faces the other way; a gap between them is a hole,
/// material a shaft.
Shape shape_of(std::span<const Face> faces);

}  // namespace fitgauge::step
