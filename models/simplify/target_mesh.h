#pragma once

#include "models/simplify/working_surface.h"
#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// The mesh that is approximated, in working units.
struct TargetMesh {
    /// `mesh` must outlive this.
    TargetMesh(const TriangleMesh& mesh, const WorkingUnits& units)
        : places(units.places_of(mesh))
        , colours(units.colours_of(mesh))
        , triangles(mesh.triangles) {}

    std::vector<glm::dvec3> places;
    std::vector<glm::dvec3> colours; ///< One for each vertex; empty = no colours.
    std::span<const Triangle> triangles;

    bool coloured() const { return !colours.empty(); }

    std::size_t face_count() const { return triangles.size(); }

    std::array<glm::dvec3, 3> corner_places(std::uint32_t face) const {
        const auto [a, b, c] = triangles[face];
        return {places[a], places[b], places[c]};
    }
};

} // namespace octant::models::simplify
