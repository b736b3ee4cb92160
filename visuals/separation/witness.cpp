// Seeks planes that prove that one polygon hides nothing of another. By Farkas' lemma every plane
// with all eyes before it is a sum, with factors >= 0, of the planes that bound the eyes and of 1;
// eyes that see a polygon are bounded by its plane, too. Where no single plane will do, a game
// finds the factors, and where rounding spoils that a linear programme.
#include "visuals/separation/witness.h"

#include "visuals/separation/linear_programme.h"
#include "visuals/separation/matrix_game.h"
#include "visuals/separation/refined_optimum.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace octant::visuals::separation {

namespace {

/// What is left of the tolerance for the rounding of this code.
constexpr double safe = 0.999;

/// Planes of which a sum may be made, and which factor each one has: 0 is that of the earlier
/// polygon, 1 of the later one, the others those of the walls.
struct Usable {
    std::vector<Plane> planes;
    std::vector<std::size_t> factors;
};

Factors
factors_of(const Usable& usable, const std::vector<double>& found, double one, std::size_t walls) {
    std::vector<double> all(walls + 2, 0.0);
    for (std::size_t i = 0; i < usable.factors.size(); ++i) {
        all[usable.factors[i]] = std::max(found[i], 0.0);
    }
    return {all[0], all[1], std::max(one, 0.0), {all.begin() + 2, all.end()}};
}

Plane sum_of(const Usable& usable, const std::vector<double>& found, double one) {
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
    Factors, ///< They add up to 1.
    /// The middles of the two polygons are 1 apart across the plane. Where the region of the eyes
    /// is so thin that factors of another size nearly cancel out, a plane is left all the same.
    Distance
};

glm::dvec3 middle_of(std::span<const glm::dvec3> points) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& point : points) {
        sum += point;
    }
    return sum / static_cast<double>(points.size());
}

/// The programme of a separating plane. Its unknowns are a factor for each plane, one for 1, and
/// the margin, which is maximised.
LinearProgramme separation_programme(
    const Usable& usable,
    std::span<const glm::dvec3> behind,
    std::span<const glm::dvec3> before,
    Norm norm) {
    LinearProgramme programme;
    const std::size_t planes = usable.planes.size();
    programme.variables.assign(planes + 1, {});
    programme.variables.push_back({.weight = 1.0, .least = -1e3, .most = 1e3});
    const auto add_corner = [&](const glm::dvec3& corner, double sign) {
        LinearProgramme::Row row;
        for (const Plane& plane : usable.planes) {
            row.factors.push_back(sign * distance_m(plane, corner));
        }
        row.factors.push_back(sign);
        row.factors.push_back(-1.0);
        row.least = 0.0;
        programme.rows.push_back(std::move(row));
    };
    for (const glm::dvec3& corner : behind) {
        add_corner(corner, -1.0);
    }
    for (const glm::dvec3& corner : before) {
        add_corner(corner, 1.0);
    }
    LinearProgramme::Row total;
    total.factors.assign(planes + 1, 1.0);
    if (norm == Norm::Distance) {
        const glm::dvec3 across = middle_of(before) - middle_of(behind);
        for (std::size_t i = 0; i < planes; ++i) {
            total.factors[i] = glm::dot(usable.planes[i].normal, across);
        }
        total.factors[planes] = 0.0;
    }
    total.factors.push_back(0.0);
    total.least = total.most = 1.0;
    programme.rows.push_back(std::move(total));
    return programme;
}

/// The programme of a sum that is negative everywhere. Its unknowns are a factor for each plane and
/// the error, which is minimised; those of the polygons add up to 1.
LinearProgramme nowhere_programme(const Usable& usable) {
    LinearProgramme programme;
    programme.variables.assign(usable.planes.size(), {});
    programme.variables.push_back({.weight = -1.0});
    for (int i = 0; i < 4; ++i) {
        for (const double sign : {1.0, -1.0}) {
            if (i == 3 && sign < 0.0) {
                continue;
            }
            LinearProgramme::Row row;
            for (const Plane& plane : usable.planes) {
                row.factors.push_back(sign * (i < 3 ? plane.normal[i] : plane.offset_m));
            }
            row.factors.push_back(-1.0);
            row.most = 0.0;
            programme.rows.push_back(std::move(row));
        }
    }
    LinearProgramme::Row total;
    for (const std::size_t factor : usable.factors) {
        total.factors.push_back(factor < 2 ? 1.0 : 0.0);
    }
    total.factors.push_back(0.0);
    total.least = total.most = 1.0;
    programme.rows.push_back(std::move(total));
    return programme;
}

/// Two polygons and the eyes for which their order is to be proved.
struct Question {
    const LocalModel& model;
    std::span<const Plane> walls;
    std::uint32_t earlier;
    std::uint32_t later;
    bool turns; ///< They do not turn together about one axis.
};

bool turn_apart(const LocalModel& model, std::uint32_t earlier, std::uint32_t later) {
    const auto& axis = model.polygons[earlier].axis;
    return !(axis && axis == model.polygons[later].axis);
}

/// The planes that all eyes that see both are before; polygons that turn together see walls turn.
Usable usable(const Question& asked) {
    Usable out;
    const auto add = [&](std::size_t factor, const Plane& plane) {
        out.factors.push_back(factor);
        out.planes.push_back(plane);
    };
    const auto add_front = [&](std::size_t factor, std::uint32_t polygon) {
        if (asked.model.polygons[polygon].keeps_plane || !asked.turns) {
            add(factor, asked.model.polygons[polygon].plane);
        }
    };
    add_front(0, asked.earlier);
    if (asked.later != asked.earlier) {
        add_front(1, asked.later);
    }
    for (std::size_t wall = 0; asked.turns && wall < asked.walls.size(); ++wall) {
        add(wall + 2, asked.walls[wall]);
    }
    return out;
}

/// The factors for planes and for 1, if their sum is a witness.
std::optional<Factors>
judged(const Question& asked, const Usable& planes, const std::vector<double>& found) {
    const double one = found[planes.planes.size()];
    const Plane sum = sum_of(planes, found, one);
    const bool good = glm::length(sum.normal) > 0.0 &&
                      is_behind(asked.model, asked.earlier, sum, asked.turns) &&
                      is_before(asked.model, asked.later, sum, asked.turns);
    return good ? std::optional(factors_of(planes, found, one, asked.walls.size())) : std::nullopt;
}

/// What a plane must have behind it, or before it.
std::span<const glm::dvec3> corners_of(const Question& asked, std::uint32_t polygon) {
    const LocalPolygon& one = asked.model.polygons[polygon];
    return asked.turns ? one.swept : one.corners;
}

/// A plane by a game: each corner asks how far it is on its side of the sum.
std::optional<Factors> separating_by_game(const Question& asked, const Usable& planes) {
    Payoffs payoffs{planes.planes.size() + 1, {}};
    for (const auto& [polygon, sign] : {std::pair(asked.earlier, -1.0), {asked.later, 1.0}}) {
        for (const glm::dvec3& corner : corners_of(asked, polygon)) {
            for (const Plane& plane : planes.planes) {
                payoffs.values.push_back(sign * distance_m(plane, corner));
            }
            payoffs.values.push_back(sign);
        }
    }
    return judged(asked, planes, best_shares(payoffs));
}

std::optional<Factors> separating(const Question& asked, const Usable& planes) {
    for (const Norm norm : {Norm::Factors, Norm::Distance}) {
        const LinearProgramme programme = separation_programme(
            planes, corners_of(asked, asked.earlier), corners_of(asked, asked.later), norm);
        for (const auto& solve : {&optimum, &refined_optimum}) {
            const auto found = solve(programme);
            auto factors = found ? judged(asked, planes, *found) : std::nullopt;
            if (factors) {
                return factors;
            }
        }
    }
    return std::nullopt;
}

/// How many of the planes are those of polygons; they stand first.
std::ptrdiff_t planes_of_polygons(const Usable& planes) {
    return std::ranges::count_if(planes.factors, [](std::size_t factor) { return factor < 2; });
}

/// Factors for planes, if their sum is negative everywhere.
std::optional<Factors>
judged_negative(const Question& asked, const Usable& planes, std::vector<double> found) {
    const std::ptrdiff_t of_polygons = planes_of_polygons(planes);
    double total = 0.0;
    for (std::ptrdiff_t i = 0; i < of_polygons; ++i) {
        total += std::max(found[static_cast<std::size_t>(i)], 0.0);
    }
    if (total <= 0.0) {
        return std::nullopt;
    }
    // Those of the polygons have to add up to 1 at least, rounded as they are.
    const double scale = (of_polygons == 1 ? 1.0 : 1.0 + 1e-15) / total;
    for (double& factor : found) {
        factor = std::max(factor, 0.0) * scale;
    }
    if (of_polygons == 1) {
        found.front() = 1.0;
    }
    const Plane sum = sum_of(planes, found, 0.0);
    const glm::dvec3 size = glm::abs(sum.normal);
    const bool good =
        std::max({size.x, size.y, size.z, sum.offset_m}) <= safe * asked.model.tolerance;
    return good ? std::optional(factors_of(planes, found, 0.0, asked.walls.size())) : std::nullopt;
}

/// A sum that is negative everywhere by a game: each axis, either way, and the middle ask how far
/// it is from being positive.
std::optional<Factors> never_by_game(const Question& asked, const Usable& planes) {
    if (planes_of_polygons(planes) == 0) {
        return std::nullopt;
    }
    Payoffs payoffs{planes.planes.size(), {}};
    for (const double sign : {1.0, -1.0}) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const Plane& plane : planes.planes) {
                payoffs.values.push_back(sign * plane.normal[axis]);
            }
        }
    }
    for (const Plane& plane : planes.planes) {
        payoffs.values.push_back(-plane.offset_m);
    }
    return judged_negative(asked, planes, best_shares(payoffs));
}

std::optional<Factors> never(const Question& asked, const Usable& planes) {
    if (planes_of_polygons(planes) == 0) {
        return std::nullopt;
    }
    const auto found = refined_optimum(nowhere_programme(planes));
    return found ? judged_negative(asked, planes, *found) : std::nullopt;
}

} // namespace

Decider
decider(const LocalModel& model, std::uint32_t earlier, std::uint32_t later, Decider preferred) {
    const bool turns = turn_apart(model, earlier, later);
    const auto decides = [&](Decider one) {
        const LocalPolygon& polygon = model.polygons[one == Decider::Earlier ? earlier : later];
        return (polygon.keeps_plane || !turns) &&
               (one == Decider::Earlier ? is_before(model, later, polygon.plane, turns)
                                        : is_behind(model, earlier, polygon.plane, turns));
    };
    const Decider first = preferred == Decider::Later ? Decider::Later : Decider::Earlier;
    const Decider other = first == Decider::Later ? Decider::Earlier : Decider::Later;
    return decides(first) ? first : decides(other) ? other : Decider::Neither;
}

Witness witness_of(
    const LocalModel& model,
    std::span<const Plane> walls,
    std::uint32_t earlier,
    std::uint32_t later) {
    const Question asked{model, walls, earlier, later, turn_apart(model, earlier, later)};
    const Usable planes = usable(asked);
    using Search = std::optional<Factors> (*)(const Question&, const Usable&);
    constexpr std::array<std::pair<Search, Witness::Kind>, 4> searches{
        {{&separating_by_game, Witness::Kind::Sum},
         {&never_by_game, Witness::Kind::Never},
         {&separating, Witness::Kind::Sum},
         {&never, Witness::Kind::Never}}};
    for (const auto& [search, kind] : searches) {
        if (auto factors = search(asked, planes)) {
            return {kind, std::move(*factors)};
        }
    }
    return {};
}

std::optional<Factors>
factors_away(const LocalModel& model, std::span<const Plane> walls, std::uint32_t polygon) {
    const Question asked{model, walls, polygon, polygon, true};
    const Usable planes = usable(asked);
    auto factors = never_by_game(asked, planes);
    return factors ? std::move(factors) : never(asked, planes);
}

} // namespace octant::visuals::separation
