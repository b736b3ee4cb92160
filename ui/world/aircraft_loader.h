#pragma once

#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "ui/settings/settings.h"
#include "ui/world/input_files.h"
#include "ui/world/mesh_loader.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/planning/aircraft_model.h"
#include "visuals/planning/scene.h"
#include "visuals/refine/progressive_mesh.h"
#include "visuals/scene/settings.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
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

/// The file of a folder in which the hierarchy of a mesh is kept, named by two hashes of all that decides it: places,
/// triangles, colours and materials.
std::filesystem::path refine_mesh_cache_file(const std::filesystem::path& folder, const models::TriangleMesh& mesh);

/// make_refine_mesh(), read from the folder where the same mesh was made ready before, else made and kept there. The
/// hierarchy is the same, bit for bit, and so are the notes of what was repaired in the mesh. A file that is damaged or
/// cut off is made anew and replaced, with a note. Processes may share a folder: files appear whole.
RefineMesh cached_refine_mesh(
    const std::filesystem::path& folder, const RefineMeshOptions& input, models::TriangleMesh mesh);

/// The folder that a value of --order-cache means, made where it is missing; nothing for none. The user's own cache is
/// done without where it cannot be made or written; a folder that is named and cannot be is an Error.
std::optional<std::filesystem::path> order_cache_folder(const std::string& value);

/// Removes the files of a folder that were written first, until the rest is no larger than that. What cannot be removed
/// stays.
void remove_oldest(const std::filesystem::path& folder, std::uintmax_t max_bytes);

/// Inputs of load_aircraft(): equal inputs give equal aircraft.
struct AircraftSources {
    /// Names or files.
    std::vector<std::string> shapes;
    /// The files of the shapes and those that these name.
    std::vector<FileMtime> files;
    /// As PathSettings has them.
    std::string axes;
    visuals::scene::HiddenSurface hidden_surface{};
    visuals::draworder::OrderMethod order_method{};
    double order_seconds = 0.0;
    std::string order_cache;

    bool operator==(const AircraftSources&) const = default;
};

/// Throws Error where a file cannot be opened.
AircraftSources aircraft_sources(const settings::RunSettings& settings, std::vector<std::string> shapes);

/// The aircraft of a run, as Scene has them.
struct LoadedAircraft {
    AircraftSources inputs;
    std::vector<std::shared_ptr<const visuals::planning::AircraftModel>> models;
    std::vector<std::uint32_t> aircraft;
    std::vector<visuals::planning::FarModel> far_models;
    std::optional<std::uint32_t> cockpit;
    /// The working dials of the cockpit.
    visuals::overlay::InstrumentLayout dials;
    /// Notes for the user.
    std::vector<std::string> notes;
    /// Painting orders kept in a folder that the run names.
    std::vector<std::filesystem::path> order_files;
};

/// Loads aircraft, and the cockpit of the first one where it has one: polygon models with their painting orders, chains
/// of levels, and meshes, which get levels here. Throws Error.
LoadedAircraft load_aircraft(const AircraftSources& inputs);

} // namespace octant::ui::world
