#include "visuals/verify/pair_check.h"

#include "visuals/verify/invalid_certificate.h"

#include <fmt/format.h>

namespace octant::visuals::verify {

/// Polygons that turn together stand still to one another.
PartAngle PairCheck::pose_of(const PolygonPair& pair) const {
    const auto& axis = certificate_.polygons[pair.earlier].axis;
    const bool together = axis && axis == certificate_.polygons[pair.later].axis;
    return together ? PartAngle::Standing : PartAngle::Turning;
}

void PairCheck::require_fixed_plane(std::uint32_t polygon, PartAngle pose, int line) const {
    if (!sides_.has_fixed_plane(polygon, pose)) {
        throw InvalidCertificate{
            line,
            fmt::format(
                "expected a witness without the plane of polygon {}, which turns, got one with it",
                polygon)};
    }
}

void PairCheck::check_earlier(const PolygonPair& pair, int line) const {
    const PartAngle pose = pose_of(pair);
    require_fixed_plane(pair.earlier, pose, line);
    if (!sides_.is_before(pair.later, certificate_.polygons[pair.earlier].plane, pose)) {
        throw InvalidCertificate{
            line,
            fmt::format(
                "expected polygon {} before the plane of polygon {}, got a corner behind it",
                pair.later,
                pair.earlier)};
    }
}

void PairCheck::check_later(const PolygonPair& pair, int line) const {
    const PartAngle pose = pose_of(pair);
    require_fixed_plane(pair.later, pose, line);
    if (!sides_.is_behind(pair.earlier, certificate_.polygons[pair.later].plane, pose)) {
        throw InvalidCertificate{
            line,
            fmt::format(
                "expected polygon {} behind the plane of polygon {}, got a corner before it",
                pair.earlier,
                pair.later)};
    }
}

void PairCheck::check(const PairStatement& statement, const RegionPlanes& region_planes) const {
    const Sum sum{statement.pair, pose_of(statement.pair), statement.factors, region_planes, statement.line};
    if (statement.kind == PairStatement::Kind::Sum) {
        check_separates(sum);
    } else if (statement.kind == PairStatement::Kind::Never) {
        check_never(sum);
    }
}

void PairCheck::check_away(
    std::uint32_t polygon, const BackFacingStatement& statement, const RegionPlanes& region_planes) const {
    check_never({{polygon, polygon}, PartAngle::Turning, statement.factors, region_planes, statement.line});
}

ExactPlane PairCheck::plane_of(const Sum& sum) const {
    ExactPlane plane;
    const auto add_front = [&](double factor, std::uint32_t polygon) {
        if (factor > 0.0) {
            require_fixed_plane(polygon, sum.pose, sum.line);
            add(plane, factor, exact(certificate_.polygons[polygon].plane));
        }
    };
    add_front(sum.factors.earlier, sum.pair.earlier);
    add_front(sum.factors.later, sum.pair.later);
    const auto& axis = certificate_.polygons[sum.pair.earlier].axis;
    for (std::size_t i = 0; i < sum.region_planes.size(); ++i) {
        const double factor = sum.factors.region_planes[i];
        if (factor > 0.0 && sum.pose == PartAngle::Standing && axis &&
            !is_across(sum.region_planes[i], certificate_.axes[*axis])) {
            throw InvalidCertificate{
                sum.line,
                fmt::format(
                    "expected a witness without wall {}, which polygons {} and {} see turn, got "
                    "one with it",
                    i,
                    sum.pair.earlier,
                    sum.pair.later)};
        }
        add(plane, factor, exact(sum.region_planes[i]));
    }
    plane.offset += Rational(sum.factors.one);
    return plane;
}

void PairCheck::check_separates(const Sum& sum) const {
    const ExactPlane plane = plane_of(sum);
    const auto refuse = [&](std::uint32_t polygon, const char* expected, const char* got) {
        throw InvalidCertificate{
            sum.line,
            fmt::format(
                "expected factors of a plane with polygon {} {} it, got a corner {} it",
                polygon,
                expected,
                got)};
    };
    if (largest(plane.normal) == 0) {
        throw InvalidCertificate{sum.line, "expected factors that make a plane, got none"};
    }
    if (!sides_.is_behind(sum.pair.earlier, plane, sum.pose)) {
        refuse(sum.pair.earlier, "behind", "before");
    }
    if (!sides_.is_before(sum.pair.later, plane, sum.pose)) {
        refuse(sum.pair.later, "before", "behind");
    }
}

void PairCheck::check_never(const Sum& sum) const {
    const StatedFactors& factors = sum.factors;
    const bool enough = Rational(factors.earlier) + Rational(factors.later) >= 1;
    if (!enough || !sides_.is_impossible(plane_of(sum))) {
        throw InvalidCertificate{
            sum.line,
            fmt::format(
                "expected factors that leave no eye before the planes of polygons {} and {}, got a "
                "sum that is not negative everywhere",
                sum.pair.earlier,
                sum.pair.later)};
    }
}

} // namespace octant::visuals::verify
