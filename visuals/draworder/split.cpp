// Cuts one polygon of a model along a plane. Which polygons are cut, and where, is said in split_penetrating.cpp and
// cycle_split.cpp.

#include "visuals/draworder/split.h"

#include "models/planar/planar_model.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

using models::polygons::PolygonModel;
using Outline = std::vector<std::uint32_t>;

/// A side of a polygon that a cut passes through.
struct CutSide {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t middle = 0; ///< The new vertex on it.
};

/// The outlines of both pieces of a cut polygon.
struct Halves {
    Outline front;
    Outline back;
    std::vector<CutSide> cut_sides;
};

/// Cuts an outline. Corners within the tolerance belong to both halves; new vertices are added to the model.
Halves halves_of(PolygonModel& model, const Outline& outline, const Plane& plane, double tolerance_m) {
    Halves halves;
    const auto height_m = [&](std::uint32_t vertex) {
        const double at_m = distance_m(plane, model.vertices_m[vertex]);
        return std::abs(at_m) <= tolerance_m ? 0.0 : at_m;
    };
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::uint32_t here = outline[i];
        const std::uint32_t next = outline[(i + 1) % outline.size()];
        const double here_m = height_m(here);
        const double next_m = height_m(next);
        if (here_m >= 0.0) { halves.front.push_back(here); }
        if (here_m <= 0.0) { halves.back.push_back(here); }
        if (here_m * next_m < 0.0) {
            const auto middle = static_cast<std::uint32_t>(model.vertices_m.size());
            const double share = here_m / (here_m - next_m);
            model.vertices_m.push_back(glm::mix(model.vertices_m[here], model.vertices_m[next], share));
            halves.front.push_back(middle);
            halves.back.push_back(middle);
            halves.cut_sides.push_back({here, next, middle});
        }
    }
    return halves;
}

/// An outline with the vertices that cuts have put in the middle of its sides.
Outline with_cut_sides(
    const PolygonModel& model, std::span<const std::uint32_t> outline, const std::vector<CutSide>& sides) {
    const auto& at_m = model.vertices_m;
    Outline out;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        out.push_back(outline[i]);
        const glm::dvec3& here_m = at_m[outline[i]];
        const glm::dvec3& next_m = at_m[outline[(i + 1) % outline.size()]];
        for (const CutSide& side : sides) {
            const bool along = here_m == at_m[side.from] && next_m == at_m[side.to];
            const bool against = here_m == at_m[side.to] && next_m == at_m[side.from];
            if (along || against) { out.push_back(side.middle); }
        }
    }
    return out;
}

} // namespace

double split_tolerance_m(const PolygonModel& model) {
    if (model.vertices_m.empty()) { return 0.0; }
    glm::dvec3 least = model.vertices_m[0];
    glm::dvec3 most = model.vertices_m[0];
    for (const glm::dvec3& vertex : model.vertices_m) {
        least = glm::min(least, vertex);
        most = glm::max(most, vertex);
    }
    return models::planar::planar_tolerance * glm::distance(least, most) / 2.0;
}

std::uint32_t split_polygon(PolygonModel& model, std::size_t polygon, const Plane& plane) {
    const double tolerance_m = split_tolerance_m(model);
    const auto whole = model.corners(polygon);
    [[maybe_unused]] const auto height_m = [&](std::uint32_t corner) {
        return distance_m(plane, model.vertices_m[corner]);
    };
    assert(std::ranges::any_of(whole, [&](auto c) { return height_m(c) > tolerance_m; }));
    assert(std::ranges::any_of(whole, [&](auto c) { return height_m(c) < -tolerance_m; }));
    const Halves halves = halves_of(model, {whole.begin(), whole.end()}, plane, tolerance_m);
    if (model.parents.empty()) {
        model.parents.resize(model.polygons.size());
        std::iota(model.parents.begin(), model.parents.end(), 0U);
    }
    std::vector<std::uint32_t> corner_vertices;
    const auto add = [&](models::polygons::Polygon& to, const Outline& outline) {
        to.first_corner = static_cast<std::uint32_t>(corner_vertices.size());
        to.corner_count = static_cast<std::uint32_t>(outline.size());
        corner_vertices.insert(corner_vertices.end(), outline.begin(), outline.end());
    };
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        add(model.polygons[i], i == polygon ? halves.front : with_cut_sides(model, model.corners(i), halves.cut_sides));
    }
    const auto back = static_cast<std::uint32_t>(model.polygons.size());
    model.polygons.push_back(model.polygons[polygon]);
    model.parents.push_back(model.parents[polygon]);
    add(model.polygons.back(), halves.back);
    model.corner_vertices = std::move(corner_vertices);
    return back;
}

} // namespace octant::visuals::draworder
