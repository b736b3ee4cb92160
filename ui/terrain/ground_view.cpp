#include "ui/terrain/ground_view.h"

#include "sim/base/error.h"
#include "sim/base/units.h"

#include <algorithm>
#include <cmath>

namespace octant::ui::terrain {

namespace scene = visuals::scene;
namespace terrain = visuals::terrain;

namespace {

/// The lens for which the paper's C is meant.
constexpr double reference_fov_rad = rad_from_deg(45.0);

double aspect_of(const glm::ivec2& size_px) { return static_cast<double>(size_px.x) / size_px.y; }

} // namespace

scene::Camera camera_of(const GroundViewOptions& options) {
    if (!options.eye_m || !options.look_m) { throw Error("expected --eye X,Y,Z and --look X,Y,Z, got not both"); }
    if (*options.eye_m == *options.look_m) { throw Error("--look: expected another point than --eye, got the same"); }
    scene::Camera camera = scene::camera_looking_at(*options.eye_m, *options.look_m);
    camera.vertical_fov_rad = rad_from_deg(options.fov_deg);
    return camera;
}

terrain::MeshView mesh_view(const scene::Camera& camera, const GroundViewOptions& options) {
    terrain::MeshView view;
    view.eye_m = camera.eye_m;
    view.frustum_normals = scene::frustum_normals(camera, aspect_of(options.size_px));
    view.magnification = std::max(1.0, std::tan(reference_fov_rad / 2.0) / std::tan(camera.vertical_fov_rad / 2.0));
    view.focal_px = scene::focal_px(camera, options.size_px.y);
    view.ahead = scene::view_direction(camera);
    view.corner_cos = scene::corner_cos(camera, aspect_of(options.size_px));
    view.earth_radius_m = options.earth_radius_m;
    return view;
}

terrain::PerspectiveView picture_view(const scene::Camera& camera, const glm::ivec2& size_px) {
    terrain::PerspectiveView view;
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
