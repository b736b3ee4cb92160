#include "tests/fuzz/ray_source.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::tests::fuzz {

namespace {

constexpr int kinds_of_eyes = 8;
constexpr int tries_for_a_facing_polygon = 12;
constexpr double share_of_rays_by_sides = 0.4;

} // namespace

long double RaySource::power(double least, double most) {
    return std::pow(10.0L, static_cast<long double>(dice_.between(least, most)));
}

const Facet& RaySource::any_facet() {
    const auto count = static_cast<double>(facets_.all.size());
    return facets_.all[static_cast<std::size_t>(dice_.next() * count)];
}

Vec RaySource::point_of(const Facet& facet) {
    Vec sum(0.0L);
    long double weights = 0.0L;
    for (const Vec& corner : facet.corners) {
        const auto even = static_cast<long double>(dice_.next());
        const long double weight = even * even + 1e-6L;
        sum += corner * weight;
        weights += weight;
    }
    return sum / weights;
}

Vec RaySource::point_by_side(const Facet& facet) {
    const std::size_t count = facet.corners.size();
    const auto side = static_cast<std::size_t>(dice_.next() * static_cast<double>(count));
    const auto share = static_cast<long double>(dice_.next());
    const Vec at = facet.corners[side] * share + facet.corners[(side + 1) % count] * (1.0L - share);
    return at + direction() * (power(-7.5, -1.0) * facets_.size_m);
}

glm::dvec3 RaySource::next_eye_m() {
    const long double size_m = facets_.size_m;
    Vec eye(0.0L);
    switch (eyes_++ % kinds_of_eyes) {
    case 0: // far away, where rays are nearly parallel
        eye = direction() * (power(1.0, 3.0) * size_m);
        break;
    case 1: // inside the bounding sphere
        eye = direction() * (std::cbrt(static_cast<long double>(dice_.next())) * 0.5L * size_m);
        break;
    case 2: // right before a polygon or behind it
        eye = point_of(any_facet()) + direction() * (power(-4.0, -1.0) * size_m);
        break;
    case 3: { // beside a polygon, close to its plane
        const Facet& facet = any_facet();
        eye = facet.middle + direction() * (power(-0.5, 0.5) * size_m);
        const long double off_m = (dice_.next() < 0.5 ? -1.0L : 1.0L) * power(-6.0, -2.0) * size_m;
        eye += facet.normal * (off_m - glm::dot(eye - facet.middle, facet.normal));
        break;
    }
    default:
        eye = direction() * (power(-0.6, 1.0) * size_m);
        break;
    }
    return glm::dvec3(eye + facets_.middle_m);
}

Vec RaySource::next_ray(const Vec& eye) {
    const Facet* facet = &any_facet();
    for (int i = 0; i < tries_for_a_facing_polygon; ++i) {
        if (glm::dot(eye - facet->middle, facet->normal) > 0.0L) { break; }
        facet = &any_facet();
    }
    const bool by_side = dice_.next() < share_of_rays_by_sides;
    const Vec target = by_side ? point_by_side(*facet) : point_of(*facet);
    return target == eye ? Vec(1.0L, 0.0L, 0.0L) : glm::normalize(target - eye);
}

} // namespace octant::tests::fuzz
