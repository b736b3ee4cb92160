#pragma once

#include "visuals/terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <string>

namespace octant::ui::terrain {

/// A mesh as a PLY file: world coordinates in double precision, triangles counter-clockwise from above. `eye_m`: what
/// the mesh is relative to.
std::string ply_of(const visuals::terrain::GroundMesh& mesh, const glm::dvec3& eye_m, bool ascii);

} // namespace octant::ui::terrain
