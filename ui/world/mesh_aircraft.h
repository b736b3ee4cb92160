#pragma once

#include "models/meshfile/level_chain.h"
#include "models/meshfile/rotating_model.h"
#include "models/polygons/polygon_model.h"
#include "visuals/planning/aircraft_model.h"
#include "visuals/refine/progressive_mesh.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::world {

/// An aircraft that comes as a mesh, in body axes: either levels of detail or a hierarchy, and
/// polygons for far away.
struct MeshAircraft {
    /// Levels of detail, the finest first; none where there is a hierarchy.
    std::vector<models::meshfile::ChainLevel> levels;
    /// Null where there are levels.
    std::shared_ptr<const visuals::refine::ProgressiveMesh> hierarchy;
    /// What turns beside the hierarchy; its pivots are those of the polygons.
    std::vector<models::meshfile::RotatingPart> turning;
    /// Surfaces that are seen through, which the hierarchy leaves out; often none.
    models::meshfile::TransparentSurfaces clear;
    /// What is drawn of it far away.
    models::polygons::PolygonModel polygons;
    /// No point of the polygons is farther than this from the mesh, nor of the mesh from them.
    double polygons_error_m = 0.0;
    std::vector<std::string> notes;
};

/// Reads a chain of levels (.chain), a progressive mesh (.pm) or any other mesh file, of which a
/// hierarchy is made here, or read where `cache`, a folder, has it of before; empty: none. `axes`:
/// as aircraft_axes takes them. Throws Error.
MeshAircraft read_mesh_aircraft(
    const std::filesystem::path& file,
    const std::string& axes,
    const std::filesystem::path& cache = {});

/// Gives the model that was made of its polygons the rest of a mesh aircraft.
void add_meshes(visuals::planning::AircraftModel& model, const MeshAircraft& aircraft);

} // namespace octant::ui::world
