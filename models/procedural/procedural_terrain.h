#pragma once

#include "models/heights/height_field.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace octant::models::procedural {

/// Must be raised when the same options give other heights. Cached grounds of another version are generated again.
inline constexpr std::uint32_t procedural_version = 1;

/// The size of generated ground. The same options give the same heights bit for bit in every build; another size,
/// spacing or seed gives other ground. Shapes have fixed sizes in metres: a field of a few hundred metres shows one
/// slope. 1025 samples a side take about a second; memory is 4 bytes a sample for the result and temporarily up to 8
/// more (at least 60 MB).
struct ProceduralTerrainOptions {
    int size = 1025;         ///< samples a side, 2 to 20,000 (asserted)
    double spacing_m = 20.0; ///< above zero and finite (asserted)
    std::uint64_t seed = 1;
};

/// Gentle ground: rounded hills, branching valleys with flat floors, mostly below 20 degrees.
heights::HeightField procedural_hills(const ProceduralTerrainOptions& options = {});

/// Rugged ground: a plateau near 2,000 m cut by a winding river over 1,000 m deep, with side canyons, cliffs and
/// benches in level layers, and buttes.
heights::HeightField procedural_canyon(const ProceduralTerrainOptions& options = {});

/// Ground by its built-in name, "hills" or "canyon"; nothing for another name.
std::optional<heights::HeightField> procedural_terrain(
    std::string_view name, const ProceduralTerrainOptions& options = {});

/// A straight piece of a stream bed. Positions are in metres east and north of the field's centre, bed heights in
/// metres above the river in rock of uniform hardness.
struct Reach {
    glm::dvec2 from{0.0};
    glm::dvec2 to{0.0};
    double from_m = 0.0;
    double to_m = 0.0;
    double half_width_m = 0.0;
};

/// The river through a square with sides of `field_m` and all its tributaries.
std::vector<Reach> canyon_network(double field_m, std::uint64_t seed);

} // namespace octant::models::procedural
