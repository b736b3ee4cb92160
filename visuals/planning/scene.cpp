#include "visuals/planning/scene.h"

#include <algorithm>
#include <cmath>

namespace octant::visuals::planning {

namespace {

constexpr double default_step_s = 0.1;
constexpr double max_points = 4000.0;

} // namespace

DrawnPath drawn_path(const sim::Trajectory& trajectory, std::span<const NamedTime> legs) {
    DrawnPath path;
    const double length_s = trajectory.end_s() - trajectory.start_s();
    path.first_s = trajectory.start_s();
    path.step_s = std::max(default_step_s, length_s / max_points);
    const auto last = static_cast<std::size_t>(std::floor(length_s / path.step_s));
    for (std::size_t i = 0; i <= last; ++i) {
        const sim::AircraftState state = trajectory.state_at(path.time_s(i));
        path.points.push_back({state.position_m, state.body_to_world * glm::dvec3(0.0, 1.0, 0.0)});
    }
    for (const NamedTime& leg : legs) {
        const double place = std::max((leg.time_s - path.first_s) / path.step_s, 0.0);
        path.legs.push_back({std::min(static_cast<std::size_t>(std::lround(place)), last), leg.name});
    }
    return path;
}

} // namespace octant::visuals::planning
