#include "visuals/verify/pair_check.h"

#include "visuals/verify/refusal.h"

#include <fmt/format.h>

namespace octant::visuals::verify {

/// Polygons that turn together stand still to one another.
Pose PairCheck::pose_of(const Pair& pair) const {
    const auto& axis = certificate_.polygons[pair.earlier].axis;
    const bool together = axis && axis == certificate_.polygons[pair.later].axis;
    return together ? Pose::Standing : Pose::Turning;
}

void PairCheck::expect_front(std::uint32_t polygon, Pose pose, int line) const {
    if (!sides_.has_front(polygon, pose)) {
        throw Refusal{
            line,
            fmt::format(
                "expected a witness without the plane of polygon {}, which turns, got one with it",
                polygon)};
    }
}

void PairCheck::check_earlier(const Pair& pair, int line) const {
    const Pose pose = pose_of(pair);
    expect_front(pair.earlier, pose, line);
    if (!sides_.is_before(pair.later, certificate_.polygons[pair.earlier].plane, pose)) {
        throw Refusal{
            line,
            fmt::format(
                "expected polygon {} before the plane of polygon {}, got a corner behind it",
                pair.later,
                pair.earlier)};
    }
}

void PairCheck::check_later(const Pair& pair, int line) const {
    const Pose pose = pose_of(pair);
    expect_front(pair.later, pose, line);
    if (!sides_.is_behind(pair.earlier, certificate_.polygons[pair.later].plane, pose)) {
        throw Refusal{
            line,
            fmt::format(
                "expected polygon {} behind the plane of polygon {}, got a corner before it",
                pair.earlier,
                pair.later)};
    }
}

void PairCheck::check(const PairClaim& claim, const Walls& walls) const {
    const Sum sum{claim.pair, pose_of(claim.pair), claim.factors, walls, claim.line};
    if (claim.kind == PairClaim::Kind::Sum) {
        check_separates(sum);
    } else if (claim.kind == PairClaim::Kind::Never) {
        check_never(sum);
    }
}

void PairCheck::check_away(
    std::uint32_t polygon, const AwayClaim& claim, const Walls& walls) const {
    check_never({{polygon, polygon}, Pose::Turning, claim.factors, walls, claim.line});
}

ExactPlane PairCheck::plane_of(const Sum& sum) const {
    ExactPlane plane;
    const auto add_front = [&](double factor, std::uint32_t polygon) {
        if (factor > 0.0) {
            expect_front(polygon, sum.pose, sum.line);
            add(plane, factor, exact(certificate_.polygons[polygon].plane));
        }
    };
    add_front(sum.factors.earlier, sum.pair.earlier);
    add_front(sum.factors.later, sum.pair.later);
    const auto& axis = certificate_.polygons[sum.pair.earlier].axis;
    for (std::size_t i = 0; i < sum.walls.size(); ++i) {
        const double factor = sum.factors.walls[i];
        if (factor > 0.0 && sum.pose == Pose::Standing && axis &&
            !is_across(sum.walls[i], certificate_.axes[*axis])) {
            throw Refusal{
                sum.line,
                fmt::format(
                    "expected a witness without wall {}, which polygons {} and {} see turn, got "
                    "one with it",
                    i,
                    sum.pair.earlier,
                    sum.pair.later)};
        }
        add(plane, factor, exact(sum.walls[i]));
    }
    plane.offset += Rational(sum.factors.one);
    return plane;
}

void PairCheck::check_separates(const Sum& sum) const {
    const ExactPlane plane = plane_of(sum);
    const auto refuse = [&](std::uint32_t polygon, const char* expected, const char* got) {
        throw Refusal{
            sum.line,
            fmt::format(
                "expected factors of a plane with polygon {} {} it, got a corner {} it",
                polygon,
                expected,
                got)};
    };
    if (largest(plane.normal) == 0) {
        throw Refusal{sum.line, "expected factors that make a plane, got none"};
    }
    if (!sides_.is_behind(sum.pair.earlier, plane, sum.pose)) {
        refuse(sum.pair.earlier, "behind", "before");
    }
    if (!sides_.is_before(sum.pair.later, plane, sum.pose)) {
        refuse(sum.pair.later, "before", "behind");
    }
}

void PairCheck::check_never(const Sum& sum) const {
    const Factors& factors = sum.factors;
    const bool enough = Rational(factors.earlier) + Rational(factors.later) >= 1;
    if (!enough || !sides_.is_nowhere(plane_of(sum))) {
        throw Refusal{
            sum.line,
            fmt::format(
                "expected factors that leave no eye before the planes of polygons {} and {}, got a "
                "sum that is not negative everywhere",
                sum.pair.earlier,
                sum.pair.later)};
    }
}

} // namespace octant::visuals::verify
