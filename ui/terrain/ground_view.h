#pragma once

#include "models/heights/import_options.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/settings.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/mesh_measurement.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace octant::ui::terrain {

/// Which terrain, seen from where and how large: what every command about one mesh is told.
struct GroundViewOptions {
    std::string terrain;
    models::heights::ImportOptions files; ///< what files do not say
    std::optional<glm::dvec3> eye_m;
    std::optional<glm::dvec3> look_m;
    glm::ivec2 size_px{1280, 720};
    double fov_deg = 45.0;       ///< vertical
    bool curved = false;         ///< whether the ground is lowered by d^2 / 2R
    double earth_radius_m = 0.0; ///< R of the loaded ground; 0 = flat
};

/// Which mesh of the ground is made, and how finely.
struct GroundMeshOptions {
    visuals::scene::GroundMetric mesh = visuals::scene::GroundMetric::ScreenError;
    visuals::scene::GroundFans fans = visuals::scene::GroundFans::Partial;
    std::optional<double> roughness_c; ///< as in Settings
    bool geomorphs = false;
    std::optional<double> error_px;
    std::optional<int> triangles;
    std::optional<double> resolution_c;
};

/// Eye and look as options say. Throws Error when one is missing or both are the same point.
visuals::scene::Camera camera_of(const GroundViewOptions& options);

/// What a mesher is told of a camera.
visuals::terrain::MeshView mesh_view(const visuals::scene::Camera& camera, const GroundViewOptions& options);

/// What measures are told of it; near plane at 10 m.
visuals::terrain::PerspectiveView picture_view(const visuals::scene::Camera& camera, const glm::ivec2& size_px);

} // namespace octant::ui::terrain
