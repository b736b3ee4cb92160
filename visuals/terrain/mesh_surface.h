#pragma once

#include "visuals/terrain/ground_mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::terrain {

/// The surface that a mesh draws, to be asked by position in plan. Its memory is reused from mesh to mesh; the mesh
/// itself is not needed after set_mesh().
class MeshSurface {
public:
    /// Takes a mesh whose positions are relative to `eye_m`.
    void set_mesh(const GroundMesh& mesh, const glm::dvec3& eye_m);

    /// The number of the triangle above or below a position, one of them at an edge; nothing where there is no mesh.
    std::optional<std::uint32_t> triangle_at(double x_m, double y_m) const;

    /// The world height of the surface; nothing where there is no mesh.
    std::optional<double> height_at(double x_m, double y_m) const;

    /// The first point at which the way between two world positions meets the mesh, as a share of that way; nothing if
    /// it does not.
    std::optional<double> first_hit(const glm::dvec3& from_m, const glm::dvec3& to_m) const;

private:
    /// A triangle in a cell. The size of cells halves from level to level; a triangle is entered into the cells of the
    /// smallest size that is as large as the triangle: four at most.
    struct Entry {
        std::uint32_t level = 0;
        std::int32_t column = 0;
        std::int32_t row = 0;
        std::uint32_t triangle = 0;
        std::uint32_t next = 0; ///< The next entry of the same hash slot; none = end.
    };

    static constexpr int levels = 32;

    struct Corners {
        glm::dvec3 a;
        glm::dvec3 b;
        glm::dvec3 c;
    };

    Corners corners_of(std::uint32_t triangle) const;
    std::size_t slot_of(std::uint32_t level, std::int32_t column, std::int32_t row) const;
    void add(std::uint32_t triangle);
    bool covers(std::uint32_t triangle, const glm::dvec2& place_m) const;

    glm::dvec3 eye_m_{0.0};
    std::uint32_t levels_used_ = 0;      ///< A bit mask of levels.
    std::vector<glm::dvec3> vertices_m_; ///< Relative to the eye.
    std::vector<std::uint32_t> indices_;
    std::vector<std::uint32_t> slots_; ///< For each hash slot its first entry.
    std::vector<Entry> entries_;
};

} // namespace octant::visuals::terrain
