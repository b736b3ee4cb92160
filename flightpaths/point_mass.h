#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace octant::flightpaths {

/// An aircraft as a point that lift pulls along its own up axis. The flight axes (x along the velocity, y right, z
/// down, away from the lift) are a rotation and not two angles, so that a bank beyond 90 degrees or a climb through the
/// vertical is no special case.
struct PointMass {
    /// World axes.
    glm::dvec3 position_m{0.0};
    /// Above zero.
    double speed_mps = 0.0;
    /// A unit quaternion.
    glm::dquat flight_to_world{1.0, 0.0, 0.0, 0.0};
    /// Lift over weight, in g.
    double load_factor = 1.0;
};

/// Rates that are held constant over one step.
struct PointMassControls {
    /// About the velocity; positive lowers the right wing.
    double roll_rate_radps = 0.0;
    /// The change of the load factor, g/s.
    double load_factor_rate_gps = 0.0;
    /// The change of the speed.
    double acceleration_mps2 = 0.0;
};

/// Position, track (clockwise from north), path angle (up) and bank (right) as a point mass.
PointMass point_mass_at(
    const glm::dvec3& position_m, double speed_mps, double track_rad, double climb_rad, double bank_rad = 0.0);

/// The point mass `step_s` later. Classical Runge-Kutta of fourth order; the aircraft never sideslips, so its side is
/// turned into the path by what gravity pulls sideways.
PointMass stepped(const PointMass& now, const PointMassControls& controls, double step_s);

glm::dvec3 velocity_mps(const PointMass& mass);

/// Turn rate of the track, rad/s, clockwise. Meaningless within a few degrees of the vertical.
double track_rate_radps(const PointMass& mass);

/// Attitude of the body: the flight axes with the nose raised by the angle of attack.
glm::dquat body_to_world(const PointMass& mass, double angle_of_attack_rad);

} // namespace octant::flightpaths
