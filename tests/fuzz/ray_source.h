#pragma once

#include "sim/base/random_generator.h"
#include "tests/fuzz/facets.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace octant::tests::fuzz {

/// Eyes and targets where painting orders go wrong: eyes on all scales and near the planes at which facings and cells
/// change, targets all over polygons and close to their sides.
class RaySource {
public:
    /// Keeps a reference to `facets`.
    RaySource(const Facets& facets, std::uint64_t seed) : facets_(facets), dice_(seed) {}

    /// The next eye, body axes, metres.
    glm::dvec3 next_eye_m();

    /// A direction (unit) from an eye (from the model's middle) to a polygon that faces it, if one is found quickly.
    Vec next_ray(const Vec& eye);

private:
    const Facet& any_facet();
    Vec point_of(const Facet& facet);
    Vec point_by_side(const Facet& facet);
    /// 10 to a power that is spread evenly.
    long double power(double least, double most);

    Vec direction() { return Vec(dice_.direction()); }

    const Facets& facets_;
    RandomGenerator dice_;
    int eyes_ = 0;
};

} // namespace octant::tests::fuzz
