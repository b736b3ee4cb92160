#pragma once

#include "models/meshfile/mesh_builder.h"

#include <filesystem>

namespace octant::ui::reader {

// The libraries' readers: each adds all polygons of a file to a builder, nodes placed, in the file's own axes, with
// materials, normals and pictures. They run in a process of their own, which a fault of theirs may end. They throw
// Error where the library refuses the file.

/// By Assimp: FBX, Collada, 3DS, LightWave, DirectX and others.
void read_by_assimp(const std::filesystem::path& file, models::meshfile::MeshBuilder& mesh);

/// By OpenSceneGraph: OpenFlight and its own formats. Of levels of detail the finest, of switches what is on.
void read_by_osg(const std::filesystem::path& file, models::meshfile::MeshBuilder& mesh);

} // namespace octant::ui::reader
