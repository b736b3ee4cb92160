#pragma once

#include "models/heights/height_field.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace octant::models::procedural {

/// Raised whenever the same options give other heights: what was kept is then made anew.
inline constexpr std::uint32_t procedural_version = 1;

/// Size of made ground. The same options give the same heights bit for bit in every build; another size, spacing or
/// seed gives other ground. Shapes have their size in metres: a field of a few hundred metres shows one slope. 1025
/// samples 20 m apart take about a second; memory is 4 bytes a sample for the result and up to 8 more while it is made
/// (at least 60 MB).
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

} // namespace octant::models::procedural
