#include "ui/terrain/ground_view.h"

#include "sim/base/error.h"
#include "sim/base/units.h"
#include "ui/settings/read_option.h"
#include "visuals/terrain/ground_query.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

namespace octant::ui::terrain {

namespace scene = visuals::scene;
namespace terrain = visuals::terrain;

namespace {

/// The lens for which the paper's C is meant.
constexpr double reference_fov_rad = rad_from_deg(45.0);

double aspect_of(const glm::ivec2& size_px) {
    return static_cast<double>(size_px.x) / size_px.y;
}

} // namespace

void add_terrain_argument(CLI::App& command, GroundViewOptions& options) {
    command.add_option("terrain", options.terrain, "hills, canyon or a file that GDAL reads")
        ->type_name("NAME|FILE")
        ->required();
    settings::add_read_option(
        command,
        {"terrain-spacing", "METRES", "sample spacing of files that do not say", 0.01, 1e5},
        options.spacing_m)
        ->default_str("30");
}

void add_view_options(CLI::App& command, GroundViewOptions& options) {
    settings::add_read_option(
        command,
        {"eye",
         "X,Y,Z",
         "eye point: metres east, north of the map centre, up from datum",
         -1e7,
         1e7},
        options.eye_m);
    settings::add_read_option(
        command,
        {"look", "X,Y,Z", "a point in the middle of the picture", -1e7, 1e7},
        options.look_m);
    settings::add_read_option(
        command, {"size", "WIDTHxHEIGHT", "picture size in pixels", 16, 16384}, options.size_px)
        ->default_str("1280x720");
    settings::add_read_option(
        command, {"fov", "DEGREES", "vertical field of view", 0.1, 170.0}, options.fov_deg)
        ->default_str("45");
    command.add_flag_callback(
        "--curved",
        [&options] { options.earth_radius_m = terrain::earth_radius_m; },
        "lower the ground by d^2 / 2R as it is in flight (screen-error meshes)");
}

void add_mesh_options(CLI::App& command, GroundMeshOptions& options, bool with_detail) {
    settings::add_read_option(
        command,
        {"mesh", "KIND", "what decides: screen-error, midpoint or printed roughness"},
        options.mesh)
        ->default_str(settings::text_of(options.mesh));
    settings::add_read_option(
        command, {"fans", "KIND", "of midpoint and printed: partial or full"}, options.fans)
        ->default_str("partial");
    settings::add_read_option(
        command,
        {"roughness-c", "C", "of midpoint and printed: weight of roughness [20; 5]", 0.0, 1e5},
        options.roughness_c);
    command.add_flag(
        "--geomorphs,!--no-geomorphs",
        options.geomorphs,
        "vertices on their way as drawn in flight; else each at its own height [no]");
    if (!with_detail) {
        return;
    }
    settings::add_read_option(
        command,
        {"error-px", "PIXELS", "refine to this error (screen-error)", 0.001, 1e4},
        options.error_px);
    settings::add_read_option(
        command, {"triangles", "N", "refine to this many triangles", 1, 1e8}, options.triangles);
    settings::add_read_option(
        command,
        {"resolution-c", "C", "refine to this C (midpoint, printed)", 1.0, 1e5},
        options.resolution_c);
}

scene::Camera camera_of(const GroundViewOptions& options) {
    if (!options.eye_m || !options.look_m) {
        throw Error("expected --eye X,Y,Z and --look X,Y,Z, got not both");
    }
    if (*options.eye_m == *options.look_m) {
        throw Error("--look: expected another point than --eye, got the same");
    }
    scene::Camera camera = scene::camera_looking_at(*options.eye_m, *options.look_m);
    camera.vertical_fov_rad = rad_from_deg(options.fov_deg);
    return camera;
}

terrain::MeshView mesh_view(const scene::Camera& camera, const GroundViewOptions& options) {
    terrain::MeshView view;
    view.eye_m = camera.eye_m;
    view.frustum_normals = scene::frustum_normals(camera, aspect_of(options.size_px));
    view.magnification =
        std::max(1.0, std::tan(reference_fov_rad / 2.0) / std::tan(camera.vertical_fov_rad / 2.0));
    view.focal_px = scene::focal_px(camera, options.size_px.y);
    view.earth_radius_m = options.earth_radius_m;
    return view;
}

terrain::PictureView picture_view(const scene::Camera& camera, const glm::ivec2& size_px) {
    terrain::PictureView view;
    view.eye_m = camera.eye_m;
    view.right = camera.view_to_world * glm::dvec3(1.0, 0.0, 0.0);
    view.up = camera.view_to_world * glm::dvec3(0.0, 1.0, 0.0);
    view.ahead = camera.view_to_world * glm::dvec3(0.0, 0.0, -1.0);
    view.focal_px = scene::focal_px(camera, size_px.y);
    view.half_width_px = size_px.x / 2.0;
    view.half_height_px = size_px.y / 2.0;
    return view;
}

} // namespace octant::ui::terrain
