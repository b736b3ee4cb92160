#pragma once

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <limits>

namespace octant::models::heights {

/// The rectangle along the axes around points; without points it has no area.
struct MapRectangle {
    glm::dvec2 least{std::numeric_limits<double>::infinity()};
    glm::dvec2 most{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec2& point) {
        least = glm::min(least, point);
        most = glm::max(most, point);
    }

    glm::dvec2 size() const { return most - least; }

    double area() const {
        const glm::dvec2 sides = glm::max(size(), glm::dvec2(0.0));
        return sides.x * sides.y;
    }
};

} // namespace octant::models::heights
