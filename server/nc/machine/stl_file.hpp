#pragma once

#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "nc/machine/triangle_tree.hpp"

namespace fitgauge::machine {

/// The triangles of an STL file, binary or text, in the file's own unit. Its normals are not looked
/// at: the order of a triangle's corners says which side is out.
/// @errors FieldInvalid: the file is not STL, or which line or triangle is wrong.
Result<std::vector<Triangle>> read_stl(std::string_view bytes);

/// Whether the triangles bound a body: none without an area, each edge shared by two that run along
/// it in opposite ways, and a positive volume.
/// @errors FieldInvalid: the mesh is empty, degenerate, open, or turned inside out, and where.
Result<void> check_closed(const std::vector<Triangle>& triangles);

/// In the cube of the triangles' unit.
double volume(const std::vector<Triangle>& triangles);

}  // namespace fitgauge::machine
