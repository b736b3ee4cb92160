#pragma once

#include "models/meshfile/mesh_builder.h"

#include <filesystem>

namespace octant::ui::reader {

// Each reader adds all polygons of a file to a builder, with node transforms applied, in the file's axes, with
// materials, normals and pictures. Readers run in a separate process, because a library may crash. They throw Error if
// the library refuses the file.

/// By Assimp: FBX, Collada, 3DS, LightWave, DirectX and others; y up, in metres where the file states its unit.
void read_by_assimp(const std::filesystem::path& file, models::meshfile::MeshBuilder& mesh);

/// By OpenSceneGraph: OpenFlight and its own formats. Reads the finest level of detail and the active children of
/// switches.
void read_by_osg(const std::filesystem::path& file, models::meshfile::MeshBuilder& mesh);

/// Writes a glTF file whose meshes Draco has packed as a plain .glb file. Throws Error.
void unpack_draco(const std::filesystem::path& file, const std::filesystem::path& out);

} // namespace octant::ui::reader
