// Triangles of the padded square at the field's border. They are cut off there, so that a vertex lies in the middle of
// its edge everywhere and appears without moving the ground, also where the field's size is not a power of two. It has
// no source; the quadtree paper's fields are 2^n + 1.
#include "visuals/terrain/fan_triangles.h"

#include <algorithm>

namespace octant::visuals::terrain {

namespace {

int along(const GridSample& at, bool rows) { return rows ? at.row : at.column; }

/// Where an edge crosses the last column or row.
ClipVertex crossing(const ClipVertex& a, const ClipVertex& b, int last, bool rows) {
    // From the western or southern end, so that both triangles at an edge get the same height.
    const bool in_order = along(a.at, rows) < along(b.at, rows);
    const ClipVertex& from = in_order ? a : b;
    const ClipVertex& to = in_order ? b : a;
    const int way = along(to.at, rows) - along(from.at, rows);
    const int part = last - along(from.at, rows);
    const float share = static_cast<float>(part) / static_cast<float>(way);
    const GridSample at{from.at.column + (to.at.column - from.at.column) / way * part,
        from.at.row + (to.at.row - from.at.row) / way * part};
    return {at, from.height + share * (to.height - from.height), ClipVertex::no_vertex};
}

ClippedPolygon up_to(const ClippedPolygon& whole, int last, bool rows) {
    ClippedPolygon cut;
    for (unsigned k = 0; k < whole.count; ++k) {
        const ClipVertex& own = whole.corner[k];
        const ClipVertex& next = whole.corner[k + 1 == whole.count ? 0 : k + 1];
        const int beyond = along(own.at, rows) - last;
        const int next_beyond = along(next.at, rows) - last;
        if (beyond <= 0) { cut.corner[cut.count++] = own; }
        if ((beyond < 0 && next_beyond > 0) || (beyond > 0 && next_beyond < 0)) {
            cut.corner[cut.count++] = crossing(own, next, last, rows);
        }
    }
    return cut;
}

} // namespace

ClippedPolygon clip_to_border(const std::array<ClipVertex, 3>& triangle, const GridSample& last) {
    ClippedPolygon whole;
    std::copy(triangle.begin(), triangle.end(), whole.corner.begin());
    whole.count = 3;
    return up_to(up_to(whole, last.column, false), last.row, true);
}

FanTriangles triangles_within_border(const FanSamples& samples) {
    const auto count = [&](const GridSample& a, const GridSample& b) {
        return clip_to_border({{{samples.padded(1, 1)}, {a}, {b}}}, samples.last()).triangles();
    };
    FanTriangles triangles;
    triangles.of_quadrant = {};
    for (std::size_t k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        const GridSample a = samples.padded_ring(2 * k);
        const GridSample middle = samples.padded_ring(2 * k + 1);
        const GridSample b = samples.padded_ring((2 * k + 2) % 8);
        triangles.whole[k] = count(a, b);
        triangles.a[k] = count(a, middle);
        triangles.b[k] = count(middle, b);
        triangles.of_quadrant[edge.quadrant_a] += triangles.a[k];
        triangles.of_quadrant[edge.quadrant_b] += triangles.b[k];
    }
    return triangles;
}

} // namespace octant::visuals::terrain
