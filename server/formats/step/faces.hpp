#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "formats/step/part21.hpp"
#include "tables/iso286/nominal_size.hpp"

namespace fitgauge::step {

/// The shape of a dimension, as its faces show it.
struct Shape {
  std::optional<iso286::Feature> feature{};  ///< none unless all faces agree
  std::int64_t count = 1;                    ///< of axes: `4X` is four bores
  std::int64_t faces = 0;                    ///< that were read: `4X R2` are four
  bool is_round = false;                     ///< the first of them is
};

/// Round faces: material outside of them is a hole, inside a shaft. Of planes each with the nearest
/// one that looks the other way: a gap between them is a hole, material a shaft.
/// @param faces instances of a face, or of what is none and is passed over
Shape shape_of(const Part21& file, std::span<const std::uint32_t> faces);

}  // namespace fitgauge::step
