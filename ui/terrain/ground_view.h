#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"
#include "ui/settings/settings.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/settings.h"
#include "visuals/terrain/bisection_tiles.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_query.h"
#include "visuals/terrain/mesh_measurement.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace octant::ui::terrain {

/// Terrain, eye point and picture size: options of all commands about one mesh.
struct GroundViewOptions : settings::EyeView {
    std::string terrain;
    models::heights::ImportOptions files; ///< what files do not say
    bool curved = false;                  ///< whether the ground is lowered by d^2 / 2R
    double earth_radius_m = 0.0;          ///< R of the loaded ground; 0 = flat
};

/// Kind and resolution of a terrain mesh.
struct GroundMeshOptions {
    visuals::terrain::TerrainLod lod; ///< of its control only resolution_c counts
    bool geomorphs = false;
    std::optional<double> error_px;
    std::optional<int> triangles;
};

/// Eye and look as options say. Throws Error when one is missing or both are the same point.
visuals::scene::Camera camera_of(const GroundViewOptions& options);

/// The view of a camera as meshers take it.
visuals::terrain::MeshView mesh_view(const visuals::scene::Camera& camera, const GroundViewOptions& options);

/// The view of a camera as error measurements take it; near plane at 10 m.
visuals::terrain::PerspectiveView picture_view(const visuals::scene::Camera& camera, const glm::ivec2& size_px);

/// A loaded terrain: a height field read into memory, or an imported ground file that is memory-mapped.
class LoadedGround {
public:
    explicit LoadedGround(models::heights::HeightField field) : ground_(std::move(field)) {}

    explicit LoadedGround(visuals::terrain::GroundTiles tiles) : ground_(std::move(tiles)) {}

    /// A view of the samples; this object must outlive it and not move.
    visuals::terrain::GroundSamples samples() const;

    /// Null for an imported ground file.
    const models::heights::HeightField* field() const { return std::get_if<models::heights::HeightField>(&ground_); }

    /// By which it curves: that of the planet on which it lies, of the earth for made ground.
    double mean_radius_m() const;

    /// What screen-error meshes are made of: built here from a field that was read.
    visuals::terrain::GroundTiles tiles() const;

private:
    std::variant<models::heights::HeightField, visuals::terrain::GroundTiles> ground_;
};

/// By name (hills, canyon), imported, or maps as world::load_height_field takes them; says the maps' notes on stderr
/// unless `quiet`. Throws Error.
LoadedGround load_ground(
    const std::string& name_or_file, const models::heights::ImportOptions& options, bool quiet = false);

/// The terrain of these options, whose `earth_radius_m` is set where the ground is to be curved. Says on stderr, unless
/// `quiet`, where the eye point lies under the ground.
LoadedGround load_ground(GroundViewOptions& options, bool quiet = false);

/// A row of a table of eye points.
struct EyePoint {
    int line = 0; ///< of the file
    double x_m = 0.0;
    double y_m = 0.0;
    double agl_m = 0.0;
    double heading_deg = 0.0; ///< clockwise from north
    double pitch_deg = 0.0;   ///< upward
};

/// Rows of a table with the columns map,x_m,y_m,agl_m,heading_deg,pitch_deg whose first field is `map`. Lines that
/// begin with # and the header line are passed over. Throws Error when a row is wrong or none is of that map.
std::vector<EyePoint> read_eye_points(const std::filesystem::path& file, const std::string& map);

/// The camera of a point over a ground. Throws Error when there is no ground below it.
visuals::scene::Camera camera_at(const EyePoint& point, const visuals::terrain::GroundSamples& ground, double fov_deg);

} // namespace octant::ui::terrain
