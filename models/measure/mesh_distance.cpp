// The distance of two meshes in both directions: the certified Hausdorff distance and sampled mean values
// (sampled_distance()). Both use one tree over the triangles of the other mesh.
//
// The one-sided Hausdorff distance with certified bounds, by branch and bound over the triangles of one mesh: M. Guthe,
// P. Borodin, R. Klein, "Fast and accurate Hausdorff distance calculation between meshes", 2005. Every sampled point
// gives a lower bound; each piece of a triangle has an upper bound; the piece with the largest is cut in two until the
// bounds are close.
//
// The upper bound of a piece: the distance to a convex set is a convex function, so that over a triangular piece it is
// at most its largest value at the corners. A single triangle T of the target is convex, and the distance to the target
// is at most that to T. Asked are the T nearest to the corners and to the centre of the piece. In addition, the
// distance changes no faster than a point moves.
//
// Deviations:
// - The bound of a piece is the one above, not one from a voxel grid.
// - Pieces are cut in two, not in four, and where they leave the part of space over one T. So a
//   piece that lies flat on many triangles ends as the overlay of both meshes and not in pieces of
//   the size of the distance. Elsewhere the cut is where the nearest triangle changes.
// - A vertex is not searched from where the triangle that was found for the vertex before is near
//   enough, and triangles that such upper bounds bound well enough are left out without a search.
// - Pieces much larger than the triangles near them are cut without a search from the centre.
// - Pieces are cut in batches, so that the result is the same on any number of threads.

#include "models/measure/mesh_distance.h"

#include "models/measure/triangle_bvh.h"
#include "sim/base/thread_pool.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace octant::models::measure {

// RMS and mean of distance and colour difference, and how much of a simplified surface is folded over, from points
// spread evenly over a surface. Sums are kept for each chunk of points and added in order, so that the number of
// threads does not change the result.
//
// Point k = 0, 1, ... lies at (k + 1/2) / samples of the accumulated area, so that each triangle gets its share
// (stratified sampling). Within the triangles the points follow the R2 sequence of M. Roberts, "The unreasonable
// effectiveness of quasirandom sequences", 2018: a Kronecker sequence in the unit square, folded at its diagonal.
//
// Distances do not reveal folds: in a thin part, such as a wing, a triangle of the upper side that faces downwards is
// near the lower side. Therefore each point searches for a nearby triangle of the original with a similar normal.

namespace {

/// A point on a mesh's surface.
struct SurfacePoint {
    std::size_t triangle = 0;
    glm::dvec3 weights{0.0}; ///< The barycentric weights of the triangle's corners.
    glm::dvec3 point_m{0.0};
};

/// The values at the corners of a triangle, mixed by barycentric weights.
template <typename Vector>
glm::dvec3 mixed(const std::vector<Vector>& values, const Triangle& triangle, const glm::dvec3& weights) {
    return weights.x * glm::dvec3(values[triangle[0]]) + weights.y * glm::dvec3(values[triangle[1]]) +
           weights.z * glm::dvec3(values[triangle[2]]);
}

/// For each triangle twice the accumulated area up to and including it; its number and one more on a mesh without area.
std::vector<double> accumulated_areas(const TriangleMesh& mesh) {
    std::vector<double> areas;
    areas.reserve(mesh.triangles.size());
    double sum = 0.0;
    for (const Triangle& triangle : mesh.triangles) {
        sum += glm::length(area_vector(mesh, triangle));
        areas.push_back(sum);
    }
    for (std::size_t i = 0; i < areas.size() && !(sum > 0.0); ++i) { areas[i] = static_cast<double>(i + 1); }
    return areas;
}

/// The barycentric weights of point k in its triangle.
glm::dvec3 weights_of(std::size_t k) {
    // The plastic number, the real root of x^3 = x + 1.
    constexpr double plastic = 1.32471795724474602596;
    const double n = static_cast<double>(k) + 1.0;
    double unused = 0.0;
    double u = std::modf(0.5 + n / plastic, &unused);
    double v = std::modf(0.5 + n / (plastic * plastic), &unused);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return {1.0 - u - v, u, v};
}

/// The sums over one chunk of samples.
struct Sums {
    double distances = 0.0;
    double squares = 0.0;
    double colour_squares = 0.0;
    std::size_t flipped = 0;
};

/// Calls `take(sums, point, nearest)` with each point of a mesh and the nearest one of the target, on several threads.
/// Returns all sums.
template <typename Take>
Sums summed(const TriangleMesh& mesh, const TargetSurface& target, const SampleOptions& options, const Take& take) {
    assert(!mesh.triangles.empty());
    constexpr std::size_t chunk_size = 4096;
    const std::vector<double> areas = accumulated_areas(mesh);
    const auto count = static_cast<double>(options.samples);
    const auto area_before = [&](std::size_t k) { return areas.back() * (static_cast<double>(k) + 0.5) / count; };
    std::vector<Sums> chunks((options.samples + chunk_size - 1) / chunk_size);
    parallel_for(chunks.size(), options.threads, [&](std::size_t chunk, std::size_t) {
        const std::size_t first = chunk * chunk_size;
        auto triangle = static_cast<std::size_t>(std::ranges::upper_bound(areas, area_before(first)) - areas.begin());
        Sums sums;
        std::uint32_t guess = NearestOnMesh::none;
        for (std::size_t k = first; k < std::min(options.samples, first + chunk_size); ++k) {
            while (triangle + 1 < areas.size() && areas[triangle] <= area_before(k)) { ++triangle; }
            const glm::dvec3 weights = weights_of(k);
            const glm::dvec3 point_m = mixed(mesh.vertices_m, mesh.triangles[triangle], weights);
            const NearestOnMesh nearest = target.nearest(point_m, guess);
            guess = nearest.triangle;
            take(sums, SurfacePoint{triangle, weights, point_m}, nearest);
        }
        chunks[chunk] = sums;
    });
    Sums total;
    for (const Sums& sums : chunks) {
        total.distances += sums.distances;
        total.squares += sums.squares;
        total.colour_squares += sums.colour_squares;
        total.flipped += sums.flipped;
    }
    return total;
}

/// Whether a point of a mesh counts as one that faces against `original`. `normal` is that of its triangle, of any
/// length, and `nearest` the nearest point of the original.
bool is_flipped(const TargetSurface& original, const glm::dvec3& point_m, const glm::dvec3& normal,
    const NearestOnMesh& nearest, double reach_m) {
    const auto faces_against = [&](std::uint32_t triangle) {
        return glm::dot(area_vector(original.mesh(), original.mesh().triangles[triangle]), normal) < 0.0;
    };
    if (!faces_against(nearest.triangle)) { return false; }
    const double within_m = std::max(reach_m, 2.0 * std::sqrt(nearest.distance2)) + original.bvh().rounding_m();
    bool against = true;
    original.bvh().for_each_near(point_m, within_m, [&](std::uint32_t triangle) {
        against =
            against && (faces_against(triangle) || original.distance2_to(triangle, point_m) > within_m * within_m);
    });
    return against;
}

} // namespace

double flipped_area_share(
    const TriangleMesh& mesh, const TriangleMesh& original, double reach_m, const SampleOptions& options) {
    assert(!original.triangles.empty() && options.samples > 0);
    const TargetSurface target(original);
    const auto take = [&](Sums& sums, const SurfacePoint& here, const NearestOnMesh& nearest) {
        const glm::dvec3 normal = area_vector(mesh, mesh.triangles[here.triangle]);
        sums.flipped += is_flipped(target, here.point_m, normal, nearest, reach_m) ? 1U : 0U;
    };
    const Sums sums = summed(mesh, target, options, take);
    return static_cast<double>(sums.flipped) / static_cast<double>(options.samples);
}

SampledDistance sampled_distance(const TriangleMesh& mesh, const TargetSurface& target, const SampleOptions& options) {
    if (options.samples == 0) { return {}; }
    const TriangleMesh& other = target.mesh();
    const bool coloured = !mesh.colours.empty() && !other.colours.empty();
    const auto take = [&](Sums& sums, const SurfacePoint& here, const NearestOnMesh& there) {
        sums.distances += std::sqrt(there.distance2);
        sums.squares += there.distance2;
        if (coloured) {
            const glm::dvec3 difference = mixed(mesh.colours, mesh.triangles[here.triangle], here.weights) -
                                          mixed(other.colours, other.triangles[there.triangle], there.weights);
            sums.colour_squares += glm::dot(difference, difference);
        }
    };
    const Sums total = summed(mesh, target, options, take);
    const auto count = static_cast<double>(options.samples);
    return {std::sqrt(total.squares / count), total.distances / count, std::sqrt(total.colour_squares / count)};
}

namespace {

/// A point of a surface and its distance from the target.
struct Sample {
    glm::dvec3 point{0.0};
    double distance_m = 0.0;
    std::uint32_t nearest = NearestOnMesh::none; ///< The triangle of the target that is nearest.
    float edge_m = 0.0F;                         ///< The longest edge of that triangle.
};

/// The three corners of a triangular piece of a surface.
using Corners = std::array<const Sample*, 3>;

/// Bounds of the largest distance from a piece's points to the target.
struct PieceBounds {
    double min_m = 0.0;
    double max_m = 0.0;
    /// The triangle nearest to the piece's centre, if that was looked for.
    std::uint32_t middle = NearestOnMesh::none;
};

/// Where a piece is cut in two: by a line from a point on one edge to the opposite corner.
struct Cut {
    std::size_t edge = 0; ///< The edge from this corner to the next one.
    double along = 0.5;   ///< Where on that edge, 0 to 1.
};

/// The largest distance from a piece's corners to one triangle of the target.
double max_to(const TargetSurface& target, std::uint32_t triangle, const Corners& corners) {
    double most2 = 0.0;
    for (const Sample* corner : corners) {
        most2 = corner->nearest == triangle ? std::max(most2, corner->distance_m * corner->distance_m)
                                            : std::max(most2, target.distance2_to(triangle, corner->point));
    }
    return std::sqrt(most2);
}

/// A bound of the largest distance from a piece to the target. The piece is seen as four parts: one at each corner, cut
/// off at a third of both sides, and the hexagon between them. Each part lies near one triangle of the target, the one
/// nearest to its corner or to the centre, and no farther from it than its own corners are.
double max_by_parts(const TargetSurface& target, std::uint32_t middle, const Corners& corners) {
    double most2 = 0.0;
    for (std::size_t from = 0; from < 3; ++from) {
        const Sample& corner = *corners[from];
        most2 = std::max(most2, corner.distance_m * corner.distance_m);
        for (const std::size_t to : {(from + 1) % 3, (from + 2) % 3}) {
            const glm::dvec3 third = glm::mix(corner.point, corners[to]->point, 1.0 / 3.0);
            most2 = std::max({most2, target.distance2_to(corner.nearest, third), target.distance2_to(middle, third)});
        }
    }
    return std::sqrt(most2);
}

double length_m(const Corners& corners, std::size_t edge) {
    return glm::distance(corners[edge]->point, corners[(edge + 1) % 3]->point);
}

/// Whether a search from the centre can hardly bound a piece: where triangles of the target are so much smaller that
/// the four parts of max_by_parts() reach far beyond them. Pieces that are cut without it are bounded by their halves.
bool is_too_large(const Corners& corners, double enough_m) {
    constexpr double beyond = 1.1; // As distances at the centre may be shorter.
    constexpr double inner = 0.4;  // So far from its middle a triangle of edges 1 may reach.
    const auto& [a, b, c] = corners;
    const double longest_m = std::max({length_m(corners, 0), length_m(corners, 1), length_m(corners, 2)});
    const double mean_m = (a->distance_m + b->distance_m + c->distance_m) / 3.0;
    const double edge_m = static_cast<double>(std::max({a->edge_m, b->edge_m, c->edge_m}));
    const double aside_m = longest_m / 3.0 - inner * edge_m;
    return aside_m > 0.0 && std::hypot(mean_m, aside_m) > beyond * enough_m;
}

bool share_vertex(const Triangle& one, const Triangle& other) {
    return std::ranges::any_of(
        one, [&](std::uint32_t vertex) { return std::ranges::find(other, vertex) != other.end(); });
}

/// The place between two samples, 0 to 1, where their nearest triangles are equally far: a root of the difference of
/// the distances, by regula falsi (Illinois algorithm).
double crossing(const TargetSurface& target, const Sample& start, const Sample& end) {
    // Of the difference of squares the signed root is taken: that is linear across an edge between two triangles of one
    // plane.
    const auto difference = [&](double along) {
        const glm::dvec3 point = glm::mix(start.point, end.point, along);
        const double squares = target.distance2_to(start.nearest, point) - target.distance2_to(end.nearest, point);
        return std::copysign(std::sqrt(std::abs(squares)), squares);
    };
    double low = 0.0;
    double high = 1.0;
    double below = difference(low);
    double above = difference(high);
    double along = 0.5;
    constexpr int steps = 8;
    for (int step = 0; step < steps && below < 0.0 && above > 0.0; ++step) {
        along = low - below * (high - low) / (above - below);
        const double here = difference(along);
        if (here == 0.0) { break; }
        if (here < 0.0) {
            low = along;
            below = here;
            above *= 0.5; // The Illinois step: halves the value that stays, so that both ends move.
        } else {
            high = along;
            above = here;
            below *= 0.5;
        }
    }
    return along;
}

/// The midpoint of the longest edge.
Cut longest_cut(const Corners& corners) {
    Cut longest;
    for (std::size_t edge = 1; edge < 3; ++edge) {
        if (length_m(corners, edge) > length_m(corners, longest.edge)) { longest.edge = edge; }
    }
    return longest;
}

/// The cut where the nearest triangle changes between neighbouring triangles of the target, on the longest edge on
/// which it does; otherwise the midpoint of the longest edge.
Cut change_cut(const TargetSurface& target, const Corners& corners) {
    const Cut longest = longest_cut(corners);
    const double longest_m = length_m(corners, longest.edge);
    Cut changing;
    double changing_m = -1.0;
    for (std::size_t edge = 0; edge < 3; ++edge) {
        const double edge_m = length_m(corners, edge);
        if (corners[edge]->nearest != corners[(edge + 1) % 3]->nearest && edge_m > changing_m) {
            changing = {edge, 0.5};
            changing_m = edge_m;
        }
    }
    if (changing_m < 0.25 * longest_m) { return longest; }
    const Sample& start = *corners[changing.edge];
    const Sample& end = *corners[(changing.edge + 1) % 3];
    const auto& triangles = target.mesh().triangles;
    if (!share_vertex(triangles[start.nearest], triangles[end.nearest])) { return longest; }
    constexpr double margin = 1.0 / 16.0;
    changing.along = std::clamp(crossing(target, start, end), margin, 1.0 - margin);
    return changing;
}

/// A cut along a plane, and how deep the piece reaches to both sides of it.
struct PlaneCut {
    Cut cut;
    double depth_m = 0.0;
};

/// The cut along a plane, given the corners' signed distances from it. Chosen is the longest edge whose ends both lie
/// more than `min_depth_m` off the plane, on opposite sides: for thin pieces another edge would leave a part as long as
/// the piece.
PlaneCut plane_cut(const Corners& corners, const std::array<double, 3>& inside_m, double min_depth_m) {
    PlaneCut found;
    double longest_m = 0.0;
    for (std::size_t edge = 0; edge < 3; ++edge) {
        const double from_m = inside_m[edge];
        const double to_m = inside_m[(edge + 1) % 3];
        const double depth_m = std::min(std::abs(from_m), std::abs(to_m));
        if ((from_m < 0.0) == (to_m < 0.0) || !(depth_m > min_depth_m)) { continue; }
        found.depth_m = std::max(found.depth_m, depth_m);
        const double edge_m = length_m(corners, edge);
        if (edge_m > longest_m) {
            longest_m = edge_m;
            found.cut = {edge, from_m / (from_m - to_m)};
        }
    }
    return found;
}

/// Replaces `best` if the piece reaches deeper across one of the three planes through the edges of a triangle that are
/// perpendicular to it.
void take_edge_cut(
    const TargetSurface& target, std::uint32_t triangle, const Corners& corners, double min_depth_m, PlaneCut& best) {
    const auto& at = target.mesh().vertices_m;
    const Triangle& t = target.mesh().triangles[triangle];
    const glm::dvec3 normal = glm::cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);
    for (std::size_t side = 0; side < 3; ++side) {
        const glm::dvec3& start = at[t[side]];
        const glm::dvec3 inwards = glm::cross(normal, at[t[(side + 1) % 3]] - start);
        const double length = glm::length(inwards);
        if (!(length > 0.0)) { continue; }
        std::array<double, 3> inside_m{};
        for (std::size_t i = 0; i < 3; ++i) { inside_m[i] = glm::dot(corners[i]->point - start, inwards) / length; }
        const PlaneCut found = plane_cut(corners, inside_m, min_depth_m);
        best = found.depth_m > best.depth_m ? found : best;
    }
}

/// The deepest such cut over the triangles nearest to the corners and the centre. Triangles that are small compared
/// with the piece do not count.
PlaneCut edge_cut(const TargetSurface& target, const Corners& corners, std::uint32_t middle, double min_depth_m) {
    constexpr double min_size = 0.25;
    const double longest_m = std::max({length_m(corners, 0), length_m(corners, 1), length_m(corners, 2)});
    const std::array<std::uint32_t, 4> nearest = {
        corners[0]->nearest, corners[1]->nearest, corners[2]->nearest, middle};
    const auto edge_m = [&](std::size_t i) {
        return i < 3 ? static_cast<double>(corners[i]->edge_m) : target.longest_edge_m(middle);
    };
    PlaneCut best;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        const bool again = std::find(nearest.begin(), nearest.begin() + i, nearest[i]) != nearest.begin() + i;
        if (nearest[i] != NearestOnMesh::none && !again && edge_m(i) >= min_size * longest_m) {
            take_edge_cut(target, nearest[i], corners, min_depth_m, best);
        }
    }
    return best;
}

/// Measures a point. `guess` is a triangle of the target that may be near, or none; it changes the time only.
Sample measured(const TargetSurface& target, const glm::dvec3& point, std::uint32_t guess) {
    const NearestOnMesh found = target.nearest(point, guess);
    return {
        point, std::sqrt(found.distance2), found.triangle, static_cast<float>(target.longest_edge_m(found.triangle))};
}

/// The same, but no search is made where the triangle `guess` is at most `enough_m` away: then that is taken for the
/// nearest one, and the distance is an upper bound.
Sample estimated(const TargetSurface& target, const glm::dvec3& point, std::uint32_t guess, double enough_m) {
    if (guess != NearestOnMesh::none) {
        const double distance2 = target.distance2_to(guess, point);
        if (distance2 <= enough_m * enough_m) { return {point, std::sqrt(distance2), guess, 0.0F}; }
    }
    return measured(target, point, guess);
}

/// An upper bound of the largest distance from a piece's points to the target, without a search. The distances of the
/// corners may be upper bounds. It is not tightened any further once it is at most `enough_m`.
double bound_by_corners(const TargetSurface& target, const Corners& corners, double enough_m) {
    const std::array<double, 3> edges_m = {length_m(corners, 0), length_m(corners, 1), length_m(corners, 2)};
    double farthest_m = 0.0;
    for (const Sample* corner : corners) { farthest_m = std::max(farthest_m, corner->distance_m); }
    // No point of a triangle is farther from its nearest corner than longest edge / sqrt(3).
    double max_m = farthest_m + *std::ranges::max_element(edges_m) / std::numbers::sqrt3;
    for (std::size_t i = 0; i < 3 && max_m > enough_m; ++i) {
        // The other corners are at least this far from the triangle, by the triangle inequality.
        const double away_m = std::max(edges_m[i], edges_m[(i + 2) % 3]) - corners[i]->distance_m -
                              static_cast<double>(corners[i]->edge_m);
        if (corners[i]->edge_m == 0.0F || away_m <= enough_m) {
            max_m = std::min(max_m, max_to(target, corners[i]->nearest, corners));
        }
    }
    return max_m;
}

/// Bounds a piece as tightly as is cheap. The distances of the corners must be exact. The bounds are not tightened any
/// further once the upper one is at most `enough_m`.
PieceBounds bounds_of(const TargetSurface& target, const Corners& corners, double enough_m) {
    const auto& [a, b, c] = corners;
    PieceBounds bounds;
    bounds.min_m = std::max({a->distance_m, b->distance_m, c->distance_m});
    bounds.max_m = bound_by_corners(target, corners, enough_m);
    if (bounds.max_m <= enough_m || is_too_large(corners, enough_m)) { return bounds; }
    const glm::dvec3 centre = (a->point + b->point + c->point) / 3.0;
    const Sample middle = measured(target, centre, a->nearest);
    double radius_m = 0.0;
    for (const Sample* corner : corners) { radius_m = std::max(radius_m, glm::distance(corner->point, centre)); }
    bounds.middle = middle.nearest;
    bounds.min_m = std::max(bounds.min_m, middle.distance_m);
    bounds.max_m = std::min({bounds.max_m, middle.distance_m + radius_m, max_to(target, middle.nearest, corners)});
    if (bounds.max_m > enough_m) {
        bounds.max_m = std::min(bounds.max_m, max_by_parts(target, middle.nearest, corners));
    }
    return bounds;
}

/// Chooses the cut of a piece. The first choice is where it leaves the part of space over one of the triangles nearest
/// to its corners or its centre (`middle`), because the distance to a single triangle then bounds a part well; leaving
/// it by a small part of `enough_m` does not count. The second is where the nearest triangle changes from one corner to
/// the next, and the last the midpoint of the longest edge.
Cut cut_of(const TargetSurface& target, const Corners& corners, std::uint32_t middle, double enough_m) {
    // A point this far beside a triangle is nearer to it than the plane suggests by 5e-5 of enough_m.
    constexpr double ignored = 0.01;
    // Near pieces that are not much larger than `enough_m` are bounded after a few halvings.
    constexpr double near_share = 0.5;
    constexpr double max_size = 8.0;
    const Cut longest = longest_cut(corners);
    if (length_m(corners, longest.edge) <= max_size * enough_m &&
        std::ranges::all_of(
            corners, [&](const Sample* corner) { return corner->distance_m <= near_share * enough_m; })) {
        return longest;
    }
    const PlaneCut over_edge = edge_cut(target, corners, middle, ignored * enough_m);
    return over_edge.depth_m > 0.0 ? over_edge.cut : change_cut(target, corners);
}

/// A triangular piece of the surface, its corners given as indices of samples.
struct Piece {
    std::array<std::uint32_t, 3> corners{};
    double max_m = 0.0; ///< No point of the piece is farther from the target than this.
    /// The target's triangle nearest to the centre of the piece, where known.
    std::uint32_t middle = NearestOnMesh::none;
};

/// The order of the heap of open pieces: the one with the largest bound is on top.
bool nearer(const Piece& one, const Piece& other) { return one.max_m < other.max_m; }

/// One branch-and-bound search.
class Search {
public:
    Search(const TriangleMesh& mesh, const TargetSurface& target, const DistanceOptions& options)
        : mesh_(mesh), target_(target), options_(options) {}

    HausdorffBounds run();

private:
    /// The two parts of a piece that was cut, and the sample where it was cut.
    struct Halves {
        Sample between;
        std::array<Piece, 2> pieces; ///< A corner numbered `fresh` is the sample `between`.
        double min_m = 0.0;
    };

    static constexpr std::uint32_t fresh = NearestOnMesh::none;
    static constexpr std::size_t chunk = 64;
    static constexpr std::size_t batch = 1024;
    static constexpr std::size_t max_cuts = std::size_t{1} << 22U;

    /// Pieces whose bound is below this need not be cut any further.
    double enough_m() const { return std::max(options_.negligible_m, options_.tightness * min_m_); }

    /// The samples at the corners of a piece; `between` stands for a fresh corner.
    Corners corners_of(const Piece& piece, const Sample* between = nullptr) const;
    /// Measures the distances of all vertices that triangles use: exactly where they may raise the lower bound, else an
    /// upper bound.
    void measure_vertices();
    void take_min();
    std::vector<std::uint32_t> triangles_in_question();
    /// Bounds all triangles and keeps those that may hold the largest distance.
    void take_triangles();
    /// Cuts a piece in two and bounds both parts. Changes nothing, so that threads may share the work.
    Halves cut(const Piece& piece, double enough_m) const;
    /// Cuts the open pieces with the largest bounds, a whole batch against the same lower bound.
    void cut_batch();
    /// Puts a piece onto the heap unless its bound is low enough.
    void keep(const Piece& piece);

    /// Calls `work(first, last)` for chunks of 0 to `count`, on several threads.
    template <typename Work>
    void in_chunks(std::size_t count, const Work& work) const {
        parallel_for((count + chunk - 1) / chunk, options_.threads,
            [&](std::size_t i, std::size_t) { work(i * chunk, std::min(count, (i + 1) * chunk)); });
    }

    const TriangleMesh& mesh_;
    const TargetSurface& target_;
    const DistanceOptions& options_;
    std::vector<Sample> samples_; ///< The mesh's vertices first, then one for each cut.
    std::vector<char> is_exact_;  ///< For each vertex whether its distance is no upper bound only.
    std::vector<Piece> open_;     ///< A heap; the piece with the largest bound is on top.
    double min_m_ = 0.0;
    double left_out_m_ = 0.0; ///< The largest bound of the pieces that were left out.
    std::size_t cuts_ = 0;
};

Corners Search::corners_of(const Piece& piece, const Sample* between) const {
    Corners corners{};
    for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = piece.corners[i] == fresh ? between : &samples_[piece.corners[i]];
    }
    return corners;
}

void Search::measure_vertices() {
    std::vector<char> used(mesh_.vertices_m.size(), 0);
    for (const Triangle& triangle : mesh_.triangles) {
        for (const std::uint32_t vertex : triangle) { used[vertex] = 1; }
    }
    samples_.resize(used.size());
    is_exact_.resize(used.size(), 0);
    in_chunks(used.size(), [&](std::size_t first, std::size_t) {
        is_exact_[first] = 1;
        if (used[first] != 0) { samples_[first] = measured(target_, mesh_.vertices_m[first], NearestOnMesh::none); }
    });
    take_min();
    const double enough = std::max(options_.negligible_m, min_m_);
    in_chunks(used.size(), [&](std::size_t first, std::size_t last) {
        std::uint32_t guess = samples_[first].nearest;
        for (std::size_t i = first + 1; i < last; ++i) {
            if (used[i] != 0) {
                samples_[i] = estimated(target_, mesh_.vertices_m[i], guess, enough);
                is_exact_[i] = samples_[i].edge_m > 0.0F ? 1 : 0;
                guess = samples_[i].nearest;
            }
        }
    });
    take_min();
}

/// Raises the lower bound to the largest distance that was measured exactly.
void Search::take_min() {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        if (is_exact_[i] != 0) { min_m_ = std::max(min_m_, samples_[i].distance_m); }
    }
}

/// The triangles that their corners alone do not bound well enough, in order. Their corners are measured exactly then.
std::vector<std::uint32_t> Search::triangles_in_question() {
    const double enough = std::max(options_.negligible_m, min_m_);
    std::vector<double> max_m(mesh_.triangles.size());
    in_chunks(max_m.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            max_m[i] = bound_by_corners(target_, corners_of({.corners = mesh_.triangles[i]}), enough);
        }
    });
    std::vector<std::uint32_t> open;
    std::vector<std::uint32_t> inexact;
    for (std::uint32_t i = 0; i < max_m.size(); ++i) {
        if (max_m[i] <= enough) {
            left_out_m_ = std::max(left_out_m_, max_m[i]);
            continue;
        }
        open.push_back(i);
        for (const std::uint32_t vertex : mesh_.triangles[i]) {
            if (is_exact_[vertex] == 0) {
                is_exact_[vertex] = 1;
                inexact.push_back(vertex);
            }
        }
    }
    in_chunks(inexact.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            Sample& sample = samples_[inexact[i]];
            sample = measured(target_, sample.point, sample.nearest);
        }
    });
    take_min();
    return open;
}

void Search::keep(const Piece& piece) {
    if (piece.max_m <= enough_m()) {
        left_out_m_ = std::max(left_out_m_, piece.max_m);
    } else {
        open_.push_back(piece);
        std::ranges::push_heap(open_, nearer);
    }
}

void Search::take_triangles() {
    const std::vector<std::uint32_t> open = triangles_in_question();
    std::vector<PieceBounds> bounds(open.size());
    in_chunks(bounds.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            bounds[i] = bounds_of(target_, corners_of({.corners = mesh_.triangles[open[i]]}), enough_m());
        }
    });
    for (const PieceBounds& one : bounds) { min_m_ = std::max(min_m_, one.min_m); }
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        keep({mesh_.triangles[open[i]], bounds[i].max_m, bounds[i].middle});
    }
}

Search::Halves Search::cut(const Piece& piece, double enough_m) const {
    const Corners corners = corners_of(piece);
    const Cut where = cut_of(target_, corners, piece.middle, enough_m);
    const std::size_t next = (where.edge + 1) % 3;
    Halves halves;
    halves.between = measured(target_, glm::mix(corners[where.edge]->point, corners[next]->point, where.along),
        corners[where.along < 0.5 ? where.edge : next]->nearest);
    halves.pieces = {piece, piece};
    halves.pieces[0].corners[next] = fresh;
    halves.pieces[1].corners[where.edge] = fresh;
    for (Piece& half : halves.pieces) {
        const PieceBounds bounds = bounds_of(target_, corners_of(half, &halves.between), enough_m);
        half.max_m = std::min(piece.max_m, bounds.max_m);
        half.middle = bounds.middle;
        halves.min_m = std::max(halves.min_m, bounds.min_m);
    }
    return halves;
}

void Search::cut_batch() {
    std::vector<Piece> pieces;
    while (!open_.empty() && pieces.size() < batch && open_.front().max_m > enough_m()) {
        std::ranges::pop_heap(open_, nearer);
        pieces.push_back(open_.back());
        open_.pop_back();
    }
    const double enough = enough_m();
    std::vector<Halves> halves(pieces.size());
    in_chunks(pieces.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) { halves[i] = cut(pieces[i], enough); }
    });
    cuts_ += pieces.size();
    for (const Halves& pair : halves) { min_m_ = std::max(min_m_, pair.min_m); }
    for (Halves& pair : halves) {
        const auto between = static_cast<std::uint32_t>(samples_.size());
        samples_.push_back(pair.between);
        for (Piece& piece : pair.pieces) {
            std::ranges::replace(piece.corners, fresh, between);
            keep(piece);
        }
    }
}

HausdorffBounds Search::run() {
    measure_vertices();
    take_triangles();
    while (!open_.empty() && open_.front().max_m > enough_m() && cuts_ < max_cuts) { cut_batch(); }
    const double open_m = open_.empty() ? 0.0 : open_.front().max_m;
    return {min_m_, std::max({min_m_, left_out_m_, open_m}), cuts_};
}

} // namespace

HausdorffBounds one_way_hausdorff(
    const TriangleMesh& mesh, const TargetSurface& target, const DistanceOptions& options) {
    assert(!mesh.triangles.empty() && !target.mesh().triangles.empty());
    const BoundingBox extent = models::bounds_of(mesh);
    const glm::dvec3 farthest = glm::max(glm::abs(extent.min_m), glm::abs(extent.max_m));
    const double rounding_m = target.bvh().rounding_m() + 256.0 * std::numeric_limits<double>::epsilon() *
                                                              std::max({farthest.x, farthest.y, farthest.z});
    DistanceOptions wanted = options;
    wanted.negligible_m = std::max(options.negligible_m, 4.0 * rounding_m);
    HausdorffBounds bounds = Search(mesh, target, wanted).run();
    bounds.min_hausdorff_m = std::max(0.0, bounds.min_hausdorff_m - rounding_m);
    bounds.max_hausdorff_m += rounding_m;
    return bounds;
}

namespace {

/// Tells how many of the four steps are done.
void show(const DistanceOptions& options, int done) {
    if (options.progress) { options.progress(done, 4); }
}

/// The two steps after those that are `done`.
OneWayDistance one_way(
    const TriangleMesh& mesh, const TargetSurface& target, const DistanceOptions& options, int done) {
    const HausdorffBounds bounds = one_way_hausdorff(mesh, target, options);
    show(options, done + 1);
    const SampledDistance sampled =
        sampled_distance(mesh, target, {.samples = options.samples, .threads = options.threads});
    show(options, done + 2);
    return {bounds, sampled};
}

} // namespace

MeshDistance distance(const TriangleMesh& a, const TriangleMesh& b, const DistanceOptions& options) {
    assert(!a.triangles.empty() && !b.triangles.empty() && options.tightness > 1.0);
    DistanceOptions wanted = options;
    if (!(options.negligible_m > 0.0)) { wanted.negligible_m = 1e-9 * std::max(diagonal_m(a), diagonal_m(b)); }
    show(options, 0);
    MeshDistance found;
    found.there = one_way(a, TargetSurface(b), wanted, 0);
    if (options.maximum_only) { wanted.negligible_m = std::max(wanted.negligible_m, found.there.min_hausdorff_m); }
    found.back = one_way(b, TargetSurface(a, options.tree_of_a), wanted, 2);
    return found;
}

} // namespace octant::models::measure
