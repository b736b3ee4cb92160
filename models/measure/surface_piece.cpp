// The bound of a piece and the choice of its cut, for the branch and bound of hausdorff.cpp, where
// both are explained (after M. Guthe, P. Borodin, R. Klein, 2005, with the deviations stated
// there).
#include "models/measure/surface_piece.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace octant::models::measure {

namespace {

/// The largest distance from a piece's corners to one triangle of the target.
double most_to(const TargetSurface& target, std::uint32_t triangle, const Corners& corners) {
    double most2 = 0.0;
    for (const Sample* corner : corners) {
        most2 = corner->nearest == triangle
                    ? std::max(most2, corner->distance_m * corner->distance_m)
                    : std::max(most2, target.distance2_to(triangle, corner->point));
    }
    return std::sqrt(most2);
}

/// A bound of the largest distance from a piece to the target. The piece is seen as four parts: one
/// at each corner, cut off at a third of both sides, and the hexagon between them. Each part lies
/// near one triangle of the target, the one nearest to its corner or to the centre, and no farther
/// from it than its own corners are.
double most_by_parts(const TargetSurface& target, std::uint32_t middle, const Corners& corners) {
    double most2 = 0.0;
    for (std::size_t from = 0; from < 3; ++from) {
        const Sample& corner = *corners[from];
        most2 = std::max(most2, corner.distance_m * corner.distance_m);
        for (const std::size_t to : {(from + 1) % 3, (from + 2) % 3}) {
            const glm::dvec3 third = glm::mix(corner.point, corners[to]->point, 1.0 / 3.0);
            most2 = std::max(
                {most2,
                 target.distance2_to(corner.nearest, third),
                 target.distance2_to(middle, third)});
        }
    }
    return std::sqrt(most2);
}

double length_m(const Corners& corners, std::size_t edge) {
    return glm::distance(corners[edge]->point, corners[(edge + 1) % 3]->point);
}

bool share_vertex(const Triangle& one, const Triangle& other) {
    return std::ranges::any_of(
        one, [&](std::uint32_t vertex) { return std::ranges::find(other, vertex) != other.end(); });
}

/// The place between two samples, 0 to 1, where their nearest triangles are equally far: a root of
/// the difference of the distances, by regula falsi (Illinois algorithm).
double crossing(const TargetSurface& target, const Sample& start, const Sample& end) {
    // Of the difference of squares the signed root is taken: that is linear across an edge between
    // two triangles of one plane.
    const auto difference = [&](double along) {
        const glm::dvec3 point = glm::mix(start.point, end.point, along);
        const double squares =
            target.distance2_to(start.nearest, point) - target.distance2_to(end.nearest, point);
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
        if (here == 0.0) {
            break;
        }
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

/// The cut where the nearest triangle changes between neighbouring triangles of the target, on the
/// longest edge on which it does; otherwise the midpoint of the longest edge.
Cut change_cut(const TargetSurface& target, const Corners& corners) {
    Cut longest;
    Cut changing;
    double longest_m = -1.0;
    double changing_m = -1.0;
    for (std::size_t edge = 0; edge < 3; ++edge) {
        const double edge_m = length_m(corners, edge);
        if (edge_m > longest_m) {
            longest = {edge, 0.5};
            longest_m = edge_m;
        }
        if (corners[edge]->nearest != corners[(edge + 1) % 3]->nearest && edge_m > changing_m) {
            changing = {edge, 0.5};
            changing_m = edge_m;
        }
    }
    if (changing_m < 0.25 * longest_m) {
        return longest;
    }
    const Sample& start = *corners[changing.edge];
    const Sample& end = *corners[(changing.edge + 1) % 3];
    const auto& triangles = target.mesh().triangles;
    if (!share_vertex(triangles[start.nearest], triangles[end.nearest])) {
        return longest;
    }
    constexpr double margin = 1.0 / 16.0;
    changing.along = std::clamp(crossing(target, start, end), margin, 1.0 - margin);
    return changing;
}

/// A cut along a plane, and how deep the piece reaches to both sides of it.
struct PlaneCut {
    Cut cut;
    double depth_m = 0.0;
};

/// The cut along a plane, given the corners' signed distances from it. Chosen is the longest edge
/// whose ends both lie more than `least_depth_m` off the plane, on opposite sides: for thin pieces
/// another edge would leave a part as long as the piece.
PlaneCut
plane_cut(const Corners& corners, const std::array<double, 3>& inside_m, double least_depth_m) {
    PlaneCut found;
    double longest_m = 0.0;
    for (std::size_t edge = 0; edge < 3; ++edge) {
        const double from_m = inside_m[edge];
        const double to_m = inside_m[(edge + 1) % 3];
        const double depth_m = std::min(std::abs(from_m), std::abs(to_m));
        if ((from_m < 0.0) == (to_m < 0.0) || !(depth_m > least_depth_m)) {
            continue;
        }
        found.depth_m = std::max(found.depth_m, depth_m);
        const double edge_m = length_m(corners, edge);
        if (edge_m > longest_m) {
            longest_m = edge_m;
            found.cut = {edge, from_m / (from_m - to_m)};
        }
    }
    return found;
}

/// Replaces `best` if the piece reaches deeper across one of the three planes through the edges of
/// a triangle that are perpendicular to it.
void take_edge_cut(
    const TargetSurface& target,
    std::uint32_t triangle,
    const Corners& corners,
    double least_depth_m,
    PlaneCut& best) {
    const auto& at = target.mesh().vertices_m;
    const Triangle& t = target.mesh().triangles[triangle];
    const glm::dvec3 normal = glm::cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);
    for (std::size_t side = 0; side < 3; ++side) {
        const glm::dvec3& start = at[t[side]];
        const glm::dvec3 inwards = glm::cross(normal, at[t[(side + 1) % 3]] - start);
        const double length = glm::length(inwards);
        if (!(length > 0.0)) {
            continue;
        }
        std::array<double, 3> inside_m{};
        for (std::size_t i = 0; i < 3; ++i) {
            inside_m[i] = glm::dot(corners[i]->point - start, inwards) / length;
        }
        const PlaneCut found = plane_cut(corners, inside_m, least_depth_m);
        best = found.depth_m > best.depth_m ? found : best;
    }
}

/// The deepest such cut over the triangles nearest to the corners and the centre. Triangles that
/// are small beside the piece do not count.
PlaneCut edge_cut(
    const TargetSurface& target,
    const Corners& corners,
    std::uint32_t middle,
    double least_depth_m) {
    constexpr double least_size = 0.25;
    const double longest_m =
        std::max({length_m(corners, 0), length_m(corners, 1), length_m(corners, 2)});
    const std::array<std::uint32_t, 4> nearest = {
        corners[0]->nearest, corners[1]->nearest, corners[2]->nearest, middle};
    PlaneCut best;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        const bool again =
            std::find(nearest.begin(), nearest.begin() + i, nearest[i]) != nearest.begin() + i;
        if (nearest[i] != NearestOnMesh::none && !again &&
            target.longest_edge_m(nearest[i]) >= least_size * longest_m) {
            take_edge_cut(target, nearest[i], corners, least_depth_m, best);
        }
    }
    return best;
}

} // namespace

Sample measured(const TargetSurface& target, const glm::dvec3& point, std::uint32_t guess) {
    const NearestOnMesh found = target.nearest(point, guess);
    return {point, std::sqrt(found.distance2), found.triangle};
}

PieceBounds bounds_of(const TargetSurface& target, const Corners& corners, double enough_m) {
    const auto& [a, b, c] = corners;
    const double longest_m =
        std::max({length_m(corners, 0), length_m(corners, 1), length_m(corners, 2)});
    PieceBounds bounds;
    bounds.least_m = std::max({a->distance_m, b->distance_m, c->distance_m});
    // No point of a triangle is farther from its nearest corner than longest edge / sqrt(3).
    bounds.most_m = bounds.least_m + longest_m / std::numbers::sqrt3;
    for (std::size_t i = 0; i < 3 && bounds.most_m > enough_m; ++i) {
        bounds.most_m = std::min(bounds.most_m, most_to(target, corners[i]->nearest, corners));
    }
    if (bounds.most_m <= enough_m) {
        return bounds;
    }
    const glm::dvec3 centre = (a->point + b->point + c->point) / 3.0;
    const Sample middle = measured(target, centre, a->nearest);
    double radius_m = 0.0;
    for (const Sample* corner : corners) {
        radius_m = std::max(radius_m, glm::distance(corner->point, centre));
    }
    bounds.middle = middle.nearest;
    bounds.least_m = std::max(bounds.least_m, middle.distance_m);
    bounds.most_m = std::min(
        {bounds.most_m, middle.distance_m + radius_m, most_to(target, middle.nearest, corners)});
    if (bounds.most_m > enough_m) {
        bounds.most_m = std::min(bounds.most_m, most_by_parts(target, middle.nearest, corners));
    }
    return bounds;
}

Cut cut_of(
    const TargetSurface& target, const Corners& corners, std::uint32_t middle, double enough_m) {
    // A point this far beside a triangle is nearer to it than the plane suggests by 5e-5 of
    // enough_m.
    constexpr double ignored = 0.01;
    const PlaneCut over_edge = edge_cut(target, corners, middle, ignored * enough_m);
    return over_edge.depth_m > 0.0 ? over_edge.cut : change_cut(target, corners);
}

} // namespace octant::models::measure
