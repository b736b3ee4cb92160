#pragma once

#include "models/measure/plane_frame.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// A triangle in a plane of its own, with colours where there are any.
struct FlatTriangle : measure::PlaneFrame<float> {
    /// Colour: at corner a, and how it grows along x and y.
    std::array<float, 3> colour;
    std::array<float, 3> colour_x;
    std::array<float, 3> colour_y;
};

FlatTriangle flat(const std::array<glm::dvec3, 3>& corners);

/// With colours, which may have no slope on a triangle without area.
FlatTriangle
flat(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec3, 3>& corner_colours);

/// Points one beside the other, and for each what was found nearest to it.
class PointBlock {
public:
    void clear() { size_ = 0; }

    std::size_t size() const { return size_; }

    void make_room(std::size_t points);

    /// make_room must have been called for at least that many.
    void add(std::uint32_t number, const std::array<float, 3>& place, float weight) {
        numbers[size_] = number;
        x[size_] = place[0];
        y[size_] = place[1];
        z[size_] = place[2];
        weights[size_] = weight;
        ++size_;
    }

    std::vector<std::uint32_t> numbers;
    std::vector<float> x, y, z, weights;
    std::vector<float> red, green, blue; ///< filled by the caller where there are colours
    std::vector<float> distances2;       ///< to the nearest triangle, squared
    std::vector<float> colour_errors2;   ///< at the nearest point, squared
    std::vector<std::int32_t> nearest;   ///< which triangle

private:
    std::size_t size_ = 0;
};

/// Fills distances2 and nearest (of triangles at the same distance the first) for the points from
/// `first` up to `end`, and colour_errors2 where `coloured`. `first` is a multiple of 8.
void find_nearest(
    PointBlock& points,
    std::size_t first,
    std::size_t end,
    std::span<const FlatTriangle> triangles,
    bool coloured);

/// Square of the distance from a place to the nearest of the points; there must be one.
float least_distance2(PointBlock& points, const std::array<float, 3>& place);

} // namespace octant::models::simplify
