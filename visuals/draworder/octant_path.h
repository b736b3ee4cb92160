#pragma once

#include "models/polygons/file_axes.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace octant::visuals::draworder {

// An octant path names an octant of eyes, or a part of it that was divided into four, once or several times: "+-+/0/3"
// is the fourth quarter of the first quarter of the octant +-+.

/// The greatest number of quarters that a path may name.
inline constexpr std::size_t max_path_levels = 24;

/// Whether a text is an octant path: the signs of x, y and z, then at most max_path_levels children 0 to 3, each after
/// a slash.
bool is_octant_path(std::string_view text);

/// The corners A, B, C of the flat triangle that stands for a part of an octant, on
/// |x| + |y| + |z| = 1.
using OctantTriangle = std::array<glm::dvec3, 3>;

/// The children of (A, B, C): with AB the midpoint of an edge, 0 = (A, AB, CA), 1 = (AB, B, BC), 2 = (CA, BC, C) and 3
/// = (BC, CA, AB).
std::array<OctantTriangle, 4> subdivided(const OctantTriangle& corners);

/// The triangle that an octant path names; A, B, C of an octant lie on the axes of x, y, z.
OctantTriangle octant_triangle(std::string_view path);

/// An octant path of the body axes as the file's axes say it: signs and children change places.
std::string path_in_file(const std::string& path, const models::polygons::FileAxes& axes);

/// The inverse of path_in_file.
std::string path_in_body(const std::string& path, const models::polygons::FileAxes& axes);

} // namespace octant::visuals::draworder
