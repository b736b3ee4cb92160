#pragma once

#include "models/meshfile/gltf_data.h"
#include "models/meshfile/affine_transform.h"

#include <cstddef>
#include <vector>

namespace octant::models::meshfile {

/// A mesh of a glTF file, by its number, where a node shows it.
struct PlacedMesh {
    std::size_t mesh = 0;
    AffineTransform placement;
};

/// What the default scene shows, else the first one, else the nodes that are nobody's child, else
/// (a file without nodes) all meshes as they are. Throws Error for nodes that are met twice.
std::vector<PlacedMesh> placed_meshes(const GltfData& data);

} // namespace octant::models::meshfile
