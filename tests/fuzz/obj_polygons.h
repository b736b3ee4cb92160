#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace octant::tests::fuzz {

/// Polygons by the places of their corners, counter-clockwise seen from the front, metres.
using Soup = std::vector<std::vector<glm::dvec3>>;

/// An OBJ model as text: what a user would bring, and what a reduction keeps to the last digit.
struct ObjPolygons {
    std::vector<std::string> vertices;              ///< "x y z"
    std::vector<std::vector<std::size_t>> polygons; ///< indices into `vertices`, from 0
};

/// How the numbers of a file are written.
enum class Digits {
    All,        ///< as many as it takes to read a number back bit for bit
    SixDecimals ///< six behind the point, as modelling tools write them
};

/// Corners that are written alike become one vertex.
ObjPolygons obj_polygons(const Soup& soup, Digits digits);

/// Reads `v` and `f` lines; everything else of a file is left out. Throws Error.
ObjPolygons read_obj_polygons(const std::filesystem::path& file);

/// The text of an OBJ file; vertices that no polygon uses are left out. `comment` is its first line.
std::string text_of(const ObjPolygons& model, const std::string& comment);

} // namespace octant::tests::fuzz
