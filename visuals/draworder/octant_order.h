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

// Octants of the eye in body axes are numbered 0 to 7: bit 0 is set where x is negative, bit 1
// where y is, and bit 2 where z is. Zero, of either sign, counts as positive.

/// The signs of x, y, z as the paper writes them: octant 0 is "+++", 1 is "-++", 4 is "++-".
std::string octant_name(int octant);

/// The direction (+-1, +-1, +-1) in the middle of an octant.
glm::dvec3 octant_signs(int octant);

/// Which polygons are put into an octant's list.
enum class ListingRule {
    FromOctant, ///< Those that face some eye of the octant at or beyond the model's radius.
    FromPoint   ///< Those that face the octant's viewpoint P, as printed (step 1).
};

/// How the paper is read where it leaves a choice.
struct PaperOrderOptions {
    /// The viewpoint P of octant +++, in units of the model's radius R; for the other octants its
    /// signs change. Each component must be > 0, and with Screen::Perspective its length > 1
    /// (asserted).
    glm::dvec3 viewpoint_radii{3.0};
    ScreenProjection screen = ScreenProjection::Parallel;
    ListingRule listed = ListingRule::FromOctant;
};

/// The painting orders of the eight octants.
struct OctantOrders {
    std::array<std::vector<std::uint32_t>, 8> lists; ///< Indexed by octant; first painted first.
    /// The number of broken cycles in all octants; 0 = every precedence is kept.
    int broken_cycles = 0;
    int cyclic_octants = 0; ///< The number of octants with broken cycles.
};

/// Steps 1 to 6 of the paper: the 8 painting orders of a model. Where the paper leaves the order
/// free, the lower polygon number comes first. The time grows with the square of the polygons
/// listed.
OctantOrders
paper_orders(const models::polygons::PolygonModel& model, const PaperOrderOptions& options = {});

/// The eye in body axes, metres: inverse(T R) * eye for an aircraft at `position_m` in the world
/// with the attitude `body_to_world` (a unit quaternion). Its octant is the paper's run-time step,
/// equations (33)-(36).
glm::dvec3
eye_in_body(const glm::dvec3& eye_m, const glm::dvec3& position_m, const glm::dquat& body_to_world);

} // namespace octant::visuals::draworder
