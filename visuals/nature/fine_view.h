#pragma once

#include "visuals/terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace octant::visuals::nature {

/// From where ground is looked at, and how finely it is sampled.
struct FineView {
    glm::dvec3 eye_m{0.0}; ///< world axes
    double spacing_m = 30.0;
    terrain::PaintOrder order = terrain::PaintOrder::BackToFront;
    /// Unit normals of planes through the eye, world axes, that point inside: what lies outside one
    /// is not halved. Zero = no plane.
    std::array<glm::vec3, 4> frustum_normals{
        glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F)};
    std::size_t most_splits = 2000; ///< triangles that may be added to the ground in a frame
    std::size_t most_things = 5000; ///< triangles of what stands on it
};

} // namespace octant::visuals::nature
