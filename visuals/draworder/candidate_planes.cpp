// Where to cut eye space. Section IV of the 1989 paper divides the viewing directions further until all hidden surfaces
// are removed, but does not say where. Whether B hides part of A changes only as the eye crosses a plane through an
// edge of one and a corner of the other, or one of their own planes (the planes of the aspect graph); these are the
// candidates.
#include "visuals/draworder/candidate_planes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// Points and planes closer than this count as one.
constexpr double grain = 1e-6;

/// A number in units of `grain`, for comparisons with tolerance.
std::int64_t grains(double value) { return std::llround(value / grain); }

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The corners and edges of some polygons' outlines, equal ones merged, in the order in which the polygons name them: a
/// model that is turned gets the same numbers.
struct Outlines {
    std::vector<glm::dvec3> corners; ///< Each position once.
    std::vector<Edge> edges;         ///< Each edge once, as a pair of indices into `corners`.
};

Outlines outlines_of(const ModelFaces& model, std::span<const std::uint32_t> among) {
    using Place = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
    std::map<Place, std::uint32_t> numbers;
    Outlines out;
    const auto number_of = [&](const glm::dvec3& corner) {
        const Place place{grains(corner.x), grains(corner.y), grains(corner.z)};
        const auto next = static_cast<std::uint32_t>(out.corners.size());
        const auto [at, is_new] = numbers.emplace(place, next);
        if (is_new) { out.corners.push_back(corner); }
        return at->second;
    };
    for (const std::uint32_t polygon : among) {
        const Face& face = model.faces[polygon];
        std::vector<std::uint32_t> outline;
        for (const glm::dvec3& corner : face.outline) { outline.push_back(number_of(corner)); }
        for (std::size_t i = 0; i < outline.size() && face.plane && !face.pivot; ++i) {
            const std::uint32_t next = outline[(i + 1) % outline.size()];
            out.edges.emplace_back(std::min(outline[i], next), std::max(outline[i], next));
        }
    }
    std::ranges::sort(out.edges);
    out.edges.erase(std::unique(out.edges.begin(), out.edges.end()), out.edges.end());
    return out;
}

/// The step with which about `most` of `all` items are taken.
std::size_t stride(std::size_t all, std::size_t most) { return all / most + 1; }

std::vector<Plane> axis_planes_of(const Outlines& outlines, std::size_t most) {
    std::vector<Plane> planes;
    const std::size_t all = 3 * outlines.corners.size();
    for (std::size_t i = 0; i < all; i += stride(all, most)) {
        const auto axis = static_cast<int>(i / outlines.corners.size());
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        planes.push_back({normal, -outlines.corners[i % outlines.corners.size()][axis]});
    }
    return planes;
}

void add_edge_planes(std::vector<Plane>& planes, const Outlines& outlines, std::size_t most) {
    const std::size_t all = outlines.edges.size() * outlines.corners.size();
    for (std::size_t i = 0; i < all; i += stride(all, most)) {
        const Edge& edge = outlines.edges[i / outlines.corners.size()];
        const glm::dvec3& corner = outlines.corners[i % outlines.corners.size()];
        const glm::dvec3& from = outlines.corners[edge.first];
        const glm::dvec3 along = outlines.corners[edge.second] - from;
        const glm::dvec3 across = glm::cross(along, corner - from);
        const double area = glm::length(across);
        if (area > 1e-6 * glm::length(along)) {
            const glm::dvec3 normal = across / area;
            planes.push_back({normal, -glm::dot(normal, from)});
        }
    }
}

/// A key of a plane that is the same for both of its orientations.
std::array<std::int64_t, 4> key_of(const Plane& plane) {
    std::array<std::int64_t, 4> key{
        grains(plane.normal.x), grains(plane.normal.y), grains(plane.normal.z), grains(plane.offset_m)};
    for (const std::int64_t part : key) {
        if (part != 0) {
            if (part < 0) {
                std::ranges::transform(key, key.begin(), [](std::int64_t k) { return -k; });
            }
            break;
        }
    }
    return key;
}

/// The planes without repetition, in their order.
std::vector<Plane> each_once(const std::vector<Plane>& planes) {
    std::vector<std::pair<std::array<std::int64_t, 4>, std::size_t>> keys;
    for (std::size_t i = 0; i < planes.size(); ++i) { keys.emplace_back(key_of(planes[i]), i); }
    std::ranges::sort(keys);
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (i == 0 || keys[i].first != keys[i - 1].first) { kept.push_back(keys[i].second); }
    }
    std::ranges::sort(kept);
    std::vector<Plane> out;
    for (const std::size_t i : kept) { out.push_back(planes[i]); }
    return out;
}

} // namespace

std::vector<Plane> axis_planes(const ModelFaces& model, std::span<const std::uint32_t> among, std::size_t most) {
    return each_once(axis_planes_of(outlines_of(model, among), most));
}

std::vector<Plane> candidate_planes(const ModelFaces& model, std::span<const std::uint32_t> among, std::size_t most) {
    const Outlines outlines = outlines_of(model, among);
    std::vector<Plane> planes;
    for (const std::uint32_t polygon : among) {
        if (model.faces[polygon].plane) { planes.push_back(*model.faces[polygon].plane); }
    }
    add_edge_planes(planes, outlines, most);
    return each_once(planes);
}

PlaneSide side_of(const Plane& plane, const Face& face, double on_plane) {
    double least = on_plane;
    double largest = -on_plane;
    for (const glm::dvec3& corner : face.corners) {
        const double height = distance_m(plane, corner);
        least = std::min(least, height);
        largest = std::max(largest, height);
    }
    return {least >= -on_plane, largest <= on_plane};
}

PolygonsByPlaneSide sides_of(const Plane& plane, const ModelFaces& model, std::span<const std::uint32_t> among) {
    PolygonsByPlaneSide sides(model.faces.size());
    for (const std::uint32_t polygon : among) {
        const Face& face = model.faces[polygon];
        const auto [before, behind] = side_of(plane, face, model.tolerances.on_plane);
        if (before) { sides.sets.front_or_on.add(polygon); }
        if (behind) { sides.sets.back_or_on.add(polygon); }
        if (before && behind && face.plane) {
            const bool along = glm::dot(plane.normal, face.plane->normal) > 0.0;
            (along ? sides.back_facing_behind : sides.back_facing_in_front).add(polygon);
        }
    }
    return sides;
}

} // namespace octant::visuals::draworder
