#pragma once

#include "visuals/draworder/order_method.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/terrain/terrain_lod.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace octant::visuals::scene {

/// How hidden surfaces of aircraft are removed.
enum class HiddenSurface {
    /// Polygons are painted in precomputed order, without depth anywhere.
    Octant,
    /// A depth buffer of 32-bit floats, reversed.
    DepthBuffer,
    /// Back faces are removed and polygons painted in file order: the 1989 paper's fast, wrong way.
    BackFace
};

enum class View { Chase, Cockpit, Tower, Orbit, Free };
enum class Palette { Temperate, Arid };
enum class GroundShading { Auto, Vertex, Texture };
enum class AircraftShading { Flat, Gouraud, Hybrid, Phong };
enum class HybridRule { Error, Paper };

/// What the colours of aircraft show.
enum class ModelDisplay {
    /// Aircraft have their own colours.
    None,
    /// Smooth polygons have one colour, flat ones another.
    Shading,
    /// Each halving of the surface's error has a colour; an exact surface is white.
    Levels
};

/// The settings that follow the clock: they then depend on the times of earlier frames.
struct Adaptation {
    /// Whether the triangles of the ground follow the clock; for exact control only.
    bool terrain = false;
    /// Whether the share of smooth polygons does; for hybrid shading only.
    bool shading = false;

    bool operator==(const Adaptation&) const = default;
};

/// The camera of a picture, and its size.
struct ViewSettings {
    View kind = View::Chase;
    /// The eye of the tower and free views.
    std::optional<glm::dvec3> eye_m;
    /// What the free view looks at.
    std::optional<glm::dvec3> look_m;
    /// Vertical. Nothing = 45; in the tower view the aircraft's distance decides.
    std::optional<double> fov_deg;
    /// Chase and orbit: the turn of the eye around the aircraft, clockwise from above and upwards. Other views: the
    /// turn of the direction of view, right and up.
    double azimuth_deg = 0.0;
    double elevation_deg = 0.0;
    /// Chase and orbit: divides the distance of the eye. Other views: magnification.
    double zoom = 1.0;
    /// A second view, drawn small into a corner of the picture.
    std::optional<View> inset;
    /// Whether the cockpit view has a head-up display.
    bool head_up_display = true;
    /// Whether the first aircraft's path is shown, with its legs, a scale and a north mark.
    bool path_ribbon = false;
    glm::ivec2 size_px{1280, 720};
    /// Samples a pixel; nothing = the renderer's own number.
    std::optional<int> samples;

    bool operator==(const ViewSettings&) const = default;
};

/// The removal of hidden surfaces of aircraft, and their level of detail.
struct SurfaceSettings {
    HiddenSurface hidden_surface = HiddenSurface::Octant;
    draworder::OrderMethod order_method = draworder::OrderMethod::Exact;
    /// The approximate time limit of the search for an order, on one core.
    double order_seconds = 4.0;
    /// The cache of orders: a folder, "user" for the user's own cache, or "none". Does not change pictures.
    std::string order_cache = "user";
    /// Whether aircraft, trees and houses cast shadows on the ground.
    bool shadows = true;
    /// What is seen around aircraft. Nothing: rotors and propellers that turn fast are discs. True: exhaust,
    /// afterburners and vapour, too. False: none of these; the blades of rotors are drawn as they stand.
    std::optional<bool> effects = std::nullopt;
    /// The largest error of a mesh's level of detail on the screen.
    double aircraft_error_px = 1.0;
    /// Whether the pictures on aircraft are drawn; else they become colours of vertices.
    bool textures = true;

    bool operator==(const SurfaceSettings&) const = default;
};

/// Which polygons of aircraft are smooth.
struct ShadingSettings {
    AircraftShading kind = AircraftShading::Hybrid;
    HybridRule rule = HybridRule::Error;
    /// The share of polygons that are smooth; for hybrid shading only.
    double smooth_share = 1.0;
    /// The paper's device speed, in place of smooth_share.
    std::optional<double> device_ratio;
    /// The paper's rule: all polygons are smooth up to this distance.
    double near_m = 0.0;
    /// The paper's rule: all polygons are flat from this distance on.
    double far_m = 1000.0;
    ModelDisplay show_model = ModelDisplay::None;

    bool operator==(const ShadingSettings&) const = default;
};

/// How the ground is refined.
struct GroundSettings {
    terrain::TerrainLod lod;
    /// The triangle budget; nothing = 20,000, or unlimited where error_px is given.
    std::optional<int> triangles;
    /// By screen error: the smallest target error; nothing = 0.25.
    std::optional<double> error_px;
    /// By screen error: vertices move into place instead of jumping.
    bool geomorphs = true;
    /// Whether the next frame's ground is meshed while this one is drawn.
    bool mesh_async = true;
    /// By screen error: distant ground and aircraft sink.
    bool earth_curvature = true;
    /// By screen error: near the eye the ground has detail between its samples.
    bool near_detail = true;
    /// By screen error: trees and houses stand near the eye.
    bool scenery = true;
    /// By screen error: roads run along the valleys.
    bool roads = true;
    /// Whether there is a runway at the beginning of the path, on levelled ground.
    bool airfield = false;
    MeshDisplay show_mesh = MeshDisplay::None;

    bool operator==(const GroundSettings&) const = default;
};

/// Sky, haze, sun and the colours of the ground.
struct AirSettings {
    bool sky = true;
    /// The visibility at the mean height of the ground; 0 = no haze.
    double visibility_m = 30000.0;
    /// The density of the haze falls to 1/e over this height; 0 = the same density at all heights.
    double haze_height_m = 2500.0;
    /// The colour of an empty picture, and of the haze when the sun is 35 degrees high.
    glm::vec3 background{158.0F / 255.0F, 184.0F / 255.0F, 214.0F / 255.0F};
    /// Local solar time, "YYYY-MM-DDTHH:MM". The scene's loader computes the direction of the sun from it and the
    /// ground's latitude.
    std::optional<std::string> time;
    /// The direction of the sun, clockwise from north.
    double sun_azimuth_deg = 225.0;
    double sun_elevation_deg = 35.0;
    /// Whether the relief casts shadows, and hollows have less light.
    bool relief_shadows = true;
    /// The share of the sky that a layer of clouds covers.
    double clouds = 0.0;
    /// Above datum. Nothing = well above the highest ground.
    std::optional<double> cloud_height_m;
    /// Ground at or below this height is drawn as water.
    double water_level_m = 0.0;
    /// The colours of the ground; nothing = arid for the canyon, else temperate.
    std::optional<Palette> palette;
    /// Auto: texture under a drape or on a GPU, else vertex.
    GroundShading ground_shading = GroundShading::Auto;
    /// An image file that covers the ground.
    std::optional<std::string> drape;

    bool operator==(const AirSettings&) const = default;
};

/// All settings of the picture of a scene.
struct Settings {
    ViewSettings view;
    SurfaceSettings surface;
    ShadingSettings shading;
    GroundSettings ground;
    AirSettings air;
    Adaptation adapt;

    bool operator==(const Settings&) const = default;
};

/// The triangle budget of the ground; with Adaptation::terrain that of the first frame. unlimited_triangles where the
/// error alone decides.
inline int triangle_target(const Settings& settings) {
    const bool uses_error_only = settings.ground.error_px && !settings.adapt.terrain;
    return settings.ground.triangles.value_or(uses_error_only ? terrain::unlimited_triangles : 20000);
}

} // namespace octant::visuals::scene
