#pragma once

#include "models/polygons/polygon_model.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace octant::models::planar {

/// The axis-parallel box around some points.
struct Box {
    glm::dvec3 min{std::numeric_limits<double>::max()};
    glm::dvec3 max{std::numeric_limits<double>::lowest()};

    void add(const glm::dvec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }

    glm::dvec3 middle() const { return min + (max - min) / 2.0; }
};

/// A uniform grid that finds points by position.
class VertexGrid {
public:
    explicit VertexGrid(std::span<const glm::dvec3> points);

    /// Appends the indices of all points in a closed box.
    void append_in_box(const glm::dvec3& min, const glm::dvec3& max, std::vector<std::uint32_t>& out) const;

    /// Appends the indices of all points within `reach` of a line segment. Some are appended more than once, and some
    /// points farther away are appended too.
    void append_near_segment(
        const glm::dvec3& from, const glm::dvec3& to, double reach, std::vector<std::uint32_t>& out) const;

private:
    glm::dvec3 min_{0.0};
    double cell_ = 1.0;
    glm::ivec3 cells_{1};
    std::vector<std::uint32_t> first_; ///< for each cell its first entry in numbers_, then the end
    std::vector<std::uint32_t> numbers_;
    std::vector<glm::dvec3> places_; ///< positions of the points in numbers_

    glm::ivec3 cell_of(const glm::dvec3& point) const;
    std::size_t index_of(const glm::ivec3& cell) const;
};

/// Merges points that are nearer than `reach`: returns for each point the index of the first point within `reach` that
/// was not merged itself. Points with different `kind` are never merged.
std::vector<std::uint32_t> one_place(
    std::span<const glm::dvec3> points, std::span<const std::uint32_t> kind, double reach);

/// The merged points (one_place) that lie on one polygon.
struct Incidence {
    std::vector<std::uint32_t> corners;  ///< of the outline, in order, without repetitions
    std::vector<std::uint32_t> touching; ///< other points within reach of plane and outline, ascending
};

/// Finds the points that lie on each polygon. `places` is the result of one_place(). Vertices with different `kind`
/// never touch each other's polygons. Lengths are in the unit of `vertices`.
std::vector<Incidence> incidences_of(const polygons::PolygonModel& model, std::span<const glm::dvec3> vertices,
    std::span<const std::uint32_t> places, std::span<const std::uint32_t> kind, double reach);

} // namespace octant::models::planar
