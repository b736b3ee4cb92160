#pragma once

#include "sim/base/random_generator.h"
#include "tests/fuzz/obj_polygons.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace octant::tests::fuzz {

/// A whole number, least to most, all equally likely.
inline int whole_between(RandomGenerator& dice, int least, int most) {
    return least + static_cast<int>(dice.next() * static_cast<double>(most - least + 1));
}

/// A point of a cube around the origin.
inline glm::dvec3 point_within(RandomGenerator& dice, double half_m) {
    const double x = dice.between(-half_m, half_m);
    const double y = dice.between(-half_m, half_m);
    return {x, y, dice.between(-half_m, half_m)};
}

/// Axes of a random attitude, right-handed.
glm::dmat3 any_attitude(RandomGenerator& dice);

/// Axes whose first one points along `along`.
glm::dmat3 attitude_along(const glm::dvec3& along);

/// Adds the six outward faces of a box.
void add_box(Soup& soup, const glm::dvec3& centre, const glm::dmat3& axes, const glm::dvec3& half_m);

/// Adds a polygon of `corners` corners on a circle, its normal the attitude's third axis.
void add_disc(Soup& soup, const glm::dvec3& centre, const glm::dmat3& axes, double radius_m, int corners);

/// Adds the same polygons seen from behind.
void add_backs(Soup& soup);

} // namespace octant::tests::fuzz
