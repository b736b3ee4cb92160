#include "sim/base/random_generator.h"

#include <cmath>
#include <numbers>

namespace octant {

glm::dvec3 RandomGenerator::direction() {
    const double z = between(-1.0, 1.0);
    const double angle_rad = between(0.0, 2.0 * std::numbers::pi);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle_rad), across * std::sin(angle_rad), z};
}

} // namespace octant
