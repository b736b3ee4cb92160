#pragma once

#include "ui/base/data_files.h"
#include "ui/report/setting_role.h"
#include "ui/settings/settings.h"
#include "ui/settings/settings_text.h"

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace octant::ui::settings {

/// Groups under which help and the settings panel show settings.
enum class SettingGroup { Path, View, Time, Surface, Shading, Ground, Air };

/// The headlines of the groups.
template <>
inline constexpr std::array enum_names<SettingGroup>{EnumName{SettingGroup::Path, "Path, aircraft and ground"},
    EnumName{SettingGroup::View, "View and picture"}, EnumName{SettingGroup::Time, "Frames"},
    EnumName{SettingGroup::Surface, "Hidden surfaces, aircraft detail"},
    EnumName{SettingGroup::Shading, "Shading of aircraft"}, EnumName{SettingGroup::Ground, "Terrain mesh"},
    EnumName{SettingGroup::Air, "Sky, haze, sun and colours"}};

/// What must be made anew when settings change during a flight. Each value includes those before it.
enum class SettingsChange {
    None,
    Recording, ///< Only recordings and runs without a window use the setting; a window goes on unchanged.
    Look,      ///< Only the eye point, the direction of view or the visibility changes.
    Light,     ///< The sun moves: the ground gets other colours.
    Picture,   ///< Frames are planned and drawn differently from now on.
    World,     ///< Aircraft, path and ground are loaded again; the flight goes on.
    Flight     ///< The path or what flies along it changes: the flight begins again.
};

/// What the program does with a setting.
struct SettingBehaviour {
    SettingGroup group;
    /// What a change of this setting makes anew.
    SettingsChange change;
    /// Built-in names of a setting that is a name or a file; empty for other text.
    std::span<const std::string_view> known{};
    /// Where an optional number begins when it is switched on in a panel.
    double start = 0.0;
    /// The window sets it; its panels only show it.
    bool set_by_window = false;
    /// One of the options that `--help` shows; `--help-all` shows all.
    bool common = false;
    /// What it means to a comparison of flights, where that is not what its group says (comparison_role).
    std::optional<report::SettingRole> role{};
};

/// Everything about a setting but where its value stands.
struct SettingInfo : FieldInfo, SettingBehaviour {};

/// The row of one setting. `members` lead from RunSettings to the value: a pointer to the part, then one to its member.
template <auto... members>
struct Setting : SettingInfo {
    /// Returns the value in `settings`, which is constant where they are.
    template <class SomeSettings>
    static constexpr auto& of(SomeSettings& settings) {
        return (settings.*....*members);
    }
};

/// Makes the row of the setting to which `members` lead.
template <auto... members>
constexpr Setting<members...> setting(const FieldInfo& info, const SettingBehaviour& behaviour) {
    return {{info, behaviour}};
}

inline constexpr std::array<std::string_view, 4> built_in_terrains{"hills", "canyon", "background60", "none"};

/// How many samples of each pixel the renderers offer.
inline constexpr std::array sample_counts{1, 4, 16};

/// Bound on the coordinates of eye points: beyond every map.
inline constexpr double far_away_m = 1e7;

/// Options of all commands that read maps.
inline constexpr FieldInfo void_info{"void", "V,...|none",
    "sample values that mean 'no data', besides the file's own; none: no value does, or only those that follow "
    "[common ones are recognised and noted]"};
inline constexpr FieldInfo band_info{
    "band", "N|NAME", "band with the heights, or terrarium or mapbox for heights encoded in RGB [detected and noted]"};
inline constexpr FieldInfo aircraft_scale_info{
    "aircraft-scale", "FACTOR", "metres a unit of length of aircraft files, such as 0.01 for centimetres", 1e-6, 1e6};

/// The tables: one for each group, in the order of visit_rows.
namespace rows {

using enum SettingGroup;
using enum SettingsChange;
using report::SettingRole;
using visuals::scene::AirSettings;
using visuals::scene::GroundSettings;
using visuals::scene::ShadingSettings;
using visuals::scene::SurfaceSettings;
using visuals::scene::ViewSettings;
using visuals::terrain::TerrainLod;

/// Which path, aircraft and ground.
inline constexpr std::tuple path{
    setting<&RunSettings::path, &PathSettings::name>(
        {"path", "NAME|FILE",
            "path script (.toml) or recorded track (.csv, .igc, .gpx, .kml, .acmi, .bin, .tlog, .fdr, ...)"},
        {.group = Path, .change = Flight, .known = base::built_in_paths, .common = true}),
    setting<&RunSettings::path, &PathSettings::aircraft>({"aircraft", "NAME|FILE[=PATH[@Ns]]",
                                                             "a polygon model or a mesh (formats: octant --version); "
                                                             "repeat for wingmen; =PATH@Ns: flies its own path, N s "
                                                             "later"},
        {.group = Path, .change = Flight, .known = base::built_in_models, .common = true}),
    setting<&RunSettings::path, &PathSettings::follow>(
        {"follow", "NAME",
            "the aircraft of a recorded track that is followed: call sign, id, name or pilot [the pilot's own, else "
            "the one recorded longest]"},
        {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::tracks>(
        {"track", "FILE", "another recorded track, whose aircraft fly on the first one's clock (UTC); repeat for more"},
        {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::track_offset_s>(
        {"offset", "SECONDS", "how much later than recorded the aircraft of --track fly", -1e7, 1e7},
        {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::axes>(
        {"axes", "X,Y,Z|auto",
            "directions of the axes of aircraft files, such as right,up,back; auto: as the format defines them "
            "(AC3D), else guessed and noted"},
        {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::aircraft_scale>(aircraft_scale_info, {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::terrain>(
        {"terrain", "NAME|FILE", "an imported ground or a map that GDAL reads (file, folder, archive)"},
        {.group = Path, .change = Flight, .known = built_in_terrains, .common = true}),
    setting<&RunSettings::path, &PathSettings::terrain_spacing_m>(
        {"terrain-spacing", "METRES", "sample spacing, for terrain files that do not state it", 0.01, 1e5},
        {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::terrain_height_scale>(
        {"height-scale", "METRES",
            "metres per height unit, for terrain files that name no unit, such as 0.3048 for feet", 1e-6, 1e4},
        {.group = Path, .change = Flight, .start = 1.0}),
    setting<&RunSettings::path, &PathSettings::terrain_system>(
        {"terrain-system", "SYSTEM",
            "coordinate system, for terrain files that name none: EPSG:4326, a PROJ string, a .prj file or metres [WGS "
            "84 if the coordinates look like degrees, else metres]"},
        {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::terrain_voids>(void_info, {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::terrain_band>(band_info, {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::place>({"place", "X,Y|LAT,LON",
                                                          "position of the path's origin: metres east,north of the map "
                                                          "centre, or degrees such as 49.3N,123.1W [map centre]"},
        {.group = Path, .change = Flight, .common = true}),
    setting<&RunSettings::path, &PathSettings::heading_deg>(
        {"heading", "DEGREES",
            "rotation of the whole path, clockwise from the map's grid north [the heading of least relief]", -360.0,
            360.0},
        {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::height_mode>(
        {"height-mode", "MODE",
            "clear: raise the path to its clearance above the ground; follow: follow the ground; datum: use the "
            "heights as they are [clear; datum for a georeferenced track]"},
        {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::over_map>(
        {"over-map", "", "fly the longest part of a recorded track that lies over the map"},
        {.group = Path, .change = Flight}),
    setting<&RunSettings::path, &PathSettings::lenient>(
        {"lenient", "", "limit legs to the aircraft's abilities, with a note, instead of refusing them"},
        {.group = Path, .change = Flight})};

/// Camera, picture size and renderer.
inline constexpr std::tuple view{
    setting<&RunSettings::view, &ViewSettings::kind>(
        {"view", "VIEW", "chase, cockpit, tower, orbit or free"}, {.group = View, .change = Picture, .common = true}),
    setting<&RunSettings::view, &ViewSettings::eye_m>(
        {"eye", "X,Y,Z", "eye point of the tower and free views: metres east,north,up", -far_away_m, far_away_m},
        {.group = View, .change = Look}),
    setting<&RunSettings::view, &ViewSettings::look_m>(
        {"look", "X,Y,Z", "point at which the free view looks: metres east,north,up", -far_away_m, far_away_m},
        {.group = View, .change = Look}),
    setting<&RunSettings::view, &ViewSettings::fov_deg>(
        {"fov", "DEGREES", "vertical field of view [45; the tower zooms in on the aircraft]", 1.0, 150.0},
        {.group = View, .change = Picture, .start = 45.0}),
    setting<&RunSettings::view, &ViewSettings::azimuth_deg>(
        {"azimuth", "DEGREES",
            "chase, orbit: rotation of the eye around the aircraft, clockwise from above; other views: rotation of the "
            "look to the right",
            -360.0, 360.0},
        {.group = View, .change = Look}),
    setting<&RunSettings::view, &ViewSettings::elevation_deg>(
        {"elevation", "DEGREES",
            "chase, orbit: rotation of the eye upwards around the aircraft; other views: rotation of the look upwards",
            -89.0, 89.0},
        {.group = View, .change = Look}),
    setting<&RunSettings::view, &ViewSettings::zoom>(
        {"zoom", "FACTOR", "chase, orbit: factor by which the eye is nearer; other views: magnification", 0.05, 100.0},
        {.group = View, .change = Look}),
    setting<&RunSettings::view, &ViewSettings::inset>(
        {"inset", "VIEW", "second view in a corner of the picture: chase, cockpit, tower, orbit or free [none]"},
        {.group = View, .change = Picture}),
    setting<&RunSettings::view, &ViewSettings::head_up_display>(
        {"head-up-display", "", "cockpit view: speed, heading, pitch ladder"}, {.group = View, .change = Picture}),
    setting<&RunSettings::view, &ViewSettings::path_ribbon>(
        {"path-ribbon", "", "the path of the first aircraft as a ribbon with leg names, a scale and a north mark"},
        {.group = View, .change = Picture}),
    setting<&RunSettings::view, &ViewSettings::size_px>({"size", "WIDTHxHEIGHT", "picture size in pixels", 16, 8192},
        {.group = View, .change = Picture, .set_by_window = true, .common = true}),
    setting<&RunSettings::view, &ViewSettings::samples>(
        {"samples", "N", "samples per pixel: 1, 4 or 16 [raster: 16, gl: 1]", 1, 16, sample_counts},
        {.group = View, .change = Picture, .start = 4.0, .role = SettingRole::Drawing}),
    setting<&RunSettings::drawing, &DrawingSettings::renderer>(
        {"renderer", "KIND", "raster (software), gl (OpenGL) or auto (gl if there is a GPU)"},
        {.group = View, .change = World, .set_by_window = true, .common = true, .role = SettingRole::Drawing}),
    setting<&RunSettings::drawing, &DrawingSettings::raster_threads>(
        {"raster-threads", "N", "threads of the raster renderer [one per processor]", 1, 256},
        {.group = View, .change = World, .set_by_window = true, .role = SettingRole::Drawing}),
    setting<&RunSettings::drawing, &DrawingSettings::context>(
        {"context", "KIND", "OpenGL context: osmesa (no GPU, no display), egl or window (the driver of the display)"},
        {.group = View, .change = World, .set_by_window = true, .role = SettingRole::Drawing})};

/// Which frames are drawn, and how fast.
inline constexpr std::tuple time{
    setting<&RunSettings::time, &TimeSettings::rate_hz>({"rate", "HZ", "frames per simulated second", 0.1, 1000.0},
        {.group = Time, .change = Recording, .common = true}),
    setting<&RunSettings::time, &TimeSettings::frame_per_sample>(
        {"frame-per-sample", "", "one frame per path sample (20 Hz), as in the tables of 1989"},
        {.group = Time, .change = Recording}),
    setting<&RunSettings::time, &TimeSettings::start_s>(
        {"start", "S", "start time on the path, in seconds", 0.0, 1e6}, {.group = Time, .change = Flight}),
    setting<&RunSettings::time, &TimeSettings::part>(
        {"part", "K/N", "render only part K of N of the frames; the pictures are those of the whole flight [all]"},
        {.group = Time, .change = Recording}),
    setting<&RunSettings::time, &TimeSettings::frames>(
        {"frames", "N", "stop after N frames [the whole path]", 1, 100000000},
        {.group = Time, .change = Recording, .start = 600.0, .common = true}),
    setting<&RunSettings::time, &TimeSettings::seconds>(
        {"seconds", "S", "stop after S simulated seconds [the whole path]", 0.001, 1e6},
        {.group = Time, .change = Recording, .start = 60.0, .common = true}),
    setting<&RunSettings::time, &TimeSettings::warm_up>(
        {"warm-up", "N", "number of first frames that statistics leave out", 0, 1000000},
        {.group = Time, .change = Recording}),
    setting<&RunSettings::time, &TimeSettings::realtime>({"realtime", "", "pace frames to the wall clock"},
        {.group = Time, .change = Recording, .role = SettingRole::Drawing}),
    setting<&RunSettings::time, &TimeSettings::pictures>(
        {"pictures", "N", "with --record: write every Nth frame as PNG; 0 = none [one per simulated second]", 0,
            100000000},
        {.group = Time, .change = Recording, .start = 60.0, .role = SettingRole::Ignored}),
    setting<&RunSettings::adapt>({"adapt", "WHAT,...",
                                     "adapt to the frame time: terrain (triangles, 1/8 to 4 times --triangles), "
                                     "shading (share of smooth polygons) or none"},
        {.group = Time, .change = Picture, .common = true, .role = SettingRole::Drawing})};

/// How hidden surfaces of aircraft are removed, and with which detail.
inline constexpr std::tuple surface{
    setting<&RunSettings::surface, &SurfaceSettings::hidden_surface>(
        {"hidden-surface", "METHOD",
            "octant: painting order without depth buffer; depth-buffer; back-face: back faces removed, file order"},
        {.group = Surface, .change = World}),
    setting<&RunSettings::surface, &SurfaceSettings::order_method>(
        {"order-method", "METHOD",
            "painting order: exact (for every eye point) or paper (8 octants as printed; no rotor discs)"},
        {.group = Surface, .change = World}),
    setting<&RunSettings::surface, &SurfaceSettings::order_seconds>(
        {"order-seconds", "SECONDS", "exact: approximate time limit of the search; after it polygons are split", 0.001,
            3600.0},
        {.group = Surface, .change = World}),
    setting<&RunSettings::surface, &SurfaceSettings::order_cache>(
        {"order-cache", "DIR",
            "cache of painting orders and prepared meshes: a folder, user (octant/orders in the user cache) or none"},
        {.group = Surface, .change = Recording, .role = SettingRole::Ignored}),
    setting<&RunSettings::surface, &SurfaceSettings::shadows>(
        {"shadows", "", "shadows of aircraft, trees and houses on the ground"}, {.group = Surface, .change = Picture}),
    setting<&RunSettings::surface, &SurfaceSettings::effects>(
        {"effects", "",
            "exhaust, afterburners and wingtip vapour; --no-effects: fast rotors have blades and are no discs [discs]"},
        {.group = Surface, .change = Picture}),
    setting<&RunSettings::surface, &SurfaceSettings::aircraft_error_px>(
        {"aircraft-error-px", "PIXELS", "largest screen-space error of aircraft meshes", 0.01, 100.0},
        {.group = Surface, .change = Picture}),
    setting<&RunSettings::surface, &SurfaceSettings::textures>(
        {"textures", "", "pictures on aircraft, in at most 256 MiB; without them the vertices have their colours"},
        {.group = Surface, .change = World})};

/// How aircraft are shaded.
inline constexpr std::tuple shading{
    setting<&RunSettings::shading, &ShadingSettings::kind>(
        {"shading", "KIND",
            "aircraft: flat, gouraud, hybrid (flat and smooth polygons) or phong (per pixel, with highlights)"},
        {.group = Shading, .change = Picture, .common = true}),
    setting<&RunSettings::shading, &ShadingSettings::rule>(
        {"shading-rule", "RULE",
            "hybrid: error (area times squared error of flat shading) or paper (distance, intensities, perimeter)"},
        {.group = Shading, .change = Picture}),
    setting<&RunSettings::shading, &ShadingSettings::smooth_share>(
        {"smooth-share", "SHARE", "hybrid: share of smooth polygons", 0.0, 1.0}, {.group = Shading, .change = Picture}),
    setting<&RunSettings::shading, &ShadingSettings::device_ratio>(
        {"device-ratio", "RATIO",
            "hybrid: device speed of the paper, in place of --smooth-share; 1 = all smooth [smooth-share]", 0.0, 1.0},
        {.group = Shading, .change = Picture}),
    setting<&RunSettings::shading, &ShadingSettings::near_m>(
        {"shading-near", "METRES", "shading rule of the paper: all smooth up to this distance", 0.0, 1e7},
        {.group = Shading, .change = Picture}),
    setting<&RunSettings::shading, &ShadingSettings::far_m>(
        {"shading-far", "METRES", "shading rule of the paper: all flat from this distance on", 0.0, 1e7},
        {.group = Shading, .change = Picture}),
    setting<&RunSettings::shading, &ShadingSettings::show_model>(
        {"show-model", "WHAT",
            "colours on aircraft: none, shading (smooth blue, flat orange) or levels (a colour per halving of the mesh "
            "error, white for none)"},
        {.group = Shading, .change = Picture, .role = SettingRole::Scene})};

/// How the ground is refined.
inline constexpr std::tuple ground{setting<&RunSettings::ground, &GroundSettings::lod>(
                                       {"terrain-lod", "KIND[:KEY=VALUE,...]",
                                           "screen-error (bisection by error in pixels), exact (the paper's quadtree "
                                           "with an exact triangle budget) or paper (as printed)"},
                                       {.group = Ground, .change = Picture, .common = true}),
    setting<&RunSettings::ground, &GroundSettings::triangles>(
        {"triangles", "N", "ground triangle budget [20000; unlimited with --error-px]", 100, 10000000},
        {.group = Ground, .change = Picture, .start = 20000.0, .common = true}),
    setting<&RunSettings::ground, &GroundSettings::error_px>(
        {"error-px", "PIXELS", "screen-error: stop refining at this error [0.25]", 0.01, 1000.0},
        {.group = Ground, .change = Picture, .start = 1.0, .common = true}),
    setting<&RunSettings::ground, &GroundSettings::geomorphs>(
        {"geomorphs", "", "screen-error: vertices move into place instead of jumping"},
        {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::mesh_async>(
        {"mesh-ahead", "", "screen-error: mesh the ground of the next frame while this one is drawn"},
        {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::earth_curvature>(
        {"earth-curvature", "", "screen-error: lower distant ground and aircraft by d^2 / 2R"},
        {.group = Ground, .change = Picture, .role = SettingRole::Scene}),
    setting<&RunSettings::ground, &GroundSettings::near_detail>(
        {"near-detail", "", "screen-error: procedural ground detail near the eye; height queries ignore it"},
        {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::scenery>(
        {"scenery", "", "screen-error: procedural trees and houses near the eye; none on a texture"},
        {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::roads>(
        {"roads", "", "screen-error: procedural roads along valleys, with houses; none on a texture"},
        {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::airfield>(
        {"airfield", "",
            "a runway of 1,800 x 45 m on levelled ground where the path begins, or near its first 15 km where less "
            "levelling is needed; fails if no site within 6 km needs less than 15 m. Height queries return the "
            "levelled ground"},
        {.group = Ground, .change = World, .role = SettingRole::Scene}),
    setting<&RunSettings::ground, &GroundSettings::show_mesh>(
        {"show-mesh", "WHAT",
            "edges of the ground triangles: none, edges or levels (a colour per halving of their size)"},
        {.group = Ground, .change = Picture, .role = SettingRole::Scene})};

/// Sky, haze, sun and the colours of the ground.
inline constexpr std::tuple air{
    setting<&RunSettings::air, &AirSettings::sky>(
        {"sky", "", "sky, and a plain beyond the edge of the map"}, {.group = Air, .change = Picture}),
    setting<&RunSettings::air, &AirSettings::visibility_m>(
        {"visibility", "METRES", "distance at which haze leaves 1/e of a colour; 0 = no haze", 0.0, 1e7},
        {.group = Air, .change = Look}),
    setting<&RunSettings::air, &AirSettings::haze_height_m>(
        {"haze-height", "METRES",
            "height over which the haze density falls to 1/e; --visibility holds at the mean ground height; 0 = "
            "uniform haze",
            0.0, 1e6},
        {.group = Air, .change = Picture}),
    setting<&RunSettings::air, &AirSettings::background>(
        {"background", "RRGGBB",
            "background and haze colour; with --sky: haze colour away from the sun when the sun is 35 degrees high"},
        {.group = Air, .change = Picture}),
    setting<&RunSettings::air, &AirSettings::time>(
        {"time", "YYYY-MM-DDTHH:MM",
            "date and solar time; sets the sun for the latitude of the map, or 45 degrees north"},
        {.group = Air, .change = Light}),
    setting<&RunSettings::air, &AirSettings::sun_azimuth_deg>(
        {"sun-azimuth", "DEGREES", "direction of the sun, clockwise from north", -360.0, 360.0},
        {.group = Air, .change = Light}),
    setting<&RunSettings::air, &AirSettings::sun_elevation_deg>(
        {"sun-elevation", "DEGREES", "height of the sun above the horizon", 0.0, 90.0},
        {.group = Air, .change = Light}),
    setting<&RunSettings::air, &AirSettings::relief_shadows>(
        {"relief-shadows", "", "shadows of the ground on itself, and darker hollows"},
        {.group = Air, .change = Picture, .role = SettingRole::Drawing}),
    setting<&RunSettings::air, &AirSettings::clouds>(
        {"clouds", "SHARE", "share of the sky that a thin layer of clouds covers", 0.0, 1.0},
        {.group = Air, .change = Picture}),
    setting<&RunSettings::air, &AirSettings::cloud_height_m>(
        {"cloud-height", "METRES",
            "height of the clouds above datum, above all ground [500 m above the highest ground]", -1000.0, 20000.0},
        {.group = Air, .change = Picture, .start = 3000.0}),
    setting<&RunSettings::air, &AirSettings::water_level_m>(
        {"water-level", "METRES", "level ground at or below this height is water", -12000.0, 9000.0},
        {.group = Air, .change = Picture}),
    setting<&RunSettings::air, &AirSettings::palette>(
        {"palette", "NAME", "ground colours: temperate or arid [arid for the canyon, else temperate]"},
        {.group = Air, .change = Picture}),
    setting<&RunSettings::air, &AirSettings::ground_shading>(
        {"ground-shading", "KIND",
            "vertex: light at each vertex; texture: light at each pixel (2 to 3 times the frame time without a GPU); "
            "auto: texture with a drape or a GPU"},
        {.group = Air, .change = World, .role = SettingRole::Drawing}),
    setting<&RunSettings::air, &AirSettings::drape>(
        {"drape", "FILE",
            "image over the ground: placed by its coordinate system, or from edge to edge, north up, if it names none"},
        {.group = Air, .change = World})};

/// Old names of parts of --terrain-lod. Files and, until 1.1, options with these names are still read.
inline constexpr std::tuple old_terrain_lod{setting<&RunSettings::ground, &GroundSettings::lod, &TerrainLod::metric>(
                                                {"mesh", "METRIC", "roughness"}, {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::lod, &TerrainLod::propagation>(
        {"propagation", "RULE", "propagation"}, {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::lod, &TerrainLod::fans>(
        {"fans", "KIND", "fans"}, {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::lod, &TerrainLod::control>(
        {"detail", "CONTROL", "control"}, {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::lod, &TerrainLod::resolution_c>(
        {"resolution-c", "C", "resolution-c", 0.0, 1e6}, {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::lod, &TerrainLod::roughness_c>(
        {"roughness-c", "C", "roughness-c", 0.0, 1000.0}, {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::lod, &TerrainLod::control_a>(
        {"control-a", "A", "control-a", 0.0, 1e9}, {.group = Ground, .change = Picture}),
    setting<&RunSettings::ground, &GroundSettings::lod, &TerrainLod::control_r>(
        {"control-r", "R", "control-r", 0, 64}, {.group = Ground, .change = Picture})};

} // namespace rows

/// Calls visit(row) with the Setting of every field of RunSettings, in the order of help and files.
template <class Visit>
void visit_rows(Visit&& visit) {
    const auto visit_each = [&visit](const auto&... row) { (visit(row), ...); };
    std::apply(visit_each, rows::path);
    std::apply(visit_each, rows::view);
    std::apply(visit_each, rows::time);
    std::apply(visit_each, rows::surface);
    std::apply(visit_each, rows::shading);
    std::apply(visit_each, rows::ground);
    std::apply(visit_each, rows::air);
}

/// Calls visit(SettingInfo, value) for every field of RunSettings. Command line, settings files, run.json, panels and
/// the rules of reloading are all made from it.
template <class SomeSettings, class Visit>
void visit_settings(SomeSettings& settings, Visit&& visit) {
    visit_rows([&](const auto& row) { visit(static_cast<const SettingInfo&>(row), row.of(settings)); });
}

/// Calls visit(row) for each name of earlier versions; the row's `meaning` is the key of --terrain-lod that replaces
/// it.
template <class Visit>
void visit_old_rows(Visit&& visit) {
    const auto visit_each = [&visit](const auto&... row) { (visit(row), ...); };
    std::apply(visit_each, rows::old_terrain_lod);
}

/// Returns what must be made anew when the settings change from `before` to `after`: the greatest change of all rows
/// whose values differ.
SettingsChange change_between(const RunSettings& before, const RunSettings& after);

/// What a setting means to a comparison of flights: all about path, view, frames and air is the scene, all about
/// surfaces, shading and ground is drawing, but for the rows that say otherwise. A name of earlier versions is drawing.
report::SettingRole comparison_role(std::string_view name);

/// Sets one setting by its name, also an old one, as words on a command line would; only lists take several. Throws
/// Error "NAME: expected ..., got ..." and for a name that no setting has. Returns the note for a value under an old
/// name, else an empty string.
std::string set_by_name(RunSettings& settings, std::string_view name, const std::vector<std::string>& words);

/// Settings that are keys of one option: `--show roads` and `--show no-roads` set "roads".
struct SettingFamily {
    std::string_view name; ///< of the option, with its dashes
    std::string_view form;
    std::string_view meaning;
    SettingGroup group;
    std::vector<std::pair<std::string_view, std::string_view>> keys; ///< key and name of the setting
};

const std::vector<SettingFamily>& setting_families();

/// A message with the names of settings in place of their options: "--show path-ribbon" becomes "path-ribbon",
/// "--near-detail" becomes "near-detail". Other options stay.
std::string with_setting_names(std::string_view message);

/// Replaces names of files that exist relative to `folder` by paths that are valid from the working directory. Built-in
/// names have precedence; names of files that do not exist there stay.
void resolve_paths_from(const std::filesystem::path& folder, RunSettings& settings);

} // namespace octant::ui::settings
