#include "models/planar/incidences.h"

#include "models/planar/vertex_grid.h"
#include "models/polygons/separating_edge.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>

namespace octant::models::planar {

namespace {

/// The different places of a polygon's corners, without those that repeat the one before.
std::vector<std::uint32_t> corner_places(
    std::span<const std::uint32_t> corners, std::span<const std::uint32_t> places) {
    std::vector<std::uint32_t> out;
    for (const std::uint32_t vertex : corners) {
        if (out.empty() || out.back() != places[vertex]) { out.push_back(places[vertex]); }
    }
    while (out.size() > 1 && out.back() == out.front()) { out.pop_back(); }
    return out;
}

/// An outline with its plane, to ask what touches it.
class ClosedOutline {
public:
    ClosedOutline(std::span<const glm::dvec3> vertices, std::span<const std::uint32_t> corners)
        : vertices_(vertices), corners_(corners) {
        for (const std::uint32_t corner : corners) {
            least_ = glm::min(least_, vertices[corner]);
            most_ = glm::max(most_, vertices[corner]);
        }
        glm::dvec3 sum(0.0);
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) { sum += glm::cross(at(i) - at(0), at(i + 1) - at(0)); }
        const double area = glm::length(sum);
        has_plane_ = area > 0.0;
        normal_ = has_plane_ ? sum / area : sum;
    }

    const glm::dvec3& least() const { return least_; }

    const glm::dvec3& most() const { return most_; }

    bool touches(const glm::dvec3& point, double reach) const {
        if (!is_level_with(point, reach)) { return false; }
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            if (inside_of(i, point) < -reach) { return false; }
        }
        return true;
    }

    /// Whether two outlines lie in one plane, within the reach, and share more than their sides.
    bool covers(const ClosedOutline& other, double reach) const {
        return has_plane_ && other.has_plane_ && all_level(other, reach) && other.all_level(*this, reach) &&
               !has_beside(other, reach) && !other.has_beside(*this, reach);
    }

private:
    const glm::dvec3& at(std::size_t corner) const { return vertices_[corners_[corner]]; }

    bool is_level_with(const glm::dvec3& point, double reach) const {
        return has_plane_ && std::abs(glm::dot(point - at(0), normal_)) <= reach;
    }

    bool all_level(const ClosedOutline& other, double reach) const {
        return std::ranges::all_of(
            other.corners_, [&](std::uint32_t corner) { return is_level_with(vertices_[corner], reach); });
    }

    /// How far a point lies on the inner side of an edge's line.
    double inside_of(std::size_t edge, const glm::dvec3& point) const {
        const glm::dvec3& from = at(edge);
        const glm::dvec3 along = at((edge + 1) % corners_.size()) - from;
        return glm::dot(point - from, glm::cross(normal_, along)) / glm::length(along);
    }

    /// Whether one of the edges has all of another outline on its outer side.
    bool has_beside(const ClosedOutline& other, double reach) const {
        const auto place = [&](std::uint32_t corner) -> const glm::dvec3& { return vertices_[corner]; };
        return polygons::has_separating_edge(corners_, normal_, other.corners_, reach, place);
    }

    std::span<const glm::dvec3> vertices_;
    std::span<const std::uint32_t> corners_;
    glm::dvec3 least_{std::numeric_limits<double>::max()};
    glm::dvec3 most_{std::numeric_limits<double>::lowest()};
    glm::dvec3 normal_{0.0};
    bool has_plane_ = false;
};

/// Adds to a polygon's incidence the places that touch it.
void add_touching(Incidence& incidence, const ClosedOutline& outline, const VertexGrid& near,
    std::span<const glm::dvec3> vertices, double reach, const std::function<bool(std::uint32_t)>& may_touch) {
    std::vector<std::uint32_t> found;
    near.append_in_box(outline.least() - reach, outline.most() + reach, found);
    for (const std::uint32_t vertex : found) {
        if (may_touch(vertex) && std::ranges::find(incidence.corners, vertex) == incidence.corners.end() &&
            outline.touches(vertices[vertex], reach)) {
            incidence.touching.push_back(vertex);
        }
    }
}

void join(std::vector<std::uint32_t>& places, const Incidence& with, const Incidence& except) {
    for (const std::uint32_t corner : with.corners) {
        if (std::ranges::find(except.corners, corner) == except.corners.end()) { places.push_back(corner); }
    }
}

/// Lets polygons that cover each other in one plane share it with all their corners.
void join_planes(std::vector<Incidence>& incidences, const std::vector<std::optional<ClosedOutline>>& outlines,
    std::span<const std::uint32_t> kind, double reach) {
    std::vector<std::uint32_t> by_x;
    for (std::uint32_t i = 0; i < outlines.size(); ++i) {
        if (outlines[i]) { by_x.push_back(i); }
    }
    std::ranges::stable_sort(by_x, {}, [&](std::uint32_t i) { return outlines[i]->least().x; });
    for (std::size_t i = 0; i < by_x.size(); ++i) {
        const ClosedOutline& a = *outlines[by_x[i]];
        for (std::size_t j = i + 1; j < by_x.size(); ++j) {
            const ClosedOutline& b = *outlines[by_x[j]];
            if (b.least().x > a.most().x + reach) { break; }
            const bool apart = b.least().y > a.most().y + reach || a.least().y > b.most().y + reach ||
                               b.least().z > a.most().z + reach || a.least().z > b.most().z + reach;
            Incidence& of_a = incidences[by_x[i]];
            Incidence& of_b = incidences[by_x[j]];
            if (!apart && kind[of_a.corners[0]] == kind[of_b.corners[0]] && a.covers(b, reach)) {
                join(of_a.touching, of_b, of_a);
                join(of_b.touching, of_a, of_b);
            }
        }
    }
}

} // namespace

std::vector<Incidence> incidences_of(const polygons::PolygonModel& model, std::span<const glm::dvec3> vertices,
    std::span<const std::uint32_t> places, std::span<const std::uint32_t> kind, double reach) {
    const VertexGrid near(vertices);
    std::vector<bool> used(vertices.size());
    for (const std::uint32_t vertex : model.corner_vertices) { used[places[vertex]] = true; }
    std::vector<Incidence> out(model.polygons.size());
    std::vector<std::optional<ClosedOutline>> outlines(out.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].corners = corner_places(model.corners(i), places);
        if (out[i].corners.size() < 3) { continue; }
        outlines[i].emplace(vertices, out[i].corners);
        const std::uint32_t own = kind[out[i].corners[0]];
        add_touching(out[i], *outlines[i], near, vertices, reach,
            [&](std::uint32_t vertex) { return places[vertex] == vertex && used[vertex] && kind[vertex] == own; });
    }
    join_planes(out, outlines, kind, reach);
    for (Incidence& incidence : out) {
        std::ranges::sort(incidence.touching);
        auto& touching = incidence.touching;
        touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
    }
    return out;
}

} // namespace octant::models::planar
