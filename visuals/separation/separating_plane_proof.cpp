// Seeks planes that prove that one polygon hides nothing of another. By Farkas' lemma every plane with all eyes before
// it is a sum, with factors >= 0, of the planes that bound the eyes and of 1; eyes that see a polygon are bounded by
// its plane, too. Where no single plane will do, a game finds the factors, and where rounding spoils that a linear
// programme.
#include "visuals/separation/separating_plane_proof.h"

#include "sim/base/units.h"
#include "visuals/separation/linear_program.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace octant::visuals::separation {

namespace {

using models::polygons::PolygonModel;

/// The share of the tolerance that is used; the rest is for the rounding of this code.
constexpr double safe = 0.999;
/// How far a corner may be from a plane that is not quite the polygon's own, in tolerances.
constexpr double share_of_borrowed = 0.25;
constexpr int circle_sides = 24;
/// A model farther from the origin than this is far from it, in sizes.
constexpr double far_sizes = 100.0;

/// Twice the area, along the normal (Newell's sum about the first corner).
glm::dvec3 area_of(const std::vector<glm::dvec3>& corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return sum;
}

Plane through_middle(const glm::dvec3& normal, const std::vector<glm::dvec3>& corners) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : corners) { middle += corner / static_cast<double>(corners.size()); }
    return {normal, -glm::dot(normal, middle)};
}

bool fits(const LocalPolygon& polygon, const Plane& plane, double tolerance) {
    return glm::dot(area_of(polygon.corners), plane.normal) >= 0.0 &&
           std::ranges::all_of(polygon.corners, [&](const glm::dvec3& corner) {
               return std::abs(distance_m(plane, corner)) < share_of_borrowed * tolerance;
           });
}

/// Gives pieces of one polygon the plane of the largest.
void share_planes(const PolygonModel& model, LocalModel& out) {
    std::map<std::uint32_t, std::pair<double, std::size_t>> largest;
    for (std::size_t i = 0; i < out.polygons.size(); ++i) {
        const double area = glm::length(area_of(out.polygons[i].corners));
        auto& known = largest[model.parent_of(i)];
        known = std::max(known, std::pair(area, i));
    }
    for (std::size_t i = 0; i < out.polygons.size(); ++i) {
        const Plane& plane = out.polygons[largest[model.parent_of(i)].second].plane;
        if (fits(out.polygons[i], plane, out.tolerance)) { out.polygons[i].plane = plane; }
    }
}

/// Prepares a polygon that turns about an axis.
void set_turning(const LocalAxis& axis, double tolerance, LocalPolygon& polygon) {
    const double facing = glm::dot(polygon.plane.normal, axis.along);
    const Plane across = through_middle(facing > 0.0 ? axis.along : -axis.along, polygon.corners);
    polygon.keeps_plane = fits(polygon, across, tolerance);
    if (polygon.keeps_plane) { polygon.plane = across; }
    const glm::dvec3 aside = std::abs(axis.along.x) > 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, axis.along));
    const glm::dvec3 up = glm::cross(axis.along, right);
    polygon.swept.clear();
    for (const glm::dvec3& corner : polygon.corners) {
        const double height = glm::dot(corner - axis.point, axis.along);
        const glm::dvec3 foot = axis.point + axis.along * height;
        const double reach = glm::distance(corner, foot) / std::cos(pi / circle_sides);
        for (int side = 0; side < circle_sides; ++side) {
            const double angle_rad = 2.0 * pi * side / circle_sides;
            polygon.swept.push_back(foot + (right * std::cos(angle_rad) + up * std::sin(angle_rad)) * reach);
        }
    }
}

/// The height over a plane of the highest point on the circle of a corner.
double highest(const Plane& plane, const LocalAxis& axis, const glm::dvec3& corner) {
    const glm::dvec3 foot = axis.point + axis.along * glm::dot(corner - axis.point, axis.along);
    const glm::dvec3 across = plane.normal - axis.along * glm::dot(plane.normal, axis.along);
    return distance_m(plane, foot) + glm::distance(corner, foot) * glm::length(across);
}

} // namespace

// In long double, so that a model far from its origin loses no digits.
Plane LocalModel::from_file(const Plane& plane_m) const {
    long double offset = plane_m.offset_m;
    for (int i = 0; i < 3; ++i) { offset += static_cast<long double>(plane_m.normal[i]) * middle_m[i]; }
    return {plane_m.normal, static_cast<double>(offset / size_m)};
}

Plane LocalModel::about(const Plane& plane_m) const {
    long double offset = plane_m.offset_m;
    for (int i = 0; i < 3; ++i) { offset += static_cast<long double>(plane_m.normal[i]) * reference_m[i]; }
    return {plane_m.normal, static_cast<double>(offset)};
}

Plane LocalModel::in_metres(const Plane& plane) const {
    long double offset = static_cast<long double>(plane.offset_m) * size_m;
    const glm::dvec3 to_middle_m = middle_m - reference_m;
    for (int i = 0; i < 3; ++i) { offset -= static_cast<long double>(plane.normal[i]) * to_middle_m[i]; }
    return {plane.normal, static_cast<double>(offset)};
}

LocalModel local_model(const PolygonModel& model, const models::polygons::FileAxes& axes, double tolerance) {
    LocalModel out;
    out.tolerance = tolerance;
    const auto corner = [&](std::uint32_t vertex) { return axes.file_from_body(model.vertices_m[vertex]); };
    glm::dvec3 least = corner(model.corner_vertices.front());
    glm::dvec3 most = least;
    for (const std::uint32_t vertex : model.corner_vertices) {
        least = glm::min(least, corner(vertex));
        most = glm::max(most, corner(vertex));
    }
    const glm::dvec3 box = most - least;
    out.middle_m = least + box * 0.5;
    out.size_m = std::max({box.x, box.y, box.z});
    if (glm::length(out.middle_m) > far_sizes * out.size_m) { out.reference_m = out.middle_m; }
    const auto local = [&](const glm::dvec3& point_m) {
        return (axes.file_from_body(point_m) - out.middle_m) / out.size_m;
    };
    for (const models::polygons::Pivot& pivot : model.pivots) {
        out.axes.push_back({local(pivot.point_m), axes.file_from_body(pivot.axis)});
    }
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        LocalPolygon& polygon = out.polygons.emplace_back();
        for (const std::uint32_t vertex : model.corners(i)) {
            polygon.corners.push_back(local(model.vertices_m[vertex]));
        }
        polygon.plane = through_middle(glm::normalize(area_of(polygon.corners)), polygon.corners);
        polygon.swept = polygon.corners;
        polygon.axis = models::polygons::pivot_of(model, i);
    }
    share_planes(model, out);
    for (LocalPolygon& polygon : out.polygons) {
        if (polygon.axis) { set_turning(out.axes[*polygon.axis], tolerance, polygon); }
    }
    return out;
}

bool is_behind(const LocalModel& model, std::uint32_t number, const Plane& plane, bool turns) {
    const LocalPolygon& polygon = model.polygons[number];
    const glm::dvec3 size = glm::abs(plane.normal);
    const double limit = safe * model.tolerance * std::max({size.x, size.y, size.z});
    return std::ranges::all_of(polygon.corners, [&](const glm::dvec3& corner) {
        const double height =
            turns && polygon.axis ? highest(plane, model.axes[*polygon.axis], corner) : distance_m(plane, corner);
        return height <= limit;
    });
}

namespace {

// Iterative refinement: A. Gleixner, D. Steffy, K. Wolter, "Iterative Refinement for Linear Programming", 2016. A
// solver keeps bounds within 1e-9. What it is off by is put under a magnifying glass and solved for again, with the
// same factors.

constexpr double magnification = 1e6;
constexpr int rounds = 1;

/// The programme of what is to be added to a solution, times `magnification`.
LinearProgram correction(const LinearProgram& program, const std::vector<double>& solution) {
    LinearProgram out = program;
    for (std::size_t i = 0; i < solution.size(); ++i) {
        out.variables[i].least = (out.variables[i].least - solution[i]) * magnification;
        out.variables[i].most = (out.variables[i].most - solution[i]) * magnification;
    }
    for (LinearProgram::Row& row : out.rows) {
        long double value = 0.0;
        for (std::size_t i = 0; i < solution.size(); ++i) {
            value += static_cast<long double>(row.factors[i]) * solution[i];
        }
        row.least = static_cast<double>((row.least - value) * magnification);
        row.most = static_cast<double>((row.most - value) * magnification);
    }
    return out;
}

/// The variables of an optimum to nearly all of their digits; nothing where none is found.
std::optional<std::vector<double>> refined_optimum(const LinearProgram& program) {
    auto solution = optimum(program);
    for (int round = 0; solution && round < rounds; ++round) {
        const auto more = optimum(correction(program, *solution));
        if (!more) { break; }
        for (std::size_t i = 0; i < solution->size(); ++i) { (*solution)[i] += (*more)[i] / magnification; }
    }
    return solution;
}

} // namespace

// G. Dantzig's way to solve a game by the simplex method: with all payoffs positive the other player's programme, to
// maximise the sum of y with y >= 0 and at most 1 for each choice, begins at y = 0, and its dual variables are
// proportional to the shares.

namespace {

constexpr double game_rounding = 1e-13;

/// A row for each choice and one for the aim, a column for each case and one for the bounds.
class Tableau {
public:
    explicit Tableau(const Payoffs& payoffs)
        : choices_(payoffs.choices), cases_(payoffs.cases()), wide_(cases_ + 1), cells_((choices_ + 1) * wide_, 0.0),
          of_row_(choices_), of_column_(cases_) {
        const double shift = 1.0 - *std::ranges::min_element(payoffs.values);
        for (std::size_t i = 0; i < choices_; ++i) {
            for (std::size_t k = 0; k < cases_; ++k) { at(i, k) = payoffs.values[k * choices_ + i] + shift; }
            at(i, cases_) = 1.0;
        }
        for (std::size_t k = 0; k < cases_; ++k) { at(choices_, k) = -1.0; }
        std::iota(of_row_.begin(), of_row_.end(), std::size_t{0});
        std::iota(of_column_.begin(), of_column_.end(), choices_);
    }

    std::vector<double> shares() {
        // Far more steps than are ever needed: a circle would end here.
        const std::size_t max_steps = 8 * (choices_ + cases_) + 32;
        for (std::size_t step = 0; step < max_steps; ++step) {
            const std::size_t column = entering();
            if (column == cases_) { break; }
            exchange(leaving(column), column);
        }
        std::vector<double> shares(choices_, 0.0);
        double sum = 0.0;
        for (std::size_t k = 0; k < cases_; ++k) {
            if (of_column_[k] < choices_) { sum += shares[of_column_[k]] = std::max(at(choices_, k), 0.0); }
        }
        for (double& share : shares) { share = sum > 0.0 ? share / sum : 1.0 / static_cast<double>(choices_); }
        return shares;
    }

private:
    double& at(std::size_t row, std::size_t column) { return cells_[row * wide_ + column]; }

    /// The column that improves the aim most; none at the optimum.
    std::size_t entering() {
        const auto row = cells_.begin() + static_cast<std::ptrdiff_t>(choices_ * wide_);
        const auto least = std::min_element(row, row + static_cast<std::ptrdiff_t>(cases_));
        return *least < -game_rounding ? static_cast<std::size_t>(least - row) : cases_;
    }

    /// The row whose bound is met first. There is one: all payoffs are positive.
    std::size_t leaving(std::size_t column) {
        std::size_t first = choices_;
        double least = 0.0;
        for (std::size_t i = 0; i < choices_; ++i) {
            if (at(i, column) <= game_rounding) { continue; }
            const double ratio = at(i, cases_) / at(i, column);
            if (first == choices_ || ratio < least) {
                first = i;
                least = ratio;
            }
        }
        return std::min(first, choices_ - 1);
    }

    void exchange(std::size_t row, std::size_t column) {
        const double pivot = at(row, column);
        for (std::size_t k = 0; k < wide_; ++k) { at(row, k) = k == column ? 1.0 / pivot : at(row, k) / pivot; }
        for (std::size_t i = 0; i <= choices_; ++i) {
            if (i == row) { continue; }
            const double factor = at(i, column);
            for (std::size_t k = 0; k < wide_ && factor != 0.0; ++k) {
                at(i, k) = k == column ? -factor / pivot : at(i, k) - factor * at(row, k);
            }
        }
        std::swap(of_row_[row], of_column_[column]);
    }

    std::size_t choices_;
    std::size_t cases_;
    std::size_t wide_;
    std::vector<double> cells_;
    std::vector<std::size_t> of_row_; ///< What stands there: choices, then cases.
    std::vector<std::size_t> of_column_;
};

} // namespace

std::vector<double> best_shares(const Payoffs& payoffs) {
    assert(payoffs.cases() > 0);
    return Tableau(payoffs).shares();
}

namespace {

/// Planes of which a sum may be made, and which factor each one has: 0 is that of the earlier polygon, 1 of the later
/// one, the others those of the region planes.
struct UsablePlanes {
    std::vector<Plane> planes;
    std::vector<std::size_t> factors;
};

PlaneFactors factors_of(
    const UsablePlanes& usable, const std::vector<double>& found, double one, std::size_t region_planes) {
    std::vector<double> all(region_planes + 2, 0.0);
    for (std::size_t i = 0; i < usable.factors.size(); ++i) { all[usable.factors[i]] = std::max(found[i], 0.0); }
    return {all[0], all[1], std::max(one, 0.0), {all.begin() + 2, all.end()}};
}

Plane sum_of(const UsablePlanes& usable, const std::vector<double>& found, double one) {
    Plane sum{glm::dvec3(0.0), std::max(one, 0.0)};
    for (std::size_t i = 0; i < usable.planes.size(); ++i) {
        const double factor = std::max(found[i], 0.0);
        sum.normal += usable.planes[i].normal * factor;
        sum.offset_m += usable.planes[i].offset_m * factor;
    }
    return sum;
}

/// How the factors of a separating plane are held down.
enum class Norm {
    PlaneFactors, ///< They add up to 1.
    /// The middles of the two polygons are 1 apart across the plane. Where the region of the eyes is so thin that
    /// factors of another size nearly cancel out, a plane is left all the same.
    Distance
};

glm::dvec3 middle_of(std::span<const glm::dvec3> points) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& point : points) { sum += point; }
    return sum / static_cast<double>(points.size());
}

/// The programme of a separating plane. Its unknowns are a factor for each plane, one for 1, and the margin, which is
/// maximised.
LinearProgram separation_programme(
    const UsablePlanes& usable, std::span<const glm::dvec3> behind, std::span<const glm::dvec3> before, Norm norm) {
    LinearProgram program;
    const std::size_t planes = usable.planes.size();
    program.variables.assign(planes + 1, {});
    program.variables.push_back({.weight = 1.0, .least = -1e3, .most = 1e3});
    const auto add_corner = [&](const glm::dvec3& corner, double sign) {
        LinearProgram::Row row;
        for (const Plane& plane : usable.planes) { row.factors.push_back(sign * distance_m(plane, corner)); }
        row.factors.push_back(sign);
        row.factors.push_back(-1.0);
        row.least = 0.0;
        program.rows.push_back(std::move(row));
    };
    for (const glm::dvec3& corner : behind) { add_corner(corner, -1.0); }
    for (const glm::dvec3& corner : before) { add_corner(corner, 1.0); }
    LinearProgram::Row total;
    total.factors.assign(planes + 1, 1.0);
    if (norm == Norm::Distance) {
        const glm::dvec3 across = middle_of(before) - middle_of(behind);
        for (std::size_t i = 0; i < planes; ++i) { total.factors[i] = glm::dot(usable.planes[i].normal, across); }
        total.factors[planes] = 0.0;
    }
    total.factors.push_back(0.0);
    total.least = total.most = 1.0;
    program.rows.push_back(std::move(total));
    return program;
}

/// The programme of a sum that is negative everywhere. Its unknowns are a factor for each plane and the error, which is
/// minimised; those of the polygons add up to 1.
LinearProgram nowhere_programme(const UsablePlanes& usable) {
    LinearProgram program;
    program.variables.assign(usable.planes.size(), {});
    program.variables.push_back({.weight = -1.0});
    for (int i = 0; i < 4; ++i) {
        for (const double sign : {1.0, -1.0}) {
            if (i == 3 && sign < 0.0) { continue; }
            LinearProgram::Row row;
            for (const Plane& plane : usable.planes) {
                row.factors.push_back(sign * (i < 3 ? plane.normal[i] : plane.offset_m));
            }
            row.factors.push_back(-1.0);
            row.most = 0.0;
            program.rows.push_back(std::move(row));
        }
    }
    LinearProgram::Row total;
    for (const std::size_t factor : usable.factors) { total.factors.push_back(factor < 2 ? 1.0 : 0.0); }
    total.factors.push_back(0.0);
    total.least = total.most = 1.0;
    program.rows.push_back(std::move(total));
    return program;
}

/// Two polygons and the eyes for which their order is to be proved.
struct ProofQuery {
    const LocalModel& model;
    std::span<const Plane> region_planes;
    std::uint32_t earlier;
    std::uint32_t later;
    bool turns; ///< They do not turn together about one axis.
};

bool separate_angles(const LocalModel& model, std::uint32_t earlier, std::uint32_t later) {
    const auto& axis = model.polygons[earlier].axis;
    return !(axis && axis == model.polygons[later].axis);
}

/// The planes that all eyes that see both are before; polygons that turn together see region planes turn.
UsablePlanes usable(const ProofQuery& query) {
    UsablePlanes out;
    const auto add = [&](std::size_t factor, const Plane& plane) {
        out.factors.push_back(factor);
        out.planes.push_back(plane);
    };
    const auto add_front = [&](std::size_t factor, std::uint32_t polygon) {
        if (query.model.polygons[polygon].keeps_plane || !query.turns) {
            add(factor, query.model.polygons[polygon].plane);
        }
    };
    add_front(0, query.earlier);
    if (query.later != query.earlier) { add_front(1, query.later); }
    for (std::size_t wall = 0; query.turns && wall < query.region_planes.size(); ++wall) {
        add(wall + 2, query.region_planes[wall]);
    }
    return out;
}

/// The factors for planes and for 1, if their sum is a separating plane.
std::optional<PlaneFactors> verified(
    const ProofQuery& query, const UsablePlanes& planes, const std::vector<double>& found) {
    const double one = found[planes.planes.size()];
    const Plane sum = sum_of(planes, found, one);
    const bool good = glm::length(sum.normal) > 0.0 && is_behind(query.model, query.earlier, sum, query.turns) &&
                      is_before(query.model, query.later, sum, query.turns);
    return good ? std::optional(factors_of(planes, found, one, query.region_planes.size())) : std::nullopt;
}

/// What a plane must have behind it, or before it.
std::span<const glm::dvec3> corners_of(const ProofQuery& query, std::uint32_t polygon) {
    const LocalPolygon& one = query.model.polygons[polygon];
    return query.turns ? one.swept : one.corners;
}

/// A plane by a game: each corner asks how far it is on its side of the sum.
std::optional<PlaneFactors> separate_by_game(const ProofQuery& query, const UsablePlanes& planes) {
    Payoffs payoffs{planes.planes.size() + 1, {}};
    for (const auto& [polygon, sign] : {std::pair(query.earlier, -1.0), {query.later, 1.0}}) {
        for (const glm::dvec3& corner : corners_of(query, polygon)) {
            for (const Plane& plane : planes.planes) { payoffs.values.push_back(sign * distance_m(plane, corner)); }
            payoffs.values.push_back(sign);
        }
    }
    return verified(query, planes, best_shares(payoffs));
}

std::optional<PlaneFactors> separating(const ProofQuery& query, const UsablePlanes& planes) {
    for (const Norm norm : {Norm::PlaneFactors, Norm::Distance}) {
        const LinearProgram program =
            separation_programme(planes, corners_of(query, query.earlier), corners_of(query, query.later), norm);
        for (const auto& solve : {&optimum, &refined_optimum}) {
            const auto found = solve(program);
            auto factors = found ? verified(query, planes, *found) : std::nullopt;
            if (factors) { return factors; }
        }
    }
    return std::nullopt;
}

/// How many of the planes are those of polygons; they stand first.
std::ptrdiff_t planes_of_polygons(const UsablePlanes& planes) {
    return std::ranges::count_if(planes.factors, [](std::size_t factor) { return factor < 2; });
}

/// Factors for planes, if their sum is negative everywhere.
std::optional<PlaneFactors> verified_negative(
    const ProofQuery& query, const UsablePlanes& planes, std::vector<double> found) {
    const std::ptrdiff_t of_polygons = planes_of_polygons(planes);
    double total = 0.0;
    for (std::ptrdiff_t i = 0; i < of_polygons; ++i) { total += std::max(found[static_cast<std::size_t>(i)], 0.0); }
    if (total <= 0.0) { return std::nullopt; }
    // Those of the polygons have to add up to 1 at least, rounded as they are.
    const double scale = (of_polygons == 1 ? 1.0 : 1.0 + 1e-15) / total;
    for (double& factor : found) { factor = std::max(factor, 0.0) * scale; }
    if (of_polygons == 1) { found.front() = 1.0; }
    const Plane sum = sum_of(planes, found, 0.0);
    const glm::dvec3 size = glm::abs(sum.normal);
    const bool good = std::max({size.x, size.y, size.z, sum.offset_m}) <= safe * query.model.tolerance;
    return good ? std::optional(factors_of(planes, found, 0.0, query.region_planes.size())) : std::nullopt;
}

/// A sum that is negative everywhere by a game: each axis, either way, and the middle ask how far it is from being
/// positive.
std::optional<PlaneFactors> never_both_visible_by_game(const ProofQuery& query, const UsablePlanes& planes) {
    if (planes_of_polygons(planes) == 0) { return std::nullopt; }
    Payoffs payoffs{planes.planes.size(), {}};
    for (const double sign : {1.0, -1.0}) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const Plane& plane : planes.planes) { payoffs.values.push_back(sign * plane.normal[axis]); }
        }
    }
    for (const Plane& plane : planes.planes) { payoffs.values.push_back(-plane.offset_m); }
    return verified_negative(query, planes, best_shares(payoffs));
}

std::optional<PlaneFactors> find_never_both_visible(const ProofQuery& query, const UsablePlanes& planes) {
    if (planes_of_polygons(planes) == 0) { return std::nullopt; }
    const auto found = refined_optimum(nowhere_programme(planes));
    return found ? verified_negative(query, planes, *found) : std::nullopt;
}

} // namespace

DecidingPolygon deciding_polygon(
    const LocalModel& model, std::uint32_t earlier, std::uint32_t later, DecidingPolygon preferred) {
    const bool turns = separate_angles(model, earlier, later);
    const auto decides = [&](DecidingPolygon one) {
        const LocalPolygon& polygon = model.polygons[one == DecidingPolygon::Earlier ? earlier : later];
        return (polygon.keeps_plane || !turns) &&
               (one == DecidingPolygon::Earlier ? is_before(model, later, polygon.plane, turns)
                                                : is_behind(model, earlier, polygon.plane, turns));
    };
    const DecidingPolygon first =
        preferred == DecidingPolygon::Later ? DecidingPolygon::Later : DecidingPolygon::Earlier;
    const DecidingPolygon other = first == DecidingPolygon::Later ? DecidingPolygon::Earlier : DecidingPolygon::Later;
    return decides(first) ? first : decides(other) ? other : DecidingPolygon::Neither;
}

SeparatingPlaneProof find_separating_plane(
    const LocalModel& model, std::span<const Plane> region_planes, std::uint32_t earlier, std::uint32_t later) {
    const ProofQuery query{model, region_planes, earlier, later, separate_angles(model, earlier, later)};
    const UsablePlanes planes = usable(query);
    using Search = std::optional<PlaneFactors> (*)(const ProofQuery&, const UsablePlanes&);
    constexpr std::array<std::pair<Search, SeparatingPlaneProof::Kind>, 4> searches{
        {{&separate_by_game, SeparatingPlaneProof::Kind::Sum},
            {&never_both_visible_by_game, SeparatingPlaneProof::Kind::Never},
            {&separating, SeparatingPlaneProof::Kind::Sum},
            {&find_never_both_visible, SeparatingPlaneProof::Kind::Never}}};
    for (const auto& [search, kind] : searches) {
        if (auto factors = search(query, planes)) { return {kind, std::move(*factors)}; }
    }
    return {};
}

std::optional<PlaneFactors> find_back_facing_proof(
    const LocalModel& model, std::span<const Plane> region_planes, std::uint32_t polygon) {
    const ProofQuery query{model, region_planes, polygon, polygon, true};
    const UsablePlanes planes = usable(query);
    auto factors = never_both_visible_by_game(query, planes);
    return factors ? std::move(factors) : find_never_both_visible(query, planes);
}

} // namespace octant::visuals::separation
