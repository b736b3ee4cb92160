#pragma once

#include "ui/settings/path_fields.h"
#include "ui/settings/setting_row.h"

#include <array>
#include <tuple>

namespace octant::ui::settings {

/// How many samples of each pixel the renderers offer.
inline constexpr std::array sample_counts{1, 4, 16};

/// Bound on the coordinates of eye points: beyond every map.
inline constexpr double far_away_m = 1e7;

/// Settings of the group View. From where a picture is seen, how large it is and who draws it.
inline constexpr std::tuple view_rows{setting<&RunSettings::view, &visuals::scene::ViewSettings::kind>(
                                          {"view", "VIEW", "chase, cockpit, tower, orbit or free"},
                                          {.group = SettingGroup::View, .change = SettingsChange::Picture}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::eye_m>(
        {"eye", "X,Y,Z", "eye point of the tower and free views, metres east,north,up", -far_away_m, far_away_m},
        {.group = SettingGroup::View, .change = SettingsChange::Look}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::look_m>(
        {"look", "X,Y,Z", "what the free view looks at, metres east,north,up", -far_away_m, far_away_m},
        {.group = SettingGroup::View, .change = SettingsChange::Look}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::fov_deg>(
        {"fov", "DEGREES", "vertical field of view [45; the tower zooms in on the aircraft]", 1.0, 150.0},
        {.group = SettingGroup::View, .change = SettingsChange::Picture, .start = 45.0}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::azimuth_deg>(
        {"azimuth", "DEGREES",
            "chase, orbit: eye turned around the aircraft, clockwise from above; else the look "
            "turned right",
            -360.0, 360.0},
        {.group = SettingGroup::View, .change = SettingsChange::Look}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::elevation_deg>(
        {"elevation", "DEGREES", "chase, orbit: eye turned upwards around the aircraft; else the look turned up", -89.0,
            89.0},
        {.group = SettingGroup::View, .change = SettingsChange::Look}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::zoom>(
        {"zoom", "FACTOR", "chase, orbit: how many times nearer; else how many times larger", 0.05, 100.0},
        {.group = SettingGroup::View, .change = SettingsChange::Look}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::inset>(
        {"inset", "VIEW", "a second view in a corner of the picture: chase, cockpit, ... [none]"},
        {.group = SettingGroup::View, .change = SettingsChange::Picture}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::head_up_display>(
        {"head-up-display", "", "speed, heading, pitch ladder and more before the cockpit view"},
        {.group = SettingGroup::View, .change = SettingsChange::Picture}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::path_ribbon>(
        {"path-ribbon", "", "the first aircraft's path as a ribbon with its legs named, a scale and a north mark"},
        {.group = SettingGroup::View, .change = SettingsChange::Picture}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::size_px>(
        {"size", "WIDTHxHEIGHT", "picture size in pixels", 16, 8192},
        {.group = SettingGroup::View, .change = SettingsChange::Picture, .set_by_window = true}),
    setting<&RunSettings::view, &visuals::scene::ViewSettings::samples>(
        {"samples", "N", "samples a pixel, 1, 4 or 16 [raster: 16, gl: 1]", 1, 16, sample_counts},
        {.group = SettingGroup::View, .change = SettingsChange::Picture, .start = 4.0}),
    setting<&RunSettings::drawing, &DrawingSettings::renderer>(
        {"renderer", "KIND",
            "who draws: raster (the program itself, no GPU), gl (OpenGL) or auto: raster where no GPU "
            "draws"},
        {.group = SettingGroup::View, .change = SettingsChange::World, .set_by_window = true}),
    setting<&RunSettings::drawing, &DrawingSettings::raster_threads>(
        {"raster-threads", "N", "threads of the raster renderer [one a core]", 1, 256},
        {.group = SettingGroup::View, .change = SettingsChange::World, .set_by_window = true}),
    setting<&RunSettings::drawing, &DrawingSettings::context>(
        {"context", "KIND", "OpenGL's context: osmesa (no GPU, no display), egl or window (the display's driver)"},
        {.group = SettingGroup::View, .change = SettingsChange::World, .set_by_window = true})};

/// Settings of the group Time. Which frames are drawn, and how fast.
inline constexpr std::tuple time_rows{
    setting<&RunSettings::time, &TimeSettings::rate_hz>({"rate", "HZ", "frames a simulated second", 0.1, 1000.0},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording}),
    setting<&RunSettings::time, &TimeSettings::frame_per_sample>(
        {"frame-per-sample", "", "one frame a path sample, as the 1989 tables use"},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording}),
    setting<&RunSettings::time, &TimeSettings::start_s>({"start", "S", "begin so far into the path", 0.0, 1e6},
        {.group = SettingGroup::Time, .change = SettingsChange::Flight}),
    setting<&RunSettings::time, &TimeSettings::part>(
        {"part", "K/N",
            "draw only the Kth of N parts of the frames, and the one before it, each as it is in the "
            "whole flight [all]"},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording}),
    setting<&RunSettings::time, &TimeSettings::frames>(
        {"frames", "N", "stop after so many frames [the whole path]", 1, 100000000},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording, .start = 600.0}),
    setting<&RunSettings::time, &TimeSettings::seconds>(
        {"seconds", "S", "stop after so much simulated time [the whole path]", 0.001, 1e6},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording, .start = 60.0}),
    setting<&RunSettings::time, &TimeSettings::warm_up>(
        {"warm-up", "N", "first frames that statistics leave out", 0, 1000000},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording}),
    setting<&RunSettings::time, &TimeSettings::realtime>({"realtime", "", "no faster than the clock"},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording}),
    setting<&RunSettings::time, &TimeSettings::pictures>(
        {"pictures", "N", "with --record: every Nth frame as PNG, 0 = none [one a simulated second]", 0, 100000000},
        {.group = SettingGroup::Time, .change = SettingsChange::Recording, .start = 60.0}),
    setting<&RunSettings::adapt>(
        {"adapt", "WHAT,...",
            "what follows the frame time: terrain (its triangles, from an eighth to four times "
            "--triangles, so that a frame uses 75 to 90 % of its time), shading (the share "
            "of smooth polygons, so that a frame keeps its time), or none"},
        {.group = SettingGroup::Time, .change = SettingsChange::Picture})};

/// Settings of the group Ground. How the ground is refined.
inline constexpr std::tuple ground_rows{
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::mesh>(
        {"mesh", "METRIC",
            "what refines the ground: screen-error (error in pixels, bisection), or the paper's "
            "quadtree by midpoint or printed (corner slopes) roughness [screen-error; midpoint "
            "where only the quadtree has what is asked for]"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::propagation>(
        {"propagation", "RULE", "how roughness reaches coarser nodes: crack-free, or printed (leaves cracks)"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::fans>(
        {"fans", "KIND", "partial: quadrants refine singly; full: all four at once"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::detail>(
        {"detail", "CONTROL",
            "triangle control: exact (counted in each frame), damped (finds its own gain; with "
            "control-a the weighted mean as printed), previous, literal, or fixed C"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::triangles>(
        {"triangles", "N", "triangles of ground that are held [20000; no end with error-px]", 100, 10000000},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture, .start = 20000.0}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::error_px>(
        {"error-px", "PIXELS", "screen-error: refine to this error and no further [0.25, within the triangles]", 0.01,
            1000.0},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture, .start = 1.0}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::geomorphs>(
        {"geomorphs", "", "screen-error: vertices move into place instead of jumping"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::mesh_async>(
        {"mesh-ahead", "", "screen-error: mesh the ground of the next frame while this one is drawn"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::earth_curvature>(
        {"earth-curvature", "", "screen-error: distant ground and aircraft sink by d^2 / 2R"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::resolution_c>(
        {"resolution-c", "C", "C of the first frame; 0 = what meets the target; not for exact", 0.0, 1e6},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::roughness_c>(
        {"roughness-c", "c", "weight of roughness against distance [20 for midpoint, 5 for printed]", 0.0, 1000.0},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture, .start = 20.0}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::control_a>(
        {"control-a", "a", "triangles a unit of C in the control; 0 = from the ground's own gain", 0.0, 1e9},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::near_detail>(
        {"near-detail", "",
            "screen-error: ground near the eye gets made-up detail between its samples; heights that "
            "are asked for have none"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::scenery>(
        {"scenery", "",
            "screen-error: made-up trees and houses near the eye; none where a texture colours the "
            "ground"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::roads>(
        {"roads", "",
            "screen-error: made-up roads along the valleys, with more houses beside them; none where "
            "a "
            "texture colours the ground"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::airfield>(
        {"airfield", "",
            "a runway of 1,800 x 45 m with its markings on levelled ground: where the path begins, "
            "along its first heading; near its first 15 km where that needs cuttings or embankments "
            "of more than 15 m; refused where all places within 6 km of it do. Heights that are asked "
            "for are those of the levelled ground"},
        {.group = SettingGroup::Ground, .change = SettingsChange::World}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::show_mesh>(
        {"show-mesh", "WHAT",
            "lines along the edges of the ground's triangles: none, edges, or levels (a colour for "
            "each halving of their size)"},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture}),
    setting<&RunSettings::ground, &visuals::scene::GroundSettings::control_r>(
        {"control-r", "r", "earlier frames in the damping's mean", 0, 64},
        {.group = SettingGroup::Ground, .change = SettingsChange::Picture})};

/// Settings of the group Surface. How hidden surfaces of aircraft are removed, and with which detail.
inline constexpr std::tuple surface_rows{
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::hidden_surface>(
        {"hidden-surface", "METHOD",
            "octant: painted in order, no depth buffer; depth-buffer; back-face: aircraft in file "
            "order"},
        {.group = SettingGroup::Surface, .change = SettingsChange::World}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::order_method>(
        {"order-method", "METHOD", "painting order of octant: exact (for every eye) or paper (8 octants as printed)"},
        {.group = SettingGroup::Surface, .change = SettingsChange::World}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::order_seconds>(
        {"order-seconds", "SECONDS", "exact: about so long a model is searched; then its polygons are split", 0.001,
            3600.0},
        {.group = SettingGroup::Surface, .change = SettingsChange::World}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::order_cache>(
        {"order-cache", "DIR",
            "painting orders and meshes made ready to be refined are kept in this folder, and read "
            "where the same model comes again: user (octant/orders in the user's cache), none or a "
            "folder"},
        {.group = SettingGroup::Surface, .change = SettingsChange::Recording}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::shadows>(
        {"shadows", "", "shadows of aircraft on the ground"},
        {.group = SettingGroup::Surface, .change = SettingsChange::Picture}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::effects>(
        {"effects", "", "rotor discs, exhaust, afterburners and vapour at the wingtips"},
        {.group = SettingGroup::Surface, .change = SettingsChange::Picture}),
    setting<&RunSettings::surface, &visuals::scene::SurfaceSettings::aircraft_error_px>(
        {"aircraft-error-px", "PIXELS", "meshes: refined, or the coarsest level of a .chain, to be wrong by no more",
            0.01, 100.0},
        {.group = SettingGroup::Surface, .change = SettingsChange::Picture})};

/// Settings of the group Shading. How aircraft are shaded.
inline constexpr std::tuple shading_rows{
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::kind>(
        {"shading", "KIND",
            "aircraft: flat, gouraud, hybrid (the polygons that gain most are smooth), or phong (lit "
            "in "
            "each pixel, with highlights)"},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::rule>(
        {"shading-rule", "RULE",
            "hybrid: error (area times squared error of flat shading) or paper (distance, "
            "intensities, perimeter)"},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::smooth_share>(
        {"smooth-share", "SHARE", "hybrid: share of the polygons that are smooth", 0.0, 1.0},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::device_ratio>(
        {"device-ratio", "RATIO", "hybrid: the same as the paper's speed of a device, 1 = all smooth [smooth-share]",
            0.0, 1.0},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::near_m>(
        {"shading-near", "METRES", "paper's rule: all smooth to this distance", 0.0, 1e7},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::far_m>(
        {"shading-far", "METRES", "paper's rule: all flat from this distance", 0.0, 1e7},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture}),
    setting<&RunSettings::shading, &visuals::scene::ShadingSettings::show_model>(
        {"show-model", "WHAT",
            "colours on aircraft: none, shading (smooth polygons blue, flat ones orange) or levels "
            "(a colour for each halving of what a mesh is wrong by, white where it is not)"},
        {.group = SettingGroup::Shading, .change = SettingsChange::Picture})};

/// Settings of the group Air. Sky, haze, sun and the colours of the ground.
inline constexpr std::tuple air_rows{setting<&RunSettings::air, &visuals::scene::AirSettings::sky>(
                                         {"sky", "", "sky and the plain beyond the map's edge"},
                                         {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::visibility_m>(
        {"visibility", "METRES", "distance at which haze leaves 1/e of a colour; 0 = no haze", 0.0, 1e7},
        {.group = SettingGroup::Air, .change = SettingsChange::Look}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::haze_height_m>(
        {"haze-height", "METRES",
            "so much higher up the haze is 1/e as dense; --visibility holds at the ground's mean "
            "height; 0 = as dense at all heights",
            0.0, 1e6},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::background>(
        {"background", "RRGGBB",
            "colour of the empty picture, and of the haze; under a sky that of the haze with the sun "
            "35 degrees up, away from it"},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::time>(
        {"time", "YYYY-MM-DDTHH:MM",
            "date and the sun's own time, in place of the sun's angles: where it stands at the map's "
            "latitude, or at 45 degrees north without a place"},
        {.group = SettingGroup::Air, .change = SettingsChange::Light}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::sun_azimuth_deg>(
        {"sun-azimuth", "DEGREES", "sun, clockwise from north", -360.0, 360.0},
        {.group = SettingGroup::Air, .change = SettingsChange::Light}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::sun_elevation_deg>(
        {"sun-elevation", "DEGREES", "sun above the horizon", 0.0, 90.0},
        {.group = SettingGroup::Air, .change = SettingsChange::Light}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::relief_shadows>(
        {"relief-shadows", "", "shadows of the ground on itself, and less light in its hollows"},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::clouds>(
        {"clouds", "SHARE", "share of the sky that a thin layer of clouds covers", 0.0, 1.0},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::cloud_height_m>(
        {"cloud-height", "METRES", "of the clouds above datum, above all ground [500 m above the highest ground]",
            -1000.0, 20000.0},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture, .start = 3000.0}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::water_level_m>(
        {"water-level", "METRES", "level ground at or below it is water", -12000.0, 9000.0},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::palette>(
        {"palette", "NAME", "ground colours: temperate or arid [arid for the canyon, else temperate]"},
        {.group = SettingGroup::Air, .change = SettingsChange::Picture}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::ground_shading>(
        {"ground-shading", "KIND",
            "vertex: ground lit at each vertex; texture: at each pixel, which without a GPU takes 2 "
            "to 3 times as long a frame; auto: texture with a drape or a GPU"},
        {.group = SettingGroup::Air, .change = SettingsChange::World}),
    setting<&RunSettings::air, &visuals::scene::AirSettings::drape>(
        {"drape", "FILE",
            "image laid over the ground: by its coordinate system, or from edge to edge, north up, "
            "where it has none"},
        {.group = SettingGroup::Air, .change = SettingsChange::World})};

/// Calls visit(row) with the Setting of every field of RunSettings, in the order of help and files.
template <class Visit>
void visit_rows(Visit&& visit) {
    const auto visit_each = [&visit](const auto&... row) { (visit(row), ...); };
    std::apply(visit_each, path_rows);
    std::apply(visit_each, view_rows);
    std::apply(visit_each, time_rows);
    std::apply(visit_each, surface_rows);
    std::apply(visit_each, shading_rows);
    std::apply(visit_each, ground_rows);
    std::apply(visit_each, air_rows);
}

/// Calls visit(SettingInfo, value) for every field of RunSettings. Command line, settings files, run.json, panels and
/// the rules of reloading are all made from it.
template <class SomeSettings, class Visit>
void visit_settings(SomeSettings& settings, Visit&& visit) {
    visit_rows([&](const auto& row) { visit(static_cast<const SettingInfo&>(row), row.of(settings)); });
}

} // namespace octant::ui::settings
