// Proves painting orders. The code that finds orders looks for occlusions; this code looks for planes that exclude
// them. It shares no code with the search, so that a mistake there cannot repeat itself here.
#include "visuals/orderfile/order_check.h"

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"
#include "sim/base/units.h"
#include "visuals/separation/linear_program.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::orderfile {

namespace {

using separation::LinearProgram;
using separation::optimum;
using Planes = std::vector<Plane>;

/// Errors smaller than this pass. The unit is the diagonal of the model's bounding box (CheckFrame).
constexpr double check_tolerance = 1e-6;

// The proof for one pair of polygons. Let A and B be convex planar polygons and R' the eyes that see both from the
// front. B can hide part of A if and only if no plane weakly separates B from the convex hull of A and R'.
//
// By Farkas' lemma a plane has R' = {e : Ni.e + Di >= 0} in front of it when it is a sum of the planes (Ni, Di), and of
// (0, 1), with factors >= 0. These factors are the unknowns of a small linear programme. The resulting plane is
// measured against the corners again, so that nothing rests on the solver's word.

/// How it was proved that one polygon hides nothing of another, the strongest proof first.
enum class SeparationMethod {
    Plane,         ///< A plane of the region itself separates them.
    LinearProgram, ///< A plane that a linear programme found separates them.
    None           ///< There is no proof.
};

/// A sum of unit normals below this is no direction: the region has no interior.
constexpr double min_normal = 1e-9;

constexpr double redundancy_tolerance = 1e-9;

/// Whether a plane has one set of points behind it and the other in front of it, within a tolerance.
bool parts(
    const Plane& plane, double tolerance, std::span<const glm::dvec3> behind, std::span<const glm::dvec3> before) {
    return std::ranges::all_of(behind, [&](const glm::dvec3& p) { return distance_m(plane, p) <= tolerance; }) &&
           std::ranges::all_of(before, [&](const glm::dvec3& p) { return distance_m(plane, p) >= -tolerance; });
}

/// The programme of a separating plane. Its unknowns are a factor for each plane, one for (0, 1), and the margin, which
/// is maximised; the factors add up to 1.
LinearProgram separation_programme(
    std::span<const glm::dvec3> occluder, std::span<const glm::dvec3> occluded, std::span<const Plane> planes) {
    LinearProgram program;
    program.variables.assign(planes.size() + 1, {});
    program.variables.push_back({.weight = 1.0, .least = -1e3, .most = 1e3});
    const auto add_corner = [&](const glm::dvec3& corner, double sign) {
        LinearProgram::Row row;
        for (const Plane& plane : planes) { row.factors.push_back(sign * distance_m(plane, corner)); }
        row.factors.push_back(sign);
        row.factors.push_back(-1.0);
        row.least = 0.0;
        program.rows.push_back(std::move(row));
    };
    for (const glm::dvec3& corner : occluder) { add_corner(corner, -1.0); }
    for (const glm::dvec3& corner : occluded) { add_corner(corner, 1.0); }
    LinearProgram::Row sum;
    sum.factors.assign(planes.size() + 1, 1.0);
    sum.factors.push_back(0.0);
    sum.least = sum.most = 1.0;
    program.rows.push_back(std::move(sum));
    return program;
}

/// The sum of the planes with these factors; negative ones, which are rounding, count as 0.
Plane sum_of(std::span<const Plane> planes, const std::vector<double>& factors) {
    Plane sum{glm::dvec3(0.0), std::max(factors[planes.size()], 0.0)};
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const double factor = std::max(factors[i], 0.0);
        sum.normal += planes[i].normal * factor;
        sum.offset_m += planes[i].offset_m * factor;
    }
    return sum;
}

/// Proves that no eye of a region sees `occluder` in front of `occluded`, by a plane with occluder behind it and
/// occluded and the region in front, all weakly. The region is the intersection of the half-spaces in front of `planes`
/// (unit normals); a region without interior is separated from everything.
SeparationMethod find_separation(
    std::span<const glm::dvec3> occluder, std::span<const glm::dvec3> occluded, std::span<const Plane> planes) {
    for (const Plane& plane : planes) {
        if (parts(plane, check_tolerance, occluder, occluded)) { return SeparationMethod::Plane; }
    }
    const auto factors = optimum(separation_programme(occluder, occluded, planes));
    if (!factors) { return SeparationMethod::None; }
    const Plane sum = sum_of(planes, *factors);
    const double length = glm::length(sum.normal);
    const bool no_inside = length < min_normal && sum.offset_m < min_normal;
    const bool good = no_inside || parts(sum, check_tolerance * length, occluder, occluded);
    return good ? SeparationMethod::LinearProgram : SeparationMethod::None;
}

/// Whether no point of the intersection of the half-spaces in front of `planes` is in front of `plane` by more than the
/// tolerance times (1 + its distance from the origin).
///
/// The unknowns are a factor for each plane and the error, which is minimised. The sum of the planes with their factors
/// and of `plane` itself must be (0, 0, 0, 0 or less) within the error.
bool is_behind(std::span<const Plane> planes, const Plane& plane, double tolerance) {
    LinearProgram program;
    program.variables.assign(planes.size(), {});
    program.variables.push_back({.weight = -1.0});
    for (int i = 0; i < 4; ++i) {
        const auto part = [&](const Plane& of) { return i < 3 ? of.normal[i] : of.offset_m; };
        for (const double sign : {1.0, -1.0}) {
            if (i == 3 && sign < 0.0) { continue; }
            LinearProgram::Row row;
            for (const Plane& other : planes) { row.factors.push_back(sign * part(other)); }
            row.factors.push_back(-1.0);
            row.most = -sign * part(plane);
            program.rows.push_back(std::move(row));
        }
    }
    const auto factors = optimum(program);
    if (!factors) { return false; }
    Plane sum = plane;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const double factor = std::max((*factors)[i], 0.0);
        sum.normal += planes[i].normal * factor;
        sum.offset_m += planes[i].offset_m * factor;
    }
    const glm::dvec3 size = glm::abs(sum.normal);
    return std::max({size.x, size.y, size.z, sum.offset_m}) <= tolerance;
}

// The polygons of a check. Rotor blades and other turning parts are replaced by the solids that they sweep, so that one
// proof holds for every angle. This code shares nothing with swept_face() of visuals/draworder, which does the same for
// finding orders.

/// The coordinates of a check: the centre of the model's bounding box is the origin, and its diagonal is 1. Axes as the
/// body's.
struct CheckFrame {
    glm::dvec3 middle_m{0.0};
    double diagonal_m = 1.0;

    glm::dvec3 from_body(const glm::dvec3& point_m) const { return (point_m - middle_m) / diagonal_m; }

    Plane from_body(const Plane& plane) const { return {plane.normal, distance_m(plane, middle_m) / diagonal_m}; }
};

/// A polygon as a check sees it, in a CheckFrame. Its corners are drawn towards its centre by check_tolerance, so that
/// polygons which only touch do not overlap.
struct CheckShape {
    std::vector<glm::dvec3> corners; ///< At the angle of the file.
    /// One plane, or two for a two-sided polygon; eyes that see the polygon are in front of one of them.
    std::vector<Plane> fronts;
    std::optional<std::uint32_t> pivot; ///< The pivot that turns the polygon.

    /// Points whose convex hull holds the polygon at every angle of the pivot; the corners when there is none.
    std::vector<glm::dvec3> swept;
    /// Eyes that see the polygon at some angle are in front of one of these. There are as many as `fronts` when they
    /// are the same at every angle.
    std::vector<Plane> swept_fronts;
};

/// The number of sides of the regular polygon around a circle on which a corner travels; its corners are 0.9 % outside
/// the circle.
constexpr int circle_sides = 24;
/// The sine of the angle below which a normal counts as parallel to an axis. A plane with such a normal stays where it
/// is when it turns about the axis.
constexpr double along_axis = 1e-9;

/// Moves corners towards their mean by check_tolerance.
std::vector<glm::dvec3> drawn_together(std::vector<glm::dvec3> corners) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : corners) { middle += corner / static_cast<double>(corners.size()); }
    for (glm::dvec3& corner : corners) {
        const double away = glm::distance(corner, middle);
        corner += (middle - corner) * std::min(0.5, check_tolerance / away);
    }
    return corners;
}

/// An axis of rotation with two unit vectors perpendicular to it.
struct Axis {
    glm::dvec3 point{0.0};
    glm::dvec3 along{0.0};
    glm::dvec3 right{0.0};
    glm::dvec3 up{0.0};

    /// The unit vector perpendicular to the axis at one of circle_sides angles.
    glm::dvec3 across(int side) const {
        const double angle_rad = 2.0 * pi * side / circle_sides;
        return right * std::cos(angle_rad) + up * std::sin(angle_rad);
    }
};

Axis axis_of(const models::polygons::Pivot& pivot, const CheckFrame& frame) {
    const glm::dvec3 aside = std::abs(pivot.axis.x) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, pivot.axis));
    return {frame.from_body(pivot.point_m), pivot.axis, right, glm::cross(pivot.axis, right)};
}

/// The radius of a regular polygon's corners around a unit circle.
const double outside_circle = 1.0 / std::cos(pi / circle_sides);

/// Points whose hull holds what the corners sweep: regular polygons around their circles, of circles at the same height
/// only the widest.
std::vector<glm::dvec3> swept_by(const Axis& axis, std::span<const glm::dvec3> corners) {
    struct Ring {
        double height;
        double radius;
    };

    std::vector<Ring> rings;
    for (const glm::dvec3& corner : corners) {
        const double height = glm::dot(corner - axis.point, axis.along);
        const double radius = glm::length(corner - axis.point - axis.along * height);
        const auto same =
            std::ranges::find_if(rings, [&](const Ring& ring) { return std::abs(ring.height - height) < 1e-12; });
        if (same == rings.end()) {
            rings.push_back({height, radius});
        } else {
            same->radius = std::max(same->radius, radius);
        }
    }
    std::vector<glm::dvec3> points;
    for (const Ring& ring : rings) {
        for (int side = 0; side < circle_sides; ++side) {
            points.push_back(
                axis.point + axis.along * ring.height + axis.across(side) * (ring.radius * outside_circle));
        }
    }
    return points;
}

/// The planes that replace a polygon's plane for all angles. As it turns, its value at an eye e is n.e + d = (part
/// along the axis) + (part across the axis) * cos(angle to e) * |distance of e from the axis|. The maximum over all
/// angles is at most that over circle_sides directions with the part across made slightly longer.
std::vector<Plane> swept_planes(const Axis& axis, const Plane& plane) {
    const double along = glm::dot(plane.normal, axis.along);
    const double across = glm::length(plane.normal - axis.along * along);
    if (across < along_axis) { return {plane}; }
    const double at_point = distance_m(plane, axis.point);
    std::vector<Plane> planes;
    for (int side = 0; side < circle_sides; ++side) {
        glm::dvec3 normal = axis.along * along + axis.across(side) * (across * outside_circle);
        const double length = glm::length(normal);
        normal /= length;
        planes.push_back({normal, at_point / length - glm::dot(normal, axis.point)});
    }
    return planes;
}

CheckFrame check_frame(const models::polygons::PolygonModel& model) {
    glm::dvec3 least(model.vertices_m[model.corner_vertices.front()]);
    glm::dvec3 most = least;
    for (const std::uint32_t vertex : model.corner_vertices) {
        least = glm::min(least, model.vertices_m[vertex]);
        most = glm::max(most, model.vertices_m[vertex]);
    }
    return {(least + most) * 0.5, glm::distance(least, most)};
}

/// The shapes of all polygons of a model; `two_sided` are the polygons seen from both sides.
std::vector<CheckShape> check_shapes(
    const models::polygons::PolygonModel& model, const CheckFrame& frame, std::span<const std::uint32_t> two_sided) {
    std::vector<CheckShape> shapes;
    for (std::uint32_t i = 0; i < model.polygons.size(); ++i) {
        CheckShape shape;
        for (const std::uint32_t vertex : model.corners(i)) {
            shape.corners.push_back(frame.from_body(model.vertices_m[vertex]));
        }
        shape.corners = drawn_together(std::move(shape.corners));
        const Plane plane = frame.from_body(models::polygons::plane_of(model, i));
        shape.fronts = {plane};
        if (std::ranges::find(two_sided, i) != two_sided.end()) { shape.fronts.push_back(turned_over(plane)); }
        shape.pivot = models::polygons::pivot_of(model, i);
        shape.swept = shape.corners;
        shape.swept_fronts = shape.fronts;
        if (shape.pivot) {
            const Axis axis = axis_of(model.pivots[*shape.pivot], frame);
            shape.swept = swept_by(axis, shape.corners);
            shape.swept_fronts.clear();
            for (const Plane& front : shape.fronts) {
                const auto planes = swept_planes(axis, front);
                shape.swept_fronts.insert(shape.swept_fronts.end(), planes.begin(), planes.end());
            }
        }
        shapes.push_back(std::move(shape));
    }
    return shapes;
}

/// One run of check_order.
class OrderChecker {
public:
    OrderChecker(const models::polygons::PolygonModel& model, const CellOrders& orders)
        : model_(model), orders_(orders), frame_(check_frame(model)),
          shapes_(check_shapes(model, frame_, orders.two_sided)) {}

    OrderCheck check(const std::function<void(std::size_t, std::size_t)>& progress) {
        for (std::size_t i = 0; i < orders_.cells.size(); ++i) {
            check_cell(i);
            if (progress) { progress(i + 1, orders_.cells.size()); }
        }
        return std::move(check_);
    }

private:
    void check_cell(std::size_t cell) {
        const auto& list = orders_.cells[cell].list;
        region_.clear();
        for (const Plane& plane : region_of(orders_, orders_.cells[cell])) {
            region_.push_back(frame_.from_body(plane));
        }
        std::vector<bool> listed(shapes_.size());
        for (const std::uint32_t polygon : list) { listed[polygon] = true; }
        for (std::uint32_t polygon = 0; polygon < shapes_.size(); ++polygon) {
            if (!listed[polygon]) { check_unlisted(cell, polygon); }
        }
        for (std::size_t first = 0; first < list.size(); ++first) {
            for (std::size_t later = first + 1; later < list.size(); ++later) {
                check_pair(cell, list[first], list[later]);
            }
        }
    }

    /// Checks that a polygon which a cell does not list faces away from all its eyes.
    void check_unlisted(std::size_t cell, std::uint32_t polygon) {
        ++check_.unlisted;
        const auto& fronts = shapes_[polygon].swept_fronts;
        const bool unseen =
            std::ranges::all_of(fronts, [&](const Plane& front) { return is_behind(region_, front, check_tolerance); });
        if (!unseen) {
            ++check_.unlisted_unproved;
            doubt({cell, polygon, polygon});
        }
    }

    /// Checks that a polygon hides nothing of one that is painted later.
    void check_pair(std::size_t cell, std::uint32_t first, std::uint32_t later) {
        ++check_.pairs;
        switch (certificate(shapes_[first], shapes_[later])) {
        case SeparationMethod::Plane:
            ++check_.by_plane;
            break;
        case SeparationMethod::LinearProgram:
            ++check_.by_linear_program;
            break;
        case SeparationMethod::None:
            ++check_.pairs_unproved;
            doubt({cell, first, later});
        }
    }

    /// The weakest certificate over the sides from which each of the two polygons is seen.
    SeparationMethod certificate(const CheckShape& occluder, const CheckShape& occluded) const {
        const bool rigid = occluder.pivot == occluded.pivot;
        const Planes region = rigid && occluder.pivot ? unturned(*occluder.pivot) : region_;
        SeparationMethod weakest = SeparationMethod::Plane;
        for (const Planes& near_side : sides_of(occluder, rigid)) {
            for (const Planes& far_side : sides_of(occluded, rigid)) {
                Planes planes = region;
                planes.insert(planes.end(), near_side.begin(), near_side.end());
                planes.insert(planes.end(), far_side.begin(), far_side.end());
                weakest = std::max(weakest, find_separation(rigid ? occluder.corners : occluder.swept,
                                                rigid ? occluded.corners : occluded.swept, planes));
            }
        }
        return weakest;
    }

    /// For each side from which a polygon is seen, the planes that those eyes are in front of.
    static std::vector<Planes> sides_of(const CheckShape& shape, bool rigid) {
        if (!rigid && shape.swept_fronts.size() != shape.fronts.size()) { return {Planes{}}; }
        std::vector<Planes> sides;
        for (const Plane& front : shape.fronts) { sides.push_back({front}); }
        return sides;
    }

    /// The region as a turning part sees it: only planes perpendicular to its axis hold at every angle.
    Planes unturned(std::uint32_t pivot) const {
        Planes planes;
        std::ranges::copy_if(region_, std::back_inserter(planes), [&](const Plane& plane) {
            return glm::length(glm::cross(plane.normal, model_.pivots[pivot].axis)) < along_axis;
        });
        return planes;
    }

    void doubt(const UnprovedPair& doubt) {
        if (check_.first_unproved.size() < OrderCheck::max_doubts) { check_.first_unproved.push_back(doubt); }
    }

    const models::polygons::PolygonModel& model_;
    const CellOrders& orders_;
    CheckFrame frame_;
    std::vector<CheckShape> shapes_;
    Planes region_; ///< The region of the cell that is being checked.
    OrderCheck check_;
};

} // namespace

std::vector<Plane> without_redundant(std::span<const Plane> planes) {
    std::vector<Plane> kept(planes.begin(), planes.end());
    for (std::size_t i = kept.size(); i-- > 0;) {
        const Plane opposite{-kept[i].normal, -kept[i].offset_m};
        std::vector<Plane> others = kept;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        if (is_behind(others, opposite, redundancy_tolerance)) { kept = std::move(others); }
    }
    return kept;
}

OrderCheck check_order(const models::polygons::PolygonModel& model, const CellOrders& orders,
    const std::function<void(std::size_t, std::size_t)>& progress) {
    assert(orders.faces == model.polygons.size());
    return OrderChecker(model, orders).check(progress);
}

} // namespace octant::visuals::orderfile
