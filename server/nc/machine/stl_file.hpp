#pragma once

#include "base/result.hpp"
#include "nc/machine/triangle_tree.hpp"

namespace fitgauge::machine {

/// Reads the triangles of an STL file, binary or text, in the file's unit. Normals are ignored: the
/// order of a triangle's corners defines the outside.
/// @errors FieldInvalid: the file is not STL, or the wrong line or triangle.
Result<std::vector<Triangle>> read_stl(std::string_view bytes);

/// Checks if the triangles bound a body: each has an area, each edge is shared by two in opposite
/// directions, and the volume is positive.
/// @errors FieldInvalid: the mesh is empty, degenerate, open, or inverted, and the place.
Result<void> check_closed(const std::vector<Triangle>& triangles);

/// Returns the volume in the cube of the triangles' unit.
double volume(const std::vector<Triangle>& triangles);

}  // namespace fitgauge::machine
