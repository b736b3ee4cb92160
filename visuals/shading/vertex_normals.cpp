// Corner normals by crease angle. Kim and Park's hybrid rendering model (2008) takes vertex normals for given; Gouraud
// shading needs them, and a model file need not bring any.
//
// For each vertex, corners are connected where their faces share an edge at that vertex. A breadth of corners is
// collected from each corner across those edges, as long as normals stay within the crease angle of the first one's,
// and their face normals are averaged.
//
// Deviations: the paper counts 4 operations for a plain average of the faces around a vertex; here the average is
// weighted by angles, and edges sharper than the crease angle stay sharp.
#include "visuals/shading/vertex_normals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <unordered_map>

namespace octant::visuals::shading {

// Normals inside polygons by mean value coordinates: M. S. Floater, "Mean value coordinates", Computer Aided Geometric
// Design 20 (1), 2003, equation (2.1).
//
// Gouraud shading interpolates between a polygon's corners. When the 1989 paper's painting order needs a polygon cut in
// two (section IV, figure 14), new corners appear, and normals computed from the pieces would show the cut. So each new
// corner takes its normal from the uncut polygon: weight of corner i = (tan(a_(i-1) / 2) + tan(a_i / 2)) / |corner i -
// point|, where a_i is the angle under which the point sees the side from corner i to corner i + 1.
//
// Deviations: at corners and on sides, where the equation divides by 0, its limit is taken.

namespace {

/// Two points closer than this share of the side's length are the same point.
constexpr double same_place = 1e-9;

/// The corners of one uncut polygon in order, with a unit normal for each.
struct Outline {
    std::vector<glm::dvec3> places_m;
    std::vector<glm::dvec3> normals;
};

/// How far a point lies outside a polygon, metres: the larger of its distance from the plane and its distance beyond
/// any side. 0 for a point inside.
double outside_m(const models::polygons::PolygonModel& model, std::size_t polygon, const glm::dvec3& point_m) {
    const glm::dvec3 normal = models::polygons::normal_of(model, polygon);
    const auto corners = model.corners(polygon);
    double max_m = std::abs(distance_m(models::polygons::plane_of(model, polygon), point_m));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3& here_m = model.vertices_m[corners[i]];
        const glm::dvec3& next_m = model.vertices_m[corners[(i + 1) % corners.size()]];
        const glm::dvec3 outwards = glm::normalize(glm::cross(next_m - here_m, normal));
        max_m = std::max(max_m, glm::dot(outwards, point_m - here_m));
    }
    return max_m;
}

/// The index of that candidate polygon of `whole` in which a point lies, or which is nearest to it. Several candidates
/// occur when the file's polygon had already been cut into convex parts.
std::size_t polygon_around(
    const models::polygons::PolygonModel& whole, std::span<const std::size_t> candidates, const glm::dvec3& point_m) {
    std::size_t best = candidates.front();
    double min_m = std::numeric_limits<double>::max();
    for (const std::size_t candidate : candidates) {
        const double outside = outside_m(whole, candidate, point_m);
        if (outside < min_m) {
            min_m = outside;
            best = candidate;
        }
    }
    return best;
}

/// The tangent of half the angle between two vectors. Returns -1 where they point in opposite directions, that is,
/// where the point lies on the side between their ends.
double half_tangent(const glm::dvec3& one, const glm::dvec3& other) {
    const double lengths = glm::length(one) * glm::length(other);
    const double sine = glm::length(glm::cross(one, other));
    const double below = lengths + glm::dot(one, other);
    return below <= same_place * lengths ? -1.0 : sine / below;
}

/// Equation (2.1) for a point inside an outline. The result is not yet of unit length.
glm::dvec3 normal_at(const Outline& outline, const glm::dvec3& point_m) {
    const std::size_t count = outline.places_m.size();
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const glm::dvec3 here_m = outline.places_m[i] - point_m;
        const glm::dvec3 next_m = outline.places_m[next] - point_m;
        const double here_away_m = glm::length(here_m);
        const double next_away_m = glm::length(next_m);
        const double side_m = glm::distance(here_m, next_m);
        if (here_away_m <= same_place * side_m) { return outline.normals[i]; }
        if (next_away_m <= same_place * side_m) { return outline.normals[next]; }
        const double tangent = half_tangent(here_m, next_m);
        if (tangent < 0.0) { return (next_away_m * outline.normals[i] + here_away_m * outline.normals[next]) / side_m; }
        sum += tangent * (outline.normals[i] / here_away_m + outline.normals[next] / next_away_m);
    }
    return sum;
}

Outline outline_of(
    const models::polygons::PolygonModel& model, std::size_t polygon, std::span<const glm::vec3> normals) {
    Outline outline;
    for (const std::uint32_t vertex : model.corners(polygon)) {
        const std::size_t corner = model.polygons[polygon].first_corner + outline.places_m.size();
        outline.places_m.push_back(model.vertices_m[vertex]);
        outline.normals.emplace_back(normals[corner]);
    }
    return outline;
}

glm::dvec3 middle_of(const models::polygons::PolygonModel& model, std::size_t polygon) {
    glm::dvec3 sum_m(0.0);
    const auto corners = model.corners(polygon);
    for (const std::uint32_t vertex : corners) { sum_m += model.vertices_m[vertex]; }
    return sum_m / static_cast<double>(corners.size());
}

} // namespace

namespace {

/// Calls set(corner, value, polygon) for each corner of `pieces`: the mixture of the values at the corners of its
/// polygon of `whole`, whose index is `polygon`.
template <class Set>
void for_each_piece_corner(const models::polygons::PolygonModel& whole, std::span<const glm::vec3> values,
    const models::polygons::PolygonModel& pieces, const Set& set) {
    assert(values.size() == whole.corner_vertices.size());
    std::unordered_map<std::uint32_t, std::vector<std::size_t>> of_parent;
    for (std::size_t i = 0; i < whole.polygons.size(); ++i) { of_parent[whole.parent_of(i)].push_back(i); }
    for (std::size_t i = 0; i < pieces.polygons.size(); ++i) {
        const auto candidates = of_parent.find(pieces.parent_of(i));
        assert(candidates != of_parent.end());
        const std::size_t polygon = polygon_around(whole, candidates->second, middle_of(pieces, i));
        const Outline outline = outline_of(whole, polygon, values);
        std::size_t corner = pieces.polygons[i].first_corner;
        for (const std::uint32_t vertex : pieces.corners(i)) {
            set(corner++, normal_at(outline, pieces.vertices_m[vertex]), polygon);
        }
    }
}

} // namespace

std::vector<glm::vec3> piece_normals(const models::polygons::PolygonModel& whole, std::span<const glm::vec3> normals,
    const models::polygons::PolygonModel& pieces) {
    std::vector<glm::vec3> made(pieces.corner_vertices.size());
    for_each_piece_corner(
        whole, normals, pieces, [&](std::size_t corner, const glm::dvec3& normal, std::size_t polygon) {
            const double length = glm::length(normal);
            made[corner] = glm::vec3(length > 0.0 ? normal / length : models::polygons::normal_of(whole, polygon));
        });
    return made;
}

std::vector<glm::vec2> piece_texture_coordinates(
    const models::polygons::PolygonModel& whole, const models::polygons::PolygonModel& pieces) {
    assert(whole.corner_texture_coordinates.size() == whole.corner_vertices.size());
    std::vector<glm::vec3> values; // the third part counts the weights
    for (const glm::vec2& place : whole.corner_texture_coordinates) { values.emplace_back(place.x, place.y, 1.0F); }
    std::vector<glm::vec2> made(pieces.corner_vertices.size());
    for_each_piece_corner(whole, values, pieces, [&](std::size_t corner, const glm::dvec3& sum, std::size_t) {
        made[corner] = glm::vec2(glm::dvec2(sum.x, sum.y) / sum.z);
    });
    return made;
}

namespace {

constexpr int fixed = -1; ///< Stands for the pivot of faces that do not turn.
/// The tolerance on cosines and on the length of a sum of normals.
constexpr double same_direction = 1e-9;

/// One corner of a face. A "place" is a vertex number; vertices at the same position share one.
struct Corner {
    std::uint32_t face = 0;
    std::uint32_t place = 0;
    std::uint32_t before = 0; ///< The place of the previous corner in the face.
    std::uint32_t after = 0;  ///< The place of the next corner in the face.
    double angle_rad = 0.0;   ///< The face's interior angle at this corner.
};

struct Face {
    glm::dvec3 normal{0.0}; ///< A unit vector; zero where the face has no area.
    int turns_with = fixed; ///< The index of the pivot that the face turns about.
};

struct Faces {
    std::vector<Face> faces;
    std::vector<Corner> corners; ///< Face after face.
};

/// For each vertex the lowest number of a vertex at exactly the same position.
std::vector<std::uint32_t> places_of(std::span<const glm::dvec3> vertices_m) {
    std::vector<std::uint32_t> sorted(vertices_m.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    const auto key = [&](std::uint32_t v) { return std::tuple(vertices_m[v].x, vertices_m[v].y, vertices_m[v].z, v); };
    std::ranges::sort(sorted, {}, key);
    std::vector<std::uint32_t> places(vertices_m.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const bool again = i > 0 && vertices_m[sorted[i]] == vertices_m[sorted[i - 1]];
        places[sorted[i]] = again ? places[sorted[i - 1]] : sorted[i];
    }
    return places;
}

void add_corners(Faces& faces, std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> places,
    std::span<const glm::dvec3> vertices_m) {
    const std::size_t count = vertices.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t here = vertices[i];
        const std::uint32_t before = vertices[(i + count - 1) % count];
        const std::uint32_t after = vertices[(i + 1) % count];
        faces.corners.push_back({.face = static_cast<std::uint32_t>(faces.faces.size()),
            .place = places[here],
            .before = places[before],
            .after = places[after],
            .angle_rad = angle_rad(vertices_m[before] - vertices_m[here], vertices_m[after] - vertices_m[here])});
    }
}

/// All corners at one place, and which of them are neighbours across an edge.
class Around {
public:
    explicit Around(const Faces& faces) : faces_(&faces) {}

    /// Turns to another place. `corners` are the indices of all corners there, in ascending order.
    void look_at(std::span<const std::uint32_t> corners) {
        corners_ = corners;
        neighbours_.assign(corners.size(), {});
        edges_.clear();
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            edges_.push_back({corner(i).before, i, false});
            edges_.push_back({corner(i).after, i, true});
        }
        std::ranges::sort(edges_, {}, &Edge::other_end);
        for (std::size_t first = 0; first < edges_.size();) {
            std::size_t end = first;
            while (end < edges_.size() && edges_[end].other_end == edges_[first].other_end) { ++end; }
            connect(std::span(edges_).subspan(first, end - first));
            first = end;
        }
    }

    /// The normal of one corner (by its index among those looked at). `min_cosine` is the cosine of the crease angle.
    glm::vec3 normal_at(std::uint32_t start, double min_cosine) {
        const Face& own = face(start);
        if (own.normal == glm::dvec3(0.0)) { return glm::vec3(0.0F, 0.0F, 1.0F); }
        reach(start, min_cosine);
        // Summed in the order of corners, so that corners with the same faces get the same bits.
        glm::dvec3 sum(0.0);
        for (std::uint32_t i = 0; i < corners_.size(); ++i) {
            sum += reached_[i] ? corner(i).angle_rad * face(i).normal : glm::dvec3(0.0);
        }
        const double length = glm::length(sum);
        return glm::vec3(length > same_direction ? sum / length : own.normal);
    }

private:
    struct Edge {
        std::uint32_t other_end = 0;
        std::uint32_t corner = 0;
        bool leaves = false; ///< The face runs from this place to the other end, not towards it.
    };

    const Corner& corner(std::uint32_t i) const { return faces_->corners[corners_[i]]; }

    const Face& face(std::uint32_t i) const { return faces_->faces[corner(i).face]; }

    /// Makes neighbours of all corners whose faces run along one edge in opposite directions.
    void connect(std::span<const Edge> same_edge) {
        for (const Edge& leaving : same_edge) {
            for (const Edge& coming : same_edge) {
                if (leaving.leaves && !coming.leaves && leaving.corner != coming.corner) {
                    neighbours_[leaving.corner].push_back(coming.corner);
                    neighbours_[coming.corner].push_back(leaving.corner);
                }
            }
        }
    }

    /// Marks the corners that share a smooth surface with `start`.
    void reach(std::uint32_t start, double min_cosine) {
        reached_.assign(corners_.size(), 0);
        reached_[start] = 1;
        waiting_.assign(1, start);
        while (!waiting_.empty()) {
            const std::uint32_t from = waiting_.back();
            waiting_.pop_back();
            for (const std::uint32_t to : neighbours_[from]) {
                if (reached_[to] == 0 && face(to).turns_with == face(start).turns_with &&
                    face(to).normal != glm::dvec3(0.0) && glm::dot(face(to).normal, face(start).normal) >= min_cosine) {
                    reached_[to] = 1;
                    waiting_.push_back(to);
                }
            }
        }
    }

    const Faces* faces_;
    std::span<const std::uint32_t> corners_;
    std::vector<std::vector<std::uint32_t>> neighbours_;
    std::vector<Edge> edges_;
    std::vector<std::uint8_t> reached_;
    std::vector<std::uint32_t> waiting_;
};

/// The normals of all corners: sorts the corners by place and looks at each place once.
std::vector<glm::vec3> normals_of(const Faces& faces, double crease_rad) {
    assert(crease_rad >= 0.0 && crease_rad <= pi);
    std::vector<std::uint32_t> sorted(faces.corners.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::ranges::stable_sort(sorted, {}, [&](std::uint32_t c) { return faces.corners[c].place; });
    std::vector<glm::vec3> normals(faces.corners.size());
    Around around(faces);
    for (std::size_t first = 0; first < sorted.size();) {
        std::size_t end = first;
        while (end < sorted.size() && faces.corners[sorted[end]].place == faces.corners[sorted[first]].place) { ++end; }
        const auto corners = std::span<const std::uint32_t>(sorted).subspan(first, end - first);
        around.look_at(corners);
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            normals[corners[i]] = around.normal_at(i, std::cos(crease_rad) - same_direction);
        }
        first = end;
    }
    return normals;
}

} // namespace

std::vector<glm::vec3> corner_normals(const models::polygons::PolygonModel& model, double crease_rad) {
    const std::vector<std::uint32_t> places = places_of(model.vertices_m);
    Faces faces;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        add_corners(faces, model.corners(i), places, model.vertices_m);
        const auto pivot = models::polygons::pivot_of(model, i);
        faces.faces.push_back({models::polygons::normal_of(model, i), pivot ? static_cast<int>(*pivot) : fixed});
    }
    std::vector<glm::vec3> normals = normals_of(faces, crease_rad);
    if (model.corner_normals.size() != normals.size()) { return normals; } // pieces of a model have none
    for (std::size_t corner = 0; corner < normals.size(); ++corner) {
        if (model.corner_normals[corner] != glm::vec3(0.0F)) { normals[corner] = model.corner_normals[corner]; }
    }
    return normals;
}

std::vector<glm::vec3> corner_normals(const models::TriangleMesh& mesh, double crease_rad) {
    const std::vector<std::uint32_t> places = places_of(mesh.vertices_m);
    Faces faces;
    for (const models::Triangle& triangle : mesh.triangles) {
        add_corners(faces, triangle, places, mesh.vertices_m);
        faces.faces.push_back({models::normal_of(mesh, triangle), fixed});
    }
    return normals_of(faces, crease_rad);
}

} // namespace octant::visuals::shading
