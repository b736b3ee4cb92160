#pragma once

#include "visuals/draworder/order_method.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/model_display.h"

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
enum class GroundMetric { Printed, Midpoint, ScreenError };
enum class Propagation { CrackFree, Printed };
enum class GroundFans { Partial, Full };
enum class DetailControl { Exact, Damped, Previous, Printed, Fixed };
enum class Palette { Temperate, Arid };
enum class GroundShading { Auto, Vertex, Texture };
enum class AircraftShading { Flat, Gouraud, Hybrid, Phong };
enum class HybridRule { Error, Paper };

/// What follows the clock: each frame's choice then depends on how long the frames before it took.
struct Adaptation {
    /// Whether the triangles of the ground follow the clock; for exact control only.
    bool terrain = false;
    /// Whether the share of smooth polygons does; for hybrid shading only.
    bool shading = false;

    bool operator==(const Adaptation&) const = default;
};

/// From where a picture is seen, and how large it is.
struct ViewSettings {
    View kind = View::Chase;
    /// The eye of the tower and free views.
    std::optional<glm::dvec3> eye_m;
    /// What the free view looks at.
    std::optional<glm::dvec3> look_m;
    /// Vertical. Nothing: 45, and the tower zooms in on the aircraft.
    std::optional<double> fov_deg;
    /// Chase and orbit: the eye turned around the aircraft, clockwise from above and upwards; else the look turned
    /// right and up.
    double azimuth_deg = 0.0;
    double elevation_deg = 0.0;
    /// In chase and orbit views, how many times nearer the eye is; in others, how many times larger things look.
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

/// How hidden surfaces of aircraft are removed, and with which detail.
struct SurfaceSettings {
    HiddenSurface hidden_surface = HiddenSurface::Octant;
    draworder::OrderMethod order_method = draworder::OrderMethod::Exact;
    /// About the most that the search for an order takes, on one core.
    double order_seconds = 20.0;
    /// Where orders are kept: a folder, "user" for the user's own cache, or "none". The pictures are the same.
    std::string order_cache = "user";
    /// Whether aircraft cast shadows on the ground.
    bool shadows = true;
    /// Whether rotor discs, exhaust, afterburners and vapour are shown.
    bool effects = false;
    /// What a level of detail of a mesh may be wrong by on the screen.
    double aircraft_error_px = 1.0;

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
    /// By the paper's rule all polygons are smooth up to this distance.
    double near_m = 0.0;
    /// By the paper's rule all polygons are flat from this distance on.
    double far_m = 1000.0;
    ModelDisplay show_model = ModelDisplay::None;

    bool operator==(const ShadingSettings&) const = default;
};

/// What refines the terrain mesh (--terrain-lod). All but `metric` are of the paper's quadtree.
struct TerrainLod {
    /// Nothing = as ground_metric() says.
    std::optional<GroundMetric> metric;
    Propagation propagation = Propagation::CrackFree;
    GroundFans fans = GroundFans::Partial;
    DetailControl control = DetailControl::Exact;
    /// C of the first frame; 0 = the one that meets the triangle budget.
    double resolution_c = 0.0;
    /// c, the weight of roughness. Nothing: 20 for midpoint, 5 for printed.
    std::optional<double> roughness_c;
    /// The paper's a, triangles per unit of C; 0 = from the terrain's own gain.
    double control_a = 0.0;
    /// The paper's r, the number of earlier frames that the damping averages.
    int control_r = 4;

    bool operator==(const TerrainLod&) const = default;
};

/// How the ground is refined.
struct GroundSettings {
    TerrainLod lod;
    /// The triangles aimed at; nothing = 20,000, or without end where error_px is given.
    std::optional<int> triangles;
    /// By screen error: the ground is refined no further than this; nothing = 0.25.
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
    /// A runway where the path begins, on ground that is levelled for it.
    bool airfield = false;
    MeshDisplay show_mesh = MeshDisplay::None;

    bool operator==(const GroundSettings&) const = default;
};

/// Sky, haze, sun and the colours of the ground.
struct AirSettings {
    bool sky = true;
    /// The visibility at the mean height of the ground; 0 = no haze.
    double visibility_m = 30000.0;
    /// The haze is 1/e as dense so much higher up; 0 = as dense at all heights.
    double haze_height_m = 2500.0;
    /// Of the haze under a sun of 35 degrees, too.
    glm::vec3 background{158.0F / 255.0F, 184.0F / 255.0F, 214.0F / 255.0F};
    /// "YYYY-MM-DDTHH:MM" by the sun itself: whoever loads the scene sets the sun by it and the place.
    std::optional<std::string> time;
    /// The direction of the sun, clockwise from north.
    double sun_azimuth_deg = 225.0;
    double sun_elevation_deg = 35.0;
    /// Whether the ground shadows itself, and has less light in its hollows.
    bool relief_shadows = true;
    /// The share of the sky that a layer of clouds covers.
    double clouds = 0.0;
    /// Above datum. Nothing: well above the highest ground.
    std::optional<double> cloud_height_m;
    /// Ground at or below this height is drawn as water.
    double water_level_m = 0.0;
    /// The colours of the ground; nothing = arid for the canyon, else temperate.
    std::optional<Palette> palette;
    /// Auto: texture under a drape or on a GPU, else vertex.
    GroundShading ground_shading = GroundShading::Auto;
    /// An image file that is laid over the ground.
    std::optional<std::string> drape;

    bool operator==(const AirSettings&) const = default;
};

/// Everything that decides what a picture of a scene shows, in parts: whoever needs one is handed that one.
struct Settings {
    ViewSettings view;
    SurfaceSettings surface;
    ShadingSettings shading;
    GroundSettings ground;
    AirSettings air;
    Adaptation adapt;

    bool operator==(const Settings&) const = default;
};

/// What refines the ground: unless told, the screen-space error; the paper's quadtree by mid-point roughness where
/// something is asked for that only it has.
inline GroundMetric ground_metric(const TerrainLod& lod) {
    const bool uses_paper_quadtree = lod.control != DetailControl::Exact || lod.roughness_c ||
                                     lod.fans != GroundFans::Partial || lod.propagation != Propagation::CrackFree;
    return lod.metric.value_or(uses_paper_quadtree ? GroundMetric::Midpoint : GroundMetric::ScreenError);
}

/// Whether the detail of the ground is controlled alike, so that one goes on where the other was.
inline bool same_detail_control(const TerrainLod& a, const TerrainLod& b) {
    return a.control == b.control && a.resolution_c == b.resolution_c;
}

/// A triangle target beyond all meshes.
inline constexpr int unlimited_triangles = 1000000000;

/// Triangles of ground that are held, in the first frame where that number follows the clock; a number beyond all
/// meshes where the error alone decides.
inline int triangle_target(const Settings& settings) {
    const bool uses_error_only = settings.ground.error_px && !settings.adapt.terrain;
    return settings.ground.triangles.value_or(uses_error_only ? unlimited_triangles : 20000);
}

} // namespace octant::visuals::scene
