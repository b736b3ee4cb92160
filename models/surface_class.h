#pragma once

#include <cstdint>

namespace octant::models {

/// What a surface of a picture is. The numbers are part of the interface of the ground truth (visuals/scene/truth.h).
enum class SurfaceClass : std::uint8_t {
    Sky = 0, ///< nothing at all, too
    Terrain = 1,
    Water = 2,
    Road = 3,
    Runway = 4,
    Building = 5,
    Tree = 6,
    Aircraft = 7,
    Cloud = 8
};

/// Consecutive vertices of a list that belong to one thing, or to several of one class.
struct VertexRun {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
    SurfaceClass surface = SurfaceClass::Terrain;
};

} // namespace octant::models
