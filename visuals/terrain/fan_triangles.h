#pragma once

#include "visuals/terrain/fan_shape.h"
#include "visuals/terrain/step_function.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace octant::visuals::terrain {

/// How many triangles with an area a fan has: for each side without its mid-point, for each side with it beside either
/// of its quadrants, and for each quadrant.
struct FanTriangles {
    std::array<int, 4> whole{1, 1, 1, 1};
    std::array<int, 4> a{1, 1, 1, 1};
    std::array<int, 4> b{1, 1, 1, 1};
    std::array<int, 4> of_quadrant{2, 2, 2, 2}; ///< With mid-points.
};

/// The triangles of a node that the field's end does not cut.
inline constexpr FanTriangles uncut_fan_triangles;

/// The triangles of a node at the field's north or east end whose samples are moved onto it.
inline FanTriangles triangles_with_area(const FanSamples& samples) {
    FanTriangles triangles;
    triangles.of_quadrant = {};
    const GridSample centre = samples.at(1, 1);
    for (std::size_t k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        const GridSample a = samples.corner_a(edge);
        const GridSample b = samples.corner_b(edge);
        const GridSample middle = samples.middle(edge);
        triangles.whole[k] = has_area(centre, a, b) ? 1 : 0;
        triangles.a[k] = has_area(centre, a, middle) ? 1 : 0;
        triangles.b[k] = has_area(centre, middle, b) ? 1 : 0;
        triangles.of_quadrant[edge.quadrant_a] += triangles.a[k];
        triangles.of_quadrant[edge.quadrant_b] += triangles.b[k];
    }
    return triangles;
}

/// A corner of a triangle of the padded square, or of what the field's border leaves of one.
struct ClipVertex {
    GridSample at{};
    float height = 0.0F;
    /// The vertex at this corner; nothing where the border crosses an edge.
    std::uint32_t vertex = no_vertex;

    static constexpr std::uint32_t no_vertex = 0xffffffffU;
};

/// The part of a triangle within the field, counter-clockwise as the triangle; it has no area where there are fewer
/// than three corners.
struct ClippedPolygon {
    std::array<ClipVertex, 5> corner{};
    unsigned count = 0;

    int triangles() const { return count < 3 ? 0 : static_cast<int>(count) - 2; }
};

/// The part of a bisection's triangle up to the field's last column and row. Edges are level, upright or diagonal, so
/// that the border crosses them at samples, and at the same height from either side.
ClippedPolygon clip_to_border(const std::array<ClipVertex, 3>& triangle, const GridSample& last);

/// The triangles of a node at the field's north or east end that are left within the field.
FanTriangles triangles_within_border(const FanSamples& samples);

/// From which limits on the parts of a fan are in the mesh.
struct FanLimits {
    float node_limit = 0.0F;            ///< The fan itself.
    const std::array<float, 4>& middle; ///< The mid-points of fan_edges.
    unsigned hidden = 0;                ///< The quadrants without triangles.
    int replaced = 0;                   ///< How many triangles of its parent it replaces.
};

/// Adds the steps of N at which a fan appears and at which its mid-points do, those below `high`. The step of a
/// quadrant that splits is counted with the child. Returns whether there are steps above.
inline bool count_fan(const FanLimits& fan, const FanTriangles& triangles, float high, StepFunction& steps) {
    const auto unless_hidden = [&](unsigned quadrant, int some) {
        return (fan.hidden >> quadrant & 1U) == 0 ? some : 0;
    };
    bool more_above = false;
    int first = -fan.replaced;
    for (std::size_t k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        const int with_middle =
            unless_hidden(edge.quadrant_a, triangles.a[k]) + unless_hidden(edge.quadrant_b, triangles.b[k]);
        if (fan.middle[k] <= fan.node_limit) {
            first += with_middle;
            continue;
        }
        first += triangles.whole[k];
        if (fan.middle[k] < high) {
            steps.add(fan.middle[k], with_middle - triangles.whole[k]);
        } else {
            more_above = true;
        }
    }
    steps.add(fan.node_limit, first);
    return more_above;
}

} // namespace octant::visuals::terrain
