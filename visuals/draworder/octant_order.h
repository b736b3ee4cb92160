#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/paper_rule.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// Octant of an eye in body axes, 0 .. 7: bit 0 is set when x is negative, bit 1 when y is, bit 2
/// when z is. Zero (either sign of it) counts as positive.
int octant_of(const glm::dvec3& eye_in_body_m);

/// Signs of x, y, z as the paper writes them: octant 0 is "+++", 1 is "-++", 4 is "++-".
std::string octant_name(int octant);

/// (+-1, +-1, +-1) in the middle of the octant.
glm::dvec3 octant_signs(int octant);

/// Which polygons come into an octant's list.
enum class Listed {
    FromOctant, ///< those that face some eye of the octant at or beyond the model's radius
    FromPoint   ///< those that face the octant's viewpoint P, as printed (step 1)
};

struct PaperOptions {
    /// Viewpoint P of octant +++, in units of the model's radius R; the other octants' P have their
    /// signs. Each component > 0; with Screen::Perspective its length > 1 (asserted).
    glm::dvec3 viewpoint_radii{3.0};
    Screen screen = Screen::Parallel;
    Listed listed = Listed::FromOctant;
};

/// Painting orders by the octant of the eye.
struct OctantOrders {
    std::array<std::vector<std::uint32_t>, 8> lists; ///< by octant_of; first painted first
    int broken_cycles = 0;  ///< over all octants; 0 = every precedence that was found is kept
    int cyclic_octants = 0; ///< octants with broken cycles
};

/// Steps 1 to 6 of the paper: the 8 painting orders of a model. Where the paper leaves the order
/// free the lower polygon number comes first. Time grows with the square of the polygons listed.
OctantOrders
paper_orders(const models::polygons::PolygonModel& model, const PaperOptions& options = {});

/// The eye in body axes, metres: inverse(T R) * eye for an aircraft at `position_m` in the world
/// with the attitude `body_to_world` (unit). Its octant is the run-time step of the paper,
/// equations (33)-(36).
glm::dvec3
eye_in_body(const glm::dvec3& eye_m, const glm::dvec3& position_m, const glm::dquat& body_to_world);

} // namespace octant::visuals::draworder
