#pragma once

#include "models/measure/plane_frame.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// A triangle in the coordinates of its own plane, in single precision, with its colours where there are any.
struct FlatTriangle : measure::PlaneFrame<float> {
    /// The colour at corner a, and its gradient along the plane's x and y axes.
    std::array<float, 3> colour;
    std::array<float, 3> colour_x;
    std::array<float, 3> colour_y;
};

/// The triangle without colours.
FlatTriangle flat(const std::array<glm::dvec3, 3>& corners);

/// The triangle with colours. On one without area the gradient may be zero.
FlatTriangle flat(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec3, 3>& corner_colours);

inline glm::dvec3 widen(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

/// Samples in structure-of-arrays layout, so that several are worked on with one instruction, and for each what was
/// found nearest to it.
class SampleBlock {
public:
    void clear() { size_ = 0; }

    std::size_t size() const { return size_; }

    /// Makes room for a total of so many samples, and for the rest of the last vector.
    void make_room(std::size_t samples);

    /// Adds a sample. make_room must have been called for it.
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
    std::vector<float> red, green, blue; ///< Filled by the caller where there are colours.
    std::vector<float> distances2;       ///< The squared distance to the nearest triangle.
    std::vector<float> colour_errors2;   ///< The squared difference in colour to the nearest point.
    std::vector<std::int32_t> nearest;   ///< The index of the nearest triangle.

private:
    std::size_t size_ = 0;
};

/// Finds the nearest triangle for all samples: fills distances2 and nearest, and colour_errors2 where `coloured`. Of
/// triangles at the same distance the first one counts. There must be at least one triangle (asserted).
void find_nearest(SampleBlock& samples, std::span<const FlatTriangle> triangles, bool coloured);

} // namespace octant::models::simplify
