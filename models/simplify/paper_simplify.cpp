// The paper's own mode, for comparison: Y. Kim, B. U. Lee, "Error measure for vertex simplification", 2005, section II.
// The shortest edge (v1, v2) is contracted to that one of v1, v2 and (v1 + v2) / 2 which costs least, until the wanted
// number of vertices is left. Contraction has no test that keeps a manifold: plain lists of faces at vertices
// therefore, not half-edges.
//
// Deviations, where the paper is silent or contradicts itself:
// - An edge's length is the distance of its ends in space. The paper's figures for the globe come
//   out only with colour in that length, which is an option.
// - Equal lengths go by the numbers of the vertices, equal costs to the first end before the second
//   before the midpoint.
// - The faces of both ends are united, each once. A cost is the sum of squared distances from a
//   candidate to them; the opposite direction is the sum from both ends to the faces as moved, the
//   two that collapse included; bidirectional is the larger sum.
// - Vertices that no face uses are counted, as the paper's 2000 points of 1725 faces show.
//
// The distance from a point to a triangle: section II.2, equations (3) to (6) and cases 1 to 3. Case 1: the foot is
// inside, and the distance is that to the plane. Case 2: the point lies between the two planes through an edge's ends
// perpendicular to it, and the distance is that to the edge. Case 3: the distance is that to the nearest corner.
// Deviations:
// - The matrix of (6) is singular for every triangle whose plane contains the origin. The same
//   minimum is found here from the two edge vectors at P1.
// - "a, b, c = 1" is read as a + b + c = 1.
// - In case 2 the nearest of the edges counts. A corner nearer than all of them counts too, for
//   beyond a corner the opposite edge may lie between its planes and yet be far.
// - Everything works in six dimensions, so that colour can count.
//
// The quadrics of the previous measure: equations (1) and (2), after M. Garland, P. S. Heckbert, "Surface
// simplification using quadric error metrics", 1997, and "Simplifying surfaces with color and texture using quadric
// error metrics", 1998. The paper does not say how the previous measure takes colour in; the second source is used.
// Planes are not weighted by area, as in (1).
#include "models/simplify/paper_simplify.h"

#include "models/collapse_sequence.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace octant::models::simplify {

namespace {

template <typename Operation>
Point6 combined(const Point6& a, const Point6& b, Operation operation) {
    Point6 made;
    std::ranges::transform(a, b, made.begin(), operation);
    return made;
}

Point6 operator-(const Point6& a, const Point6& b) { return combined(a, b, std::minus<>()); }

/// a + t b.
Point6 along(const Point6& a, double t, const Point6& b) {
    return combined(a, b, [t](double x, double y) { return x + t * y; });
}

double dot(const Point6& a, const Point6& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

double squared_distance(const Point6& a, const Point6& b) { return dot(a - b, a - b); }

glm::dvec3 position_m(const Point6& x) { return {x[0], x[1], x[2]}; }

/// Cases 2 and 3: the squared distance to the border of the triangle.
double border_distance2(const Corners& triangle, const Point6& x) {
    double min2 = squared_distance(x, triangle[0]);
    for (std::size_t i = 0; i < 3; ++i) {
        const Point6& from = triangle[i];
        const Point6 edge = triangle[(i + 1) % 3] - from;
        const double length2 = dot(edge, edge);
        const double reach = dot(x - from, edge);
        const bool is_between = reach > 0.0 && reach < length2;
        min2 = std::min(min2, squared_distance(x, is_between ? along(from, reach / length2, edge) : from));
    }
    return min2;
}

bool strictly_between_0_and_1(double part) { return part > 0.0 && part < 1.0; }

} // namespace

Foot foot_on(const Corners& triangle, const Point6& x) {
    const Point6 u = triangle[1] - triangle[0];
    const Point6 v = triangle[2] - triangle[0];
    const Point6 r = x - triangle[0];
    const double uu = dot(u, u);
    const double uv = dot(u, v);
    const double vv = dot(v, v);
    const double area2 = uu * vv - uv * uv;
    // The squared sine of the angle between the edges, below which the triangle has no area.
    constexpr double collapsed = 1e-14;
    if (area2 > collapsed * uu * vv) {
        const double ru = dot(r, u);
        const double rv = dot(r, v);
        const double b = (vv * ru - uv * rv) / area2;
        const double c = (uu * rv - uv * ru) / area2;
        const double a = 1.0 - b - c;
        if (strictly_between_0_and_1(a) && strictly_between_0_and_1(b) && strictly_between_0_and_1(c)) {
            return {true, squared_distance(r, along(along({}, b, u), c, v))};
        }
    }
    return {false, border_distance2(triangle, x)};
}

PlaneQuadric PlaneQuadric::of_plane(const Corners& triangle) {
    PlaneQuadric quadric;
    const glm::dvec3 first_m = position_m(triangle[0]);
    const glm::dvec3 across = glm::cross(position_m(triangle[1]) - first_m, position_m(triangle[2]) - first_m);
    const double length = glm::length(across);
    if (length == 0.0) { return quadric; }
    const glm::dvec3 unit = across / length;
    const Point6 normal{unit.x, unit.y, unit.z, 0.0, 0.0, 0.0};
    const double offset_m = -glm::dot(unit, first_m);
    std::size_t k = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i; j < 6; ++j) { quadric.a_[k++] = normal[i] * normal[j]; }
        quadric.b_[i] = offset_m * normal[i];
    }
    quadric.c_ = offset_m * offset_m;
    return quadric;
}

PlaneQuadric PlaneQuadric::of_coloured_plane(const Corners& triangle) {
    PlaneQuadric quadric;
    const Point6& p = triangle[0];
    Point6 first = triangle[1] - p;
    Point6 second = triangle[2] - p;
    const double first_length = std::sqrt(dot(first, first));
    if (first_length == 0.0) { return quadric; }
    first = along({}, 1.0 / first_length, first);
    second = along(second, -dot(first, second), first);
    const double second_length = std::sqrt(dot(second, second));
    if (second_length == 0.0) { return quadric; }
    second = along({}, 1.0 / second_length, second);
    const double p_first = dot(p, first);
    const double p_second = dot(p, second);
    std::size_t k = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i; j < 6; ++j) {
            quadric.a_[k++] = (i == j ? 1.0 : 0.0) - first[i] * first[j] - second[i] * second[j];
        }
        quadric.b_[i] = p_first * first[i] + p_second * second[i] - p[i];
    }
    quadric.c_ = dot(p, p) - p_first * p_first - p_second * p_second;
    return quadric;
}

void PlaneQuadric::add(const PlaneQuadric& other) {
    std::ranges::transform(a_, other.a_, a_.begin(), std::plus<>());
    b_ = along(b_, 1.0, other.b_);
    c_ += other.c_;
}

double PlaneQuadric::at(const Point6& x) const {
    double sum = c_;
    std::size_t k = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        double row = a_[k++] * x[i] + 2.0 * b_[i];
        for (std::size_t j = i + 1; j < 6; ++j) { row += 2.0 * a_[k++] * x[j]; }
        sum += row * x[i];
    }
    return std::max(sum, 0.0);
}

namespace {

/// The three candidates of the paper for the vertex that a contraction makes: v1, v2 and (v1 + v2) / 2.
enum class Place { First, Second, Middle };

Point6 placed(const Point6& first, const Point6& second, Place place) {
    const auto middle = [](double x, double y) { return 0.5 * (x + y); };
    return place == Place::Middle ? combined(first, second, middle) : (place == Place::First ? first : second);
}

glm::vec3 placed(const glm::vec3& first, const glm::vec3& second, Place place) {
    return place == Place::Middle ? 0.5F * (first + second) : (place == Place::First ? first : second);
}

/// An edge with its length at the time when it was put into the queue.
struct QueuedEdge {
    double length2 = 0.0;
    std::uint32_t first = 0; ///< The vertex with the smaller number.
    std::uint32_t second = 0;
    /// How often both ends had changed until then; tells outdated entries.
    std::uint32_t changes = 0;

    /// Orders the queue so that the shortest edge is on top.
    bool operator<(const QueuedEdge& other) const {
        return std::tie(other.length2, other.first, other.second, other.changes) <
               std::tie(length2, first, second, changes);
    }
};

/// One simplification. Vertices are contracted two by two, whatever becomes of the surface: triangles may come to lie
/// on each other, and edges may get more than two triangles.
class PaperRun {
public:
    PaperRun(const TriangleMesh& original, const PaperOptions& options);

    /// Contracts the shortest edge. Returns false when there is none.
    bool contract_shortest();

    bool goal_met() const {
        return (options_.goal.vertices && result.counted_vertices <= *options_.goal.vertices) ||
               (options_.goal.faces && face_count_ <= *options_.goal.faces);
    }

    void show_share() const;

    /// The present mesh without vertices that no face uses, with the original's materials.
    TriangleMesh left_over() const;

    PaperResult result;

private:
    /// How many perpendiculars were dropped on triangles, and how many feet lay outside: the last column of the paper's
    /// table.
    struct FeetCount {
        std::size_t all = 0;
        std::size_t outside = 0;
    };

    /// An edge that is about to be contracted.
    struct Contraction {
        std::uint32_t first = 0;
        std::uint32_t second = 0;
        std::vector<std::uint32_t> faces; ///< At either of its ends, each once, ascending.
    };

    Corners corners(std::uint32_t face) const {
        const auto& [a, b, c] = faces_[face];
        return {points_[a], points_[b], points_[c]};
    }

    void queue_edges_of(std::uint32_t vertex, bool larger_only);
    double cost_there(const Contraction& edge, const Point6& candidate, FeetCount& feet) const;
    double cost_back(const Contraction& edge, const Point6& candidate, FeetCount& feet) const;
    double cost_of(const Contraction& edge, const Point6& candidate);
    Place best_of(const Contraction& edge);
    void add_to_sums(const Contraction& edge, const Point6& chosen);
    void contract(const Contraction& edge, Place place);

    const TriangleMesh& original_;
    const PaperOptions& options_;
    std::vector<Point6> points_;
    std::vector<glm::vec3> colours_; ///< Without the weight; empty = no colours.
    std::vector<Triangle> faces_;
    std::vector<bool> collapsed_; ///< One flag for each face.
    /// For each vertex its faces, ascending; none for a vertex that was contracted away.
    std::vector<std::vector<std::uint32_t>> vertex_faces_;
    std::size_t face_count_; ///< The number of faces that have not collapsed.
    std::vector<PlaneQuadric> quadrics_;
    std::vector<std::uint32_t> changes_; ///< For each vertex how often it changed.
    std::priority_queue<QueuedEdge> queue_;
    FeetCount feet_;
};

PaperRun::PaperRun(const TriangleMesh& original, const PaperOptions& options)
    : original_(original), options_(options), colours_(original.colours), faces_(original.triangles),
      collapsed_(original.triangles.size()), vertex_faces_(original.vertices_m.size()),
      face_count_(original.triangles.size()), quadrics_(original.vertices_m.size()),
      changes_(original.vertices_m.size()) {
    result.counted_vertices = original.vertices_m.size() + options.uncounted;
    for (std::size_t i = 0; i < original.vertices_m.size(); ++i) {
        const glm::dvec3& at_m = original.vertices_m[i];
        const glm::dvec3 colour = colours_.empty() ? glm::dvec3(0.0) : options.colour_weight * glm::dvec3(colours_[i]);
        points_.push_back({at_m.x, at_m.y, at_m.z, colour.x, colour.y, colour.z});
    }
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
        const auto& [a, b, c] = faces_[face];
        if (a == b || b == c || c == a) {
            collapsed_[face] = true;
            --face_count_;
            continue;
        }
        const PlaneQuadric quadric = options.colour_weight > 0.0 ? PlaneQuadric::of_coloured_plane(corners(face))
                                                                 : PlaneQuadric::of_plane(corners(face));
        for (const std::uint32_t vertex : faces_[face]) {
            vertex_faces_[vertex].push_back(face);
            quadrics_[vertex].add(quadric);
        }
    }
    for (std::uint32_t vertex = 0; vertex < points_.size(); ++vertex) { queue_edges_of(vertex, true); }
}

/// Queues the edges of a vertex, or only those to vertices with larger numbers.
void PaperRun::queue_edges_of(std::uint32_t vertex, bool larger_only) {
    std::vector<std::uint32_t> others;
    for (const std::uint32_t face : vertex_faces_[vertex]) {
        std::ranges::copy_if(faces_[face], std::back_inserter(others),
            [&](std::uint32_t other) { return larger_only ? other > vertex : other != vertex; });
    }
    std::ranges::sort(others);
    others.erase(std::unique(others.begin(), others.end()), others.end());
    for (const std::uint32_t other : others) {
        Point6 way = points_[vertex] - points_[other];
        if (!options_.colour_in_edge_length) { std::fill(way.begin() + 3, way.end(), 0.0); }
        const auto [first, second] = std::minmax(vertex, other);
        queue_.push({dot(way, way), first, second, changes_[vertex] + changes_[other]});
    }
}

/// The sum of the squared distances from the new vertex to the faces of the mesh before the contraction, M_(i-1).
double PaperRun::cost_there(const Contraction& edge, const Point6& candidate, FeetCount& feet) const {
    double sum = 0.0;
    for (const std::uint32_t face : edge.faces) {
        const Foot foot = foot_on(corners(face), candidate);
        ++feet.all;
        feet.outside += foot.inside ? 0 : 1;
        sum += foot.distance2;
    }
    return sum;
}

/// The sum of the squared distances from both old vertices to the faces of the mesh after the contraction, M_i, the
/// collapsed ones included.
double PaperRun::cost_back(const Contraction& edge, const Point6& candidate, FeetCount& feet) const {
    double sum = 0.0;
    for (const std::uint32_t face : edge.faces) {
        Corners moved = corners(face);
        for (std::size_t i = 0; i < moved.size(); ++i) {
            if (faces_[face][i] == edge.first || faces_[face][i] == edge.second) { moved[i] = candidate; }
        }
        for (const std::uint32_t end : {edge.first, edge.second}) {
            const Foot foot = foot_on(moved, points_[end]);
            ++feet.all;
            feet.outside += foot.inside ? 0 : 1;
            sum += foot.distance2;
        }
    }
    return sum;
}

double PaperRun::cost_of(const Contraction& edge, const Point6& candidate) {
    if (options_.measure == PaperMeasure::Plane) {
        return quadrics_[edge.first].at(candidate) + quadrics_[edge.second].at(candidate);
    }
    const double there = cost_there(edge, candidate, feet_);
    return options_.measure == PaperMeasure::Triangle ? there : std::max(there, cost_back(edge, candidate, feet_));
}

Place PaperRun::best_of(const Contraction& edge) {
    Place best = Place::First;
    double min_cost = std::numeric_limits<double>::infinity();
    for (const Place place : {Place::First, Place::Second, Place::Middle}) {
        const double cost = cost_of(edge, placed(points_[edge.first], points_[edge.second], place));
        if (cost < min_cost) {
            best = place;
            min_cost = cost;
        }
    }
    return best;
}

void PaperRun::add_to_sums(const Contraction& edge, const Point6& chosen) {
    FeetCount uncounted;
    const double there = cost_there(edge, chosen, uncounted);
    const double back = cost_back(edge, chosen, uncounted);
    result.sums.plane_m2 += quadrics_[edge.first].at(chosen) + quadrics_[edge.second].at(chosen);
    result.sums.triangle_m2 += there;
    result.sums.bidirectional_m2 += std::max(there, back);
}

/// Moves the first vertex of an edge to its new place and puts it in the place of the second one in every face. Faces
/// that have both collapse.
void PaperRun::contract(const Contraction& edge, Place place) {
    const auto& [kept, gone, faces] = edge;
    const auto holds = [](const Triangle& face, std::uint32_t vertex) {
        return std::ranges::find(face, vertex) != face.end();
    };
    std::vector<std::uint32_t> staying;
    for (const std::uint32_t face : faces) {
        Triangle& corners = faces_[face];
        if (holds(corners, kept) && holds(corners, gone)) {
            collapsed_[face] = true;
            --face_count_;
            for (const std::uint32_t vertex : corners) { std::erase(vertex_faces_[vertex], face); }
        } else {
            std::ranges::replace(corners, gone, kept);
            staying.push_back(face);
        }
    }
    vertex_faces_[gone] = {};
    vertex_faces_[kept] = std::move(staying);
    points_[kept] = placed(points_[kept], points_[gone], place);
    if (!colours_.empty()) { colours_[kept] = placed(colours_[kept], colours_[gone], place); }
}

bool PaperRun::contract_shortest() {
    const auto is_outdated = [&](const QueuedEdge& edge) {
        return edge.changes != changes_[edge.first] + changes_[edge.second] || vertex_faces_[edge.first].empty() ||
               vertex_faces_[edge.second].empty();
    };
    while (!queue_.empty() && is_outdated(queue_.top())) { queue_.pop(); }
    if (queue_.empty()) { return false; }
    Contraction edge{queue_.top().first, queue_.top().second, {}};
    queue_.pop();
    std::ranges::set_union(vertex_faces_[edge.first], vertex_faces_[edge.second], std::back_inserter(edge.faces));
    const Place place = best_of(edge);
    add_to_sums(edge, placed(points_[edge.first], points_[edge.second], place));
    contract(edge, place);
    quadrics_[edge.first].add(quadrics_[edge.second]);
    ++changes_[edge.first];
    queue_edges_of(edge.first, false);
    ++result.contractions;
    --result.counted_vertices;
    result.feet = feet_.all;
    result.feet_outside = feet_.outside;
    return true;
}

TriangleMesh PaperRun::left_over() const {
    TriangleMesh mesh;
    mesh.name = original_.name;
    mesh.materials = original_.materials;
    std::vector<std::uint32_t> numbers(points_.size(), none);
    for (std::uint32_t vertex = 0; vertex < points_.size(); ++vertex) {
        if (vertex_faces_[vertex].empty()) { continue; }
        numbers[vertex] = static_cast<std::uint32_t>(mesh.vertices_m.size());
        mesh.vertices_m.push_back(position_m(points_[vertex]));
        if (!colours_.empty()) { mesh.colours.push_back(colours_[vertex]); }
    }
    for (std::size_t face = 0; face < faces_.size(); ++face) {
        if (collapsed_[face]) { continue; }
        const auto& [a, b, c] = faces_[face];
        mesh.triangles.push_back({numbers[a], numbers[b], numbers[c]});
        if (!original_.triangle_materials.empty()) {
            mesh.triangle_materials.push_back(original_.triangle_materials[face]);
        }
    }
    return mesh;
}

void PaperRun::show_share() const {
    constexpr std::size_t every = 1024;
    if (!options_.show_progress || result.contractions % every != 0) { return; }
    const bool by_vertices = options_.goal.vertices.has_value();
    const std::size_t left = by_vertices ? result.counted_vertices : face_count_;
    const std::size_t all = by_vertices ? result.counted_vertices + result.contractions : original_.triangles.size();
    const auto wanted = static_cast<double>(options_.goal.vertices.value_or(options_.goal.faces.value_or(0)));
    const double share = static_cast<double>(all - left) / std::max(static_cast<double>(all) - wanted, 1.0);
    options_.show_progress(std::min(share, 1.0));
}

} // namespace

PaperResult paper_simplified(const TriangleMesh& original, const PaperOptions& options) {
    assert(!options.goal.error_m && "the paper has no bound of the error");
    PaperRun run(original, options);
    while (!run.goal_met() && run.contract_shortest()) { run.show_share(); }
    run.result.mesh = run.left_over();
    return std::move(run.result);
}

} // namespace octant::models::simplify
