#include "flightpaths/reprojected_path.h"

#include <glm/gtc/quaternion.hpp>

#include <utility>
#include <vector>

namespace octant::flightpaths {

sim::Trajectory reprojected(const sim::Trajectory& path, const EarthFrame& from, const EarthFrame& to) {
    const glm::dvec2 origin_m = to.local_from_geo(from.origin());
    const double stretch = to.origin().ellipsoid.semi_major_m / from.origin().ellipsoid.semi_major_m;
    std::vector<sim::AircraftState> samples(path.samples().begin(), path.samples().end());
    for (sim::AircraftState& state : samples) {
        const GeoPosition place = from.geo_from_local(glm::dvec2(state.position_m));
        const FramePosition there = to.place_of(place);
        const double turn_rad = there.north_bearing_rad - from.place_of(place).north_bearing_rad;
        const glm::dquat turn = glm::angleAxis(-turn_rad, glm::dvec3(0.0, 0.0, 1.0));
        state.position_m = glm::dvec3(there.east_north_m - origin_m, state.position_m.z);
        state.velocity_mps = turn * (state.velocity_mps * glm::dvec3(stretch, stretch, 1.0));
        state.body_to_world = glm::normalize(turn * state.body_to_world);
    }
    return sim::Trajectory(std::move(samples));
}

} // namespace octant::flightpaths
