#pragma once

#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/texture_store.h"
#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "visuals/planning/aircraft_model.h"
#include "visuals/refine/mesh_textures.h"
#include "visuals/refine/progressive_mesh.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::world {

/// Where the axes of an aircraft's file point, and how that is known.
struct AircraftAxes {
    /// Default: the shape does not say; the axes are those that scenes of the format mostly have, else x right, y up, z
    /// back.
    enum class AxesSource { Given, Format, Guess, Default };

    models::polygons::FileAxes axes;
    AxesSource source = AxesSource::Default;
};

/// The setting --axes: "auto", or directions such as "right,up,back". With "auto" the format decides, then the shape,
/// whose top is towards +z where the format says so. `mesh` is the aircraft in its file's axes. Throws Error.
AircraftAxes aircraft_axes(
    const std::string& setting, const std::filesystem::path& file, const models::TriangleMesh& mesh);

/// Throws Error unless it is "auto" or directions that aircraft_axes takes.
void check_axes(const std::string& setting);

/// "nose towards -x, up +y: guessed from the shape".
std::string axes_text(const AircraftAxes& axes);

/// Appends a note where nose and top were found, unless the setting or the format says it.
void note_axes(const AircraftAxes& axes, const std::filesystem::path& file, std::vector<std::string>& notes);

/// An aircraft of a mesh file, in body axes: levels of detail or a vertex hierarchy, and polygons for far away.
struct MeshAircraft {
    /// Levels of detail, the finest first; none where there is a hierarchy.
    std::vector<models::meshfile::ChainLevel> levels;
    /// Null where there are levels.
    std::shared_ptr<const visuals::refine::ProgressiveMesh> hierarchy;
    /// The pictures on the hierarchy; null where there are none.
    std::shared_ptr<const visuals::refine::MeshTextures> textures;
    /// Parts that turn, which the hierarchy leaves out; its pivots are those of the polygons.
    std::vector<models::meshfile::RotatingPart> turning;
    /// Transparent surfaces, which the hierarchy leaves out; often none.
    models::meshfile::TransparentSurfaces clear;
    /// Drawn in place of the mesh far away.
    models::polygons::PolygonModel polygons;
    /// No point of the polygons is farther than this from the mesh, nor of the mesh from them.
    double polygons_error_m = 0.0;
    std::vector<std::string> notes;
};

/// Reads a chain of levels (.chain), a progressive mesh (.pm) or any other mesh file. A hierarchy is made of the last,
/// or read from the folder `cache` if that has it; empty: no cache. `axes`: as aircraft_axes() takes them. `textures`:
/// where pictures on its surfaces are kept; null: they become colours of vertices. Throws Error.
MeshAircraft read_mesh_aircraft(const std::filesystem::path& file, const std::string& axes,
    const std::filesystem::path& cache, std::shared_ptr<models::meshfile::TextureStore> textures = {});

/// Adds levels or hierarchy, turning parts and transparent surfaces to the model that was made of the aircraft's
/// polygons.
void add_meshes(visuals::planning::AircraftModel& model, const MeshAircraft& aircraft);

} // namespace octant::ui::world
