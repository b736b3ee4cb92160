#include "models/planar/planar_model.h"

#include "models/planar/decimal_grid.h"
#include "models/planar/incidences.h"
#include "models/planar/vertex_grid.h"
#include "models/planar/own_axes.h"
#include "models/planar/planarize.h"
#include "models/polygons/convex_pieces.h"
#include "models/polygons/polygon_check.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace octant::models::planar {

namespace {

using polygons::Pivot;
using polygons::PolygonModel;
using Outline = std::vector<std::uint32_t>;

/// No point moves farther than so many times the reach.
constexpr double moves_in_reaches = 4.0;
/// A polygon whose height over its longest side is less has no area.
constexpr double min_height = planar_tolerance;

/// A point in steps of the decimals of its file, where it has a grid of them. Far from the origin,
/// and in any unit, that gives the decimals that were written without what rounding has added.
glm::dvec3 in_steps(const PlanarModel& frame, const glm::dvec3& point_m) {
    return frame.grid_m > 0.0 ? glm::round(point_m / frame.grid_m) : point_m;
}

/// The box around some points.
struct Box {
    glm::dvec3 least{std::numeric_limits<double>::max()};
    glm::dvec3 most{std::numeric_limits<double>::lowest()};

    void add(const glm::dvec3& point) {
        least = glm::min(least, point);
        most = glm::max(most, point);
    }

    glm::dvec3 middle() const { return least + (most - least) / 2.0; }
};

/// A point in own axes from the base of the frame, in steps.
glm::dvec3 from_base(const PlanarModel& frame, const glm::dvec3& point_m) {
    return (in_steps(frame, point_m) - frame.base_steps) * frame.axes; // by the transpose
}

/// The axes, the middle of the box around all corners along them, and the distance of the farthest
/// corner from it.
void find_frame(const PolygonModel& model, Attitude attitude, PlanarModel& out) {
    out.grid_m = decimal_grid(model.vertices_m);
    if (model.corner_vertices.empty()) {
        return;
    }
    Box given;
    for (const std::uint32_t vertex : model.corner_vertices) {
        given.add(in_steps(out, model.vertices_m[vertex]));
    }
    out.base_steps = given.middle();
    if (attitude == Attitude::Own) {
        std::vector<glm::dvec3> points;
        for (const glm::dvec3& vertex_m : model.vertices_m) {
            points.push_back(from_base(out, vertex_m));
        }
        out.axes = own_axes(model, points);
    }
    Box own;
    for (const std::uint32_t vertex : model.corner_vertices) {
        own.add(from_base(out, model.vertices_m[vertex]));
    }
    out.centre_steps = own.middle();
    double farthest = 0.0;
    for (const std::uint32_t vertex : model.corner_vertices) {
        const glm::dvec3 at = from_base(out, model.vertices_m[vertex]);
        farthest = std::max(farthest, glm::distance(at, out.centre_steps));
    }
    out.radius_steps = farthest > 0.0 ? farthest : 1.0;
    out.radius_m = out.radius_steps * out.step_m();
}

glm::dvec3 in_radii(const PlanarModel& frame, const glm::dvec3& point_m) {
    return (from_base(frame, point_m) - frame.centre_steps) / frame.radius_steps;
}

/// For each vertex which part it turns with: 0 for what stands still, and for vertices without a
/// polygon.
std::vector<std::uint32_t> pivots_of_vertices(const PolygonModel& model) {
    std::vector<std::uint32_t> kind(model.vertices_m.size(), 0);
    for (std::size_t i = 0; i < model.polygons.size() && !model.pivots.empty(); ++i) {
        const auto pivot = polygons::pivot_of(model, i);
        for (const std::uint32_t vertex : model.corners(i)) {
            kind[vertex] = pivot ? *pivot + 1 : 0;
        }
    }
    return kind;
}

/// Moves the vertices, in radii, and tells which polygons stay bent.
std::vector<bool> move_vertices(PolygonModel& model) {
    const auto kind = pivots_of_vertices(model);
    const auto places = one_place(model.vertices_m, kind, touching_reach);
    const auto incidences = incidences_of(model, model.vertices_m, places, kind, touching_reach);
    auto bent = planarize(model.vertices_m, incidences, moves_in_reaches * touching_reach);
    for (std::size_t i = 0; i < places.size(); ++i) {
        model.vertices_m[i] = model.vertices_m[places[i]];
    }
    return bent;
}

/// The corners of a polygon without those in the place of the one before.
Outline different_corners(const PolygonModel& model, std::size_t polygon) {
    Outline out;
    for (const std::uint32_t vertex : model.corners(polygon)) {
        if (out.empty() || model.vertices_m[out.back()] != model.vertices_m[vertex]) {
            out.push_back(vertex);
        }
    }
    while (out.size() > 1 && model.vertices_m[out.back()] == model.vertices_m[out.front()]) {
        out.pop_back();
    }
    return out;
}

std::vector<glm::dvec3> places_of(const PolygonModel& model, const Outline& outline) {
    std::vector<glm::dvec3> places;
    for (const std::uint32_t vertex : outline) {
        places.push_back(model.vertices_m[vertex]);
    }
    return places;
}

/// Whether corners are on one line: twice the area over the longest side is a height.
bool has_no_area(const std::vector<glm::dvec3>& places) {
    glm::dvec3 sum(0.0);
    double longest = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::dvec3& next = places[(i + 1) % places.size()];
        sum += glm::cross(places[i] - places[0], next - places[0]);
        longest = std::max(longest, glm::distance(places[i], next));
    }
    return glm::length(sum) <= min_height * longest;
}

/// All triangles of a fan, for an outline that could not be cut otherwise.
std::vector<Outline> fan_of(const Outline& outline) {
    std::vector<Outline> pieces;
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
        pieces.push_back({outline[0], outline[i], outline[i + 1]});
    }
    return pieces;
}

/// Convex planar pieces of an outline, most often the outline itself.
std::vector<Outline> pieces_of(const PolygonModel& model, const Outline& outline, bool bent) {
    const auto places = places_of(model, outline);
    if (outline.size() == 3 || (!bent && !polygons::corners_fault(places, planar_tolerance))) {
        return {outline};
    }
    const auto convex = polygons::convex_pieces(places, planar_noise);
    if (convex.pieces.empty()) {
        return fan_of(outline);
    }
    std::vector<Outline> pieces;
    for (const auto& corners : convex.pieces) {
        Outline& piece = pieces.emplace_back();
        for (const std::size_t corner : corners) {
            piece.push_back(outline[corner]);
        }
    }
    return pieces;
}

/// Replaces bent and dented polygons by pieces and leaves those without an area out.
void triangulated_polygons(PlanarModel& planar, const std::vector<bool>& bent) {
    PolygonModel& model = planar.model;
    PolygonModel out;
    std::vector<std::uint32_t> parents;
    bool is_changed = !model.parents.empty();
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const Outline whole = different_corners(model, i);
        std::vector<Outline> pieces;
        if (whole.size() >= 3 && !has_no_area(places_of(model, whole))) {
            pieces = pieces_of(model, whole, bent[i]);
        }
        std::erase_if(
            pieces, [&](const Outline& piece) { return has_no_area(places_of(model, piece)); });
        const bool is_faulty =
            pieces.size() > 1 && polygons::corners_fault(places_of(model, whole), touching_reach);
        planar.triangulated_polygons += is_faulty ? 1 : 0;
        planar.dropped_polygons += pieces.empty() ? 1 : 0;
        is_changed = is_changed || pieces.size() != 1;
        for (const Outline& piece : pieces) {
            polygons::Polygon polygon = model.polygons[i];
            polygon.first_corner = static_cast<std::uint32_t>(out.corner_vertices.size());
            polygon.corner_count = static_cast<std::uint32_t>(piece.size());
            out.polygons.push_back(polygon);
            out.corner_vertices.insert(out.corner_vertices.end(), piece.begin(), piece.end());
            parents.push_back(model.parent_of(i));
        }
    }
    if (is_changed) {
        model.parents = std::move(parents);
    }
    model.polygons = std::move(out.polygons);
    model.corner_vertices = std::move(out.corner_vertices);
}

} // namespace

PlanarModel planar_model(const PolygonModel& model, Attitude attitude) {
    PlanarModel planar;
    planar.model = model;
    if (model.vertices_m.empty()) {
        return planar;
    }
    find_frame(model, attitude, planar);
    for (glm::dvec3& vertex : planar.model.vertices_m) {
        vertex = in_radii(planar, vertex);
    }
    for (Pivot& pivot : planar.model.pivots) {
        const glm::dvec3 point_steps = pivot.point_m / planar.step_m() - planar.base_steps;
        pivot.point_m = (point_steps * planar.axes - planar.centre_steps) / planar.radius_steps;
        pivot.axis = pivot.axis * planar.axes;
    }
    triangulated_polygons(planar, move_vertices(planar.model));
    return planar;
}

PolygonModel in_model_frame(PolygonModel changed, const PlanarModel& planar, const PolygonModel& given) {
    for (std::size_t i = 0; i < changed.vertices_m.size(); ++i) {
        glm::dvec3& vertex = changed.vertices_m[i];
        const bool is_still =
            i < given.vertices_m.size() && vertex == in_radii(planar, given.vertices_m[i]);
        vertex = is_still ? given.vertices_m[i] : planar.to_model_frame(vertex);
    }
    changed.pivots = given.pivots;
    return changed;
}

} // namespace octant::models::planar
