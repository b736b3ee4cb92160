#pragma once

#include "sim/trajectory.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::planning {

/// The path of an aircraft as it is drawn: points at equal intervals of time, and its legs. World axes.
struct DrawnPath {
    struct Point {
        glm::dvec3 position_m{0.0};
        /// A unit vector along the wings.
        glm::dvec3 right{1.0, 0.0, 0.0};
    };

    struct Leg {
        std::size_t first_point = 0;
        std::string name;
    };

    /// The time of the first point, and the time from one point to the next.
    double first_s = 0.0;
    double step_s = 0.1;
    std::vector<Point> points;
    /// By ascending first_point.
    std::vector<Leg> legs;

    double time_s(std::size_t point) const { return first_s + step_s * static_cast<double>(point); }
};

/// The first time of a leg, and its name.
struct NamedTime {
    double time_s = 0.0;
    std::string name;
};

/// The path of a trajectory. A long one gets fewer points a second.
DrawnPath drawn_path(const sim::Trajectory& trajectory, std::span<const NamedTime> legs);

} // namespace octant::visuals::planning
