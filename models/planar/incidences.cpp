#include "models/planar/incidences.h"

#include "models/polygons/polygon_outlines.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>

namespace octant::models::planar {

// A grid of equal cells as counting-sorted lists. Points lie on surfaces: with eight cells a point a cell that is not
// empty holds a few.

namespace {

constexpr int max_cells_an_axis = 128;

} // namespace

VertexGrid::VertexGrid(std::span<const glm::dvec3> points) {
    Box box;
    for (const glm::dvec3& point : points) { box.add(point); }
    min_ = box.min;
    const glm::dvec3 extent = points.empty() ? glm::dvec3(0.0) : box.max - box.min;
    const double largest = std::max({extent.x, extent.y, extent.z});
    const double an_axis =
        std::clamp(2.0 * std::cbrt(static_cast<double>(points.size())), 1.0, static_cast<double>(max_cells_an_axis));
    cell_ = largest > 0.0 ? largest / an_axis : 1.0;
    cells_ = glm::ivec3(extent / cell_) + 1;
    first_.assign(index_of(cells_ - 1) + 2, 0);
    for (const glm::dvec3& point : points) { ++first_[index_of(cell_of(point)) + 1]; }
    for (std::size_t i = 1; i < first_.size(); ++i) { first_[i] += first_[i - 1]; }
    numbers_.resize(points.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < points.size(); ++i) { numbers_[next[index_of(cell_of(points[i]))]++] = i; }
    places_.reserve(points.size());
    for (const std::uint32_t number : numbers_) { places_.push_back(points[number]); }
}

glm::ivec3 VertexGrid::cell_of(const glm::dvec3& point) const {
    const glm::dvec3 at = glm::floor((point - min_) / cell_);
    return glm::ivec3(glm::clamp(at, glm::dvec3(0.0), glm::dvec3(cells_ - 1)));
}

std::size_t VertexGrid::index_of(const glm::ivec3& cell) const {
    const glm::ivec3& size = cells_;
    return static_cast<std::size_t>((cell.z * size.y + cell.y) * size.x + cell.x);
}

void VertexGrid::append_in_box(const glm::dvec3& min, const glm::dvec3& max, std::vector<std::uint32_t>& out) const {
    const glm::ivec3 from = cell_of(min);
    const glm::ivec3 to = cell_of(max);
    for (int z = from.z; z <= to.z; ++z) {
        for (int y = from.y; y <= to.y; ++y) {
            const std::size_t begin = first_[index_of({from.x, y, z})];
            const std::size_t end = first_[index_of({to.x, y, z}) + 1];
            for (std::size_t i = begin; i < end; ++i) {
                const glm::dvec3& point = places_[i];
                if (glm::all(glm::greaterThanEqual(point, min)) && glm::all(glm::lessThanEqual(point, max))) {
                    out.push_back(numbers_[i]);
                }
            }
        }
    }
}

void VertexGrid::append_near_segment(
    const glm::dvec3& from, const glm::dvec3& to, double reach, std::vector<std::uint32_t>& out) const {
    constexpr double max_pieces = 4.0 * max_cells_an_axis;
    const double pieces = std::clamp(std::ceil(glm::distance(from, to) / cell_), 1.0, max_pieces);
    for (double i = 0.0; i < pieces; ++i) {
        const glm::dvec3 begin = glm::mix(from, to, i / pieces);
        const glm::dvec3 end = glm::mix(from, to, (i + 1.0) / pieces);
        // Twice the reach: places between the pieces' ends are rounded.
        append_in_box(glm::min(begin, end) - 2.0 * reach, glm::max(begin, end) + 2.0 * reach, out);
    }
}

std::vector<std::uint32_t> one_place(
    std::span<const glm::dvec3> points, std::span<const std::uint32_t> kind, double reach) {
    const VertexGrid near(points);
    std::vector<std::uint32_t> place(points.size());
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        found.clear();
        near.append_in_box(points[i] - reach, points[i] + reach, found);
        place[i] = i;
        for (const std::uint32_t other : found) {
            const bool joins = other < i && place[other] == other && kind[other] == kind[i] &&
                               glm::distance(points[other], points[i]) <= reach;
            if (joins) { place[i] = std::min(place[i], other); }
        }
    }
    return place;
}

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
        for (const std::uint32_t corner : corners) { box_.add(vertices[corner]); }
        glm::dvec3 sum(0.0);
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) { sum += glm::cross(at(i) - at(0), at(i + 1) - at(0)); }
        const double area = glm::length(sum);
        has_plane_ = area > 0.0;
        normal_ = has_plane_ ? sum / area : sum;
    }

    const Box& box() const { return box_; }

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
    Box box_;
    glm::dvec3 normal_{0.0};
    bool has_plane_ = false;
};

/// Adds to a polygon's incidence the places that touch it.
void add_touching(Incidence& incidence, const ClosedOutline& outline, const VertexGrid& near,
    std::span<const glm::dvec3> vertices, double reach, const std::function<bool(std::uint32_t)>& may_touch) {
    std::vector<std::uint32_t> found;
    near.append_in_box(outline.box().min - reach, outline.box().max + reach, found);
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
    std::ranges::stable_sort(by_x, {}, [&](std::uint32_t i) { return outlines[i]->box().min.x; });
    for (std::size_t i = 0; i < by_x.size(); ++i) {
        const ClosedOutline& a = *outlines[by_x[i]];
        for (std::size_t j = i + 1; j < by_x.size(); ++j) {
            const ClosedOutline& b = *outlines[by_x[j]];
            if (b.box().min.x > a.box().max.x + reach) { break; }
            const bool apart = glm::any(glm::greaterThan(b.box().min, a.box().max + reach)) ||
                               glm::any(glm::greaterThan(a.box().min, b.box().max + reach));
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
