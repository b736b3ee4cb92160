#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace octant::models::measure {

struct Extent {
    glm::dvec3 least{std::numeric_limits<double>::infinity()};
    glm::dvec3 most{-std::numeric_limits<double>::infinity()};

    void take(const glm::dvec3& point) {
        least = glm::min(least, point);
        most = glm::max(most, point);
    }

    void take(const Extent& other) {
        least = glm::min(least, other.least);
        most = glm::max(most, other.most);
    }

    double half_area() const {
        const glm::dvec3 size = most - least;
        return size.x >= 0.0 ? size.x * size.y + size.y * size.z + size.z * size.x : 0.0;
    }
};

/// A triangle while a tree is built.
struct Item {
    Extent extent;
    glm::dvec3 middle{0.0};
    std::uint32_t triangle = 0;
};

/// Orders the items into two parts, neither of them empty, and gives the size of the first: between
/// bins of the longest axis of their middles, by the surface area heuristic; below depth 64, and
/// where no bin splits, at their median. There must be two items.
std::size_t split(std::span<Item> items, int depth);

} // namespace octant::models::measure
