#pragma once

#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/texture_store.h"
#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "ui/world/aircraft_frame.h"
#include "visuals/planning/aircraft_model.h"
#include "visuals/refine/mesh_creases.h"
#include "visuals/refine/mesh_textures.h"
#include "visuals/refine/progressive_mesh.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::world {

/// An aircraft of a mesh file, in body axes: levels of detail or a vertex hierarchy, and polygons for far away.
struct MeshAircraft {
    /// Levels of detail, the finest first; none where there is a hierarchy.
    std::vector<models::meshfile::ChainLevel> levels;
    /// Null where there are levels.
    std::shared_ptr<const visuals::refine::ProgressiveMesh> hierarchy;
    /// The pictures on the hierarchy; null where there are none.
    std::shared_ptr<const visuals::refine::MeshTextures> textures;
    /// Of the hierarchy, in body axes; null where it has none.
    std::shared_ptr<const visuals::refine::MeshCreases> creases;
    /// Parts that turn or move, which the hierarchy leaves out; the pivots of those that turn are those of the
    /// polygons.
    std::vector<models::meshfile::RotatingPart> turning;
    /// Transparent surfaces, which the hierarchy leaves out; often none.
    models::polygons::PolygonModel glass;
    /// Drawn in place of the mesh far away.
    models::polygons::PolygonModel polygons;
    /// No point of the polygons is farther than this from the mesh, nor of the mesh from them.
    double polygons_error_m = 0.0;
    std::vector<std::string> notes;
};

/// Reads a chain of levels (.chain), a progressive mesh (.pm) or any other mesh file. A hierarchy is made of the last,
/// or read from the folder `cache` if that has it; empty: no cache. `textures`: where pictures on its surfaces are
/// kept; null: they become colours of vertices. Throws Error.
MeshAircraft read_mesh_aircraft(const std::filesystem::path& file, const AircraftFrameSettings& frame,
    const std::filesystem::path& cache, std::shared_ptr<models::meshfile::TextureStore> textures = {});

/// Adds levels or hierarchy and turning parts to the model that was made of the aircraft's polygons.
void add_meshes(visuals::planning::AircraftModel& model, const MeshAircraft& aircraft);

} // namespace octant::ui::world
