#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::planar {

/// Finds points by their places.
class VertexGrid {
public:
    explicit VertexGrid(std::span<const glm::dvec3> points);

    /// Appends the numbers of all points in a box, its sides included.
    void append_in_box(const glm::dvec3& least, const glm::dvec3& most, std::vector<std::uint32_t>& out) const;

    /// Appends the numbers of all points that may lie within `reach` of a line from one place to another; some of them
    /// more than once, and others that lie farther off.
    void append_near_segment(
        const glm::dvec3& from, const glm::dvec3& to, double reach, std::vector<std::uint32_t>& out) const;

private:
    glm::dvec3 least_{0.0};
    double cell_ = 1.0;
    glm::ivec3 cells_{1};
    std::vector<std::uint32_t> first_; ///< of each cell in numbers_, and one more
    std::vector<std::uint32_t> numbers_;
    std::vector<glm::dvec3> places_; ///< of the points in numbers_

    glm::ivec3 cell_of(const glm::dvec3& point) const;
    std::size_t index_of(const glm::ivec3& cell) const;
};

/// For each point the number of the first point within `reach` of it that has not joined another one: points with equal
/// numbers are one place. `kind` separates points that never join.
std::vector<std::uint32_t> one_place(
    std::span<const glm::dvec3> points, std::span<const std::uint32_t> kind, double reach);

} // namespace octant::models::planar
