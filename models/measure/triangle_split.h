#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace octant::models::measure {

/// An axis-aligned bounding box in single precision; at first it holds nothing.
struct Extent {
    glm::vec3 least{std::numeric_limits<float>::infinity()};
    glm::vec3 most{-std::numeric_limits<float>::infinity()};

    void take(const glm::vec3& point) {
        least = glm::min(least, point);
        most = glm::max(most, point);
    }

    void take(const Extent& other) {
        least = glm::min(least, other.least);
        most = glm::max(most, other.most);
    }

    /// Half the surface area; 0 for an empty box.
    double half_area() const {
        const glm::dvec3 size = glm::dvec3(most) - glm::dvec3(least);
        return size.x >= 0.0 ? size.x * size.y + size.y * size.z + size.z * size.x : 0.0;
    }
};

/// A triangle while the tree is being built, with its bounding box.
struct Item {
    Extent extent;
    std::uint32_t triangle = 0;

    glm::vec3 middle() const { return 0.5F * (extent.least + extent.most); }
};

/// How many triangles a leaf of the tree holds at the most.
inline constexpr std::size_t leaf_lanes = 4;

/// Reorders the items into two parts, neither of them empty, and returns the size of the first. The
/// split is between bins on the longest axis of the centres, by the surface area heuristic; from
/// depth 64 on, and where no bin separates them, it is at the median. There must be at least two
/// items.
std::size_t split(std::span<Item> items, int depth);

} // namespace octant::models::measure
