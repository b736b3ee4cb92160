#pragma once

#include "sim/trajectory.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::planning {

/// The path of an aircraft as it is drawn: points at even times, and where its legs begin. World
/// axes.
struct DrawnPath {
    struct Point {
        glm::dvec3 position_m{0.0};
        glm::dvec3 right{1.0, 0.0, 0.0}; ///< unit vector along the wings
    };

    struct Leg {
        std::size_t first_point = 0;
        std::string name;
    };

    double first_s = 0.0; ///< of the first point
    double step_s = 0.1;  ///< from one point to the next
    std::vector<Point> points;
    std::vector<Leg> legs; ///< by time

    /// Time of a point.
    double time_s(std::size_t point) const { return first_s + step_s * static_cast<double>(point); }
};

/// When a leg begins, and what it is called.
struct NamedTime {
    double time_s = 0.0;
    std::string name;
};

/// The path of a trajectory. Long ones have fewer points a second.
DrawnPath drawn_path(const sim::Trajectory& trajectory, std::span<const NamedTime> legs);

} // namespace octant::visuals::planning
