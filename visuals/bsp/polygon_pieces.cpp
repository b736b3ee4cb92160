// Polygons that are cut without loss: pieces inherit their plane and share vertices along edges.
#include "visuals/bsp/polygon_pieces.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace octant::visuals::bsp {

namespace {

/// The plane of a triangle; nothing when it has no area.
std::optional<Plane> plane_through(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 across = glm::cross(b - a, c - a);
    const double length = glm::length(across);
    if (length < std::numeric_limits<double>::min()) { return std::nullopt; }
    const glm::dvec3 normal = across / length;
    return Plane{normal, -glm::dot(normal, (a + b + c) / 3.0)};
}

} // namespace

PolygonPieces::PolygonPieces(const models::polygons::PolygonModel& model) {
    glm::dvec3 least(std::numeric_limits<double>::max());
    glm::dvec3 most(std::numeric_limits<double>::lowest());
    for (const std::uint32_t vertex : model.corner_vertices) {
        least = glm::min(least, model.vertices_m[vertex]);
        most = glm::max(most, model.vertices_m[vertex]);
    }
    if (!model.corner_vertices.empty()) {
        middle_m_ = (least + most) / 2.0;
        const double half_m = glm::length(most - least) / 2.0;
        unit_m_ = half_m > 0.0 ? half_m : 1.0;
    }
    pieces_.reserve(2 * model.polygons.size());
    std::map<std::tuple<double, double, double>, std::uint32_t> places;
    std::vector<std::uint32_t> vertex_of(model.vertices_m.size(), 0);
    for (std::uint32_t i = 0; i < model.vertices_m.size(); ++i) {
        const glm::dvec3& at_m = model.vertices_m[i];
        const auto [place, is_new] =
            places.try_emplace({at_m.x, at_m.y, at_m.z}, static_cast<std::uint32_t>(vertices_.size()));
        if (is_new) { vertices_.push_back({.at = (at_m - middle_m_) / unit_m_, .in_model = i}); }
        vertex_of[i] = place->second;
    }
    for (std::uint32_t i = 0; i < model.polygons.size(); ++i) {
        PolygonPiece& piece = pieces_.emplace_back();
        piece.source = i;
        for (const std::uint32_t vertex : model.corners(i)) { piece.corners.push_back(vertex_of[vertex]); }
        piece.plane = plane_of(piece);
        find_bounding_sphere(piece);
    }
    for (std::uint32_t i = 0; i < model.polygons.size(); ++i) {
        if (!models::polygons::pivot_of(model, i)) { // what turns is never cut
            add_triangles(i);
        }
    }
    first_count_ = model.polygons.size();
    for (std::size_t i = first_count_; i < pieces_.size(); ++i) { cut_from_.push_back(pieces_[i].source); }
}

/// The plane of a polygon by Newell's sum about its centre, so that far origins cost no digits; not a number for one
/// without area.
Plane PolygonPieces::plane_of(const PolygonPiece& piece) const {
    glm::dvec3 centre(0.0);
    for (const std::uint32_t vertex : piece.corners) {
        centre += at(vertex) / static_cast<double>(piece.corners.size());
    }
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < piece.corners.size(); ++i) {
        const glm::dvec3& next = at(piece.corners[(i + 1) % piece.corners.size()]);
        sum += glm::cross(at(piece.corners[i]) - centre, next - centre);
    }
    const glm::dvec3 normal = glm::normalize(sum);
    return {normal, -glm::dot(normal, centre)};
}

/// Cuts a polygon that is not planar into triangles.
void PolygonPieces::add_triangles(std::uint32_t polygon) {
    const std::vector<std::uint32_t> corners = pieces_[polygon].corners;
    const Plane plane = *pieces_[polygon].plane;
    const bool planar = std::ranges::all_of(
        corners, [&](std::uint32_t vertex) { return std::abs(distance_m(plane, at(vertex))) <= tolerance / 2.0; });
    if (planar || corners.size() == 3) { return; }
    bool first = true;
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const auto own = plane_through(at(corners[0]), at(corners[i - 1]), at(corners[i]));
        if (!own) { continue; }
        PolygonPiece& piece = first ? pieces_[polygon] : pieces_.emplace_back();
        first = false;
        piece.source = polygon;
        piece.corners = {corners[0], corners[i - 1], corners[i]};
        piece.plane = own;
        find_bounding_sphere(piece);
    }
}

void PolygonPieces::find_bounding_sphere(PolygonPiece& piece) const {
    glm::dvec3 least(std::numeric_limits<double>::max());
    glm::dvec3 most(std::numeric_limits<double>::lowest());
    for (const std::uint32_t vertex : piece.corners) {
        least = glm::min(least, at(vertex));
        most = glm::max(most, at(vertex));
    }
    piece.middle = (least + most) / 2.0;
    piece.radius = 0.0;
    for (const std::uint32_t vertex : piece.corners) {
        piece.radius = std::max(piece.radius, glm::distance(piece.middle, at(vertex)));
    }
}

void PolygonPieces::set_swept_hull(
    std::uint32_t piece, std::uint32_t pivot, std::span<const glm::dvec3> corners_m, bool is_body) {
    PolygonPiece& own = pieces_[piece];
    own.pivot = pivot;
    own.corners.clear();
    for (const glm::dvec3& corner_m : corners_m) {
        own.corners.push_back(static_cast<std::uint32_t>(vertices_.size()));
        vertices_.push_back({.at = (corner_m - middle_m_) / unit_m_});
    }
    if (is_body) { own.plane.reset(); }
    find_bounding_sphere(own);
}

void PolygonPieces::set_plane(std::uint32_t piece, const Plane& in_model) {
    pieces_[piece].plane = {in_model.normal, distance_m(in_model, middle_m_) / unit_m_};
}

void PolygonPieces::add_rigid(std::uint32_t occluder, std::uint32_t occluded) { rigid_.emplace(occluder, occluded); }

bool PolygonPieces::is_rigid(std::uint32_t occluder, std::uint32_t occluded) const {
    return rigid_.contains({occluder, occluded});
}

PlaneSideFlags PolygonPieces::sides_reached(std::uint32_t piece, const Plane& plane) const {
    const PolygonPiece& own = pieces_[piece];
    const double height = distance_m(plane, own.middle);
    if (height > own.radius + tolerance) { return {true, false}; }
    if (height < -own.radius - tolerance) { return {false, true}; }
    PlaneSideFlags sides_reached;
    for (const std::uint32_t vertex : own.corners) {
        if (sides_reached.before && sides_reached.behind) { break; }
        const double at_vertex = distance_m(plane, at(vertex));
        sides_reached.before = sides_reached.before || at_vertex > tolerance;
        sides_reached.behind = sides_reached.behind || at_vertex < -tolerance;
    }
    return sides_reached;
}

std::optional<std::uint32_t> PolygonPieces::find_edge(std::uint32_t a, std::uint32_t b) const {
    const auto ends_at = [&](std::uint32_t edge, std::uint32_t vertex) {
        return edge != no_edge && (edges_[edge].from == vertex || edges_[edge].to == vertex);
    };
    const std::uint32_t of_a = vertices_[a].edge;
    const std::uint32_t of_b = vertices_[b].edge;
    if (of_a != no_edge && (of_a == of_b || ends_at(of_a, b))) { return of_a; }
    if (ends_at(of_b, a)) { return of_b; }
    const auto known = edge_of_ends_.find((std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b));
    return known != edge_of_ends_.end() ? std::optional(known->second) : std::nullopt;
}

std::uint32_t PolygonPieces::edge_of(std::uint32_t a, std::uint32_t b) {
    if (const auto known = find_edge(a, b)) { return *known; }
    const auto made = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back({std::min(a, b), std::max(a, b), {}});
    edge_of_ends_.emplace((std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b), made);
    return made;
}

double PolygonPieces::share_of(std::uint32_t vertex, const Edge& edge) const {
    if (vertex == edge.from) { return 0.0; }
    return vertex == edge.to ? 1.0 : vertices_[vertex].share;
}

std::uint32_t PolygonPieces::crossing(std::uint32_t a, std::uint32_t b, const Plane& plane) {
    const std::uint32_t number = edge_of(a, b);
    Edge& edge = edges_[number];
    const glm::dvec3 from = at(edge.from);
    const glm::dvec3 to = at(edge.to);
    const double low = std::min(share_of(a, edge), share_of(b, edge));
    const double high = std::max(share_of(a, edge), share_of(b, edge));
    const double from_height = distance_m(plane, from);
    const double share = std::clamp(from_height / (from_height - distance_m(plane, to)), low, high);
    const double length = glm::distance(from, to);
    for (const std::uint32_t vertex : edge.between) {
        const double other = vertices_[vertex].share;
        if (std::abs(other - share) * length <= tolerance && other > low && other < high) { return vertex; }
    }
    const auto made = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back({.at = glm::mix(from, to, share), .edge = number, .share = share});
    edge.between.push_back(made);
    return made;
}

std::uint32_t PolygonPieces::cut(std::uint32_t piece, const Plane& plane) {
    assert(sides_reached(piece, plane).before && sides_reached(piece, plane).behind && !pieces_[piece].pivot);
    const std::vector<std::uint32_t> outline = pieces_[piece].corners;
    std::vector<double> heights;
    for (const std::uint32_t vertex : outline) {
        const double height = distance_m(plane, at(vertex));
        heights.push_back(std::abs(height) <= tolerance ? 0.0 : height);
    }
    std::vector<std::uint32_t> front;
    std::vector<std::uint32_t> back;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t next = (i + 1) % outline.size();
        if (heights[i] >= 0.0) { front.push_back(outline[i]); }
        if (heights[i] <= 0.0) { back.push_back(outline[i]); }
        if (heights[i] * heights[next] < 0.0) {
            const std::uint32_t middle = crossing(outline[i], outline[next], plane);
            front.push_back(middle);
            back.push_back(middle);
        }
    }
    const auto made = static_cast<std::uint32_t>(pieces_.size());
    PolygonPiece behind = pieces_[piece];
    behind.corners = std::move(back);
    find_bounding_sphere(behind);
    pieces_[piece].corners = std::move(front);
    find_bounding_sphere(pieces_[piece]);
    pieces_.push_back(std::move(behind));
    cut_from_.push_back(piece);
    return made;
}

std::vector<std::uint32_t> PolygonPieces::full_outline(const PolygonPiece& piece) const {
    std::vector<std::uint32_t> outline;
    for (std::size_t i = 0; i < piece.corners.size(); ++i) {
        const std::uint32_t here = piece.corners[i];
        const std::uint32_t next = piece.corners[(i + 1) % piece.corners.size()];
        outline.push_back(here);
        const auto number = find_edge(here, next);
        if (!number || edges_[*number].between.empty()) { continue; }
        const Edge& edge = edges_[*number];
        const double from = share_of(here, edge);
        const double to = share_of(next, edge);
        const std::size_t first = outline.size();
        for (const std::uint32_t vertex : edge.between) {
            const double share = vertices_[vertex].share;
            if (share > std::min(from, to) && share < std::max(from, to)) { outline.push_back(vertex); }
        }
        std::sort(
            outline.begin() + static_cast<std::ptrdiff_t>(first), outline.end(), [&](std::uint32_t a, std::uint32_t b) {
                const double before = vertices_[a].share;
                const double after = vertices_[b].share;
                return from < to ? before < after : before > after;
            });
    }
    return outline;
}

void PolygonPieces::write_to(models::polygons::PolygonModel& model) const {
    if (added() == 0) { return; }
    if (model.parents.empty()) {
        model.parents.resize(model.polygons.size());
        std::iota(model.parents.begin(), model.parents.end(), 0U);
    }
    std::vector<std::uint32_t> vertex_of(vertices_.size(), 0);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        vertex_of[i] = vertices_[i].in_model;
        if (vertices_[i].edge != no_edge) {
            vertex_of[i] = static_cast<std::uint32_t>(model.vertices_m.size());
            model.vertices_m.push_back(middle_m_ + vertices_[i].at * unit_m_);
        }
    }
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        if (i >= model.polygons.size()) {
            model.polygons.push_back(model.polygons[pieces_[i].source]);
            model.parents.push_back(model.parents[pieces_[i].source]);
        }
        const auto first = static_cast<std::uint32_t>(corners.size());
        if (!pieces_[i].pivot) {
            for (const std::uint32_t vertex : full_outline(pieces_[i])) { corners.push_back(vertex_of[vertex]); }
        } else {
            const auto own = model.corners(i);
            corners.insert(corners.end(), own.begin(), own.end());
        }
        model.polygons[i].first_corner = first;
        model.polygons[i].corner_count = static_cast<std::uint32_t>(corners.size()) - first;
    }
    model.corner_vertices = std::move(corners);
}

Plane PolygonPieces::in_model(const Plane& plane) const {
    return {plane.normal, plane.offset_m * unit_m_ - glm::dot(plane.normal, middle_m_)};
}

} // namespace octant::visuals::bsp
