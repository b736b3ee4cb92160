#pragma once

#include "models/triangle_mesh.h"

#include <string>

namespace octant::tests {

/// The unit cube: 8 vertices, 12 triangles, outwards.
models::TriangleMesh cube();

/// The cube with a colour a vertex (parts of n/255), six corner normals and two materials.
models::TriangleMesh coloured_cube();

/// Four triangles.
models::TriangleMesh tetrahedron();

/// What is wrong with a mesh's indices and lists; empty for a sound one.
std::string index_fault(const models::TriangleMesh& mesh);

/// Why a mesh is no oriented manifold (perhaps with boundary); empty when it is one. Slow and simple: apart from the
/// code that makes manifolds.
std::string manifold_fault(const models::TriangleMesh& mesh);

} // namespace octant::tests
