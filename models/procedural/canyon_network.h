#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace octant::models::procedural {

/// A straight piece of a stream bed. Places in metres east and north of the field's centre; bed heights above the
/// river, as even rock.
struct Reach {
    glm::dvec2 from{0.0};
    glm::dvec2 to{0.0};
    double from_m = 0.0;
    double to_m = 0.0;
    double half_width_m = 0.0;
};

/// The river that winds through a square of `field_m` and all its tributaries.
std::vector<Reach> canyon_network(double field_m, std::uint64_t seed);

} // namespace octant::models::procedural
