// The rule of exact painting orders as a proof. Let A and B be convex planar polygons and R' the eyes that see both
// from the front. B can hide part of A if and only if no plane weakly separates B from the convex hull of A and R'.
//
// By Farkas' lemma a plane has R' = {e : Ni.e + Di >= 0} in front of it when it is a sum of the planes (Ni, Di), and of
// (0, 1), with factors >= 0. These factors are the unknowns of a small linear programme. The plane that results is
// measured against the corners again, so that nothing rests on the solver's word.
#include "visuals/separation/separation.h"

#include "visuals/separation/linear_program.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace octant::visuals::separation {

namespace {

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
    std::span<const glm::dvec3> occluder, std::span<const glm::dvec3> far_one, std::span<const Plane> planes) {
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
    for (const glm::dvec3& corner : far_one) { add_corner(corner, 1.0); }
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

} // namespace

SeparationMethod find_separation(
    std::span<const glm::dvec3> occluder, std::span<const glm::dvec3> far_one, std::span<const Plane> planes) {
    for (const Plane& plane : planes) {
        if (parts(plane, check_tolerance, occluder, far_one)) { return SeparationMethod::Plane; }
    }
    const auto factors = optimum(separation_programme(occluder, far_one, planes));
    if (!factors) { return SeparationMethod::None; }
    const Plane sum = sum_of(planes, *factors);
    const double length = glm::length(sum.normal);
    const bool no_inside = length < min_normal && sum.offset_m < min_normal;
    const bool good = no_inside || parts(sum, check_tolerance * length, occluder, far_one);
    return good ? SeparationMethod::LinearProgram : SeparationMethod::None;
}

// The unknowns are a factor for each plane and the error, which is minimised. The sum of the planes with their factors
// and of `plane` itself must be (0, 0, 0, 0 or less) within the error.
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

} // namespace octant::visuals::separation
