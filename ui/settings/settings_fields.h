#pragma once

#include "ui/settings/aircraft_fields.h"
#include "ui/settings/settings_text.h"

namespace octant::ui::settings {

// Each calls visit(FieldInfo, field) for some fields of Settings, in the order of help and files.

/// Fields that say which path, aircraft and ground.
template <class SomeSettings, class Visit>
void visit_path_settings(SomeSettings& s, Visit& visit) {
    using Info = FieldInfo;
    visit(
        Info{
            "path",
            "NAME|FILE",
            "path: straight, jinking, pop-up, turn, a .toml or a recorded .csv"},
        s.path.name);
    visit(
        Info{
            "aircraft",
            "NAME|FILE",
            "aircraft: f15, 500md, concave, an OBJ file of up to 2,000 polygons, or a mesh (.obj, "
            ".ply, .stl, .glb, .ac, .wrl, .pm, .chain); repeat for wingmen"},
        s.path.aircraft);
    visit(Info{"axes", "X,Y,Z", "where the axes of aircraft files point"}, s.path.axes);
    visit(
        Info{
            "terrain",
            "NAME|FILE",
            "ground: hills, canyon, background60, none, a file that GDAL reads or an imported one"},
        s.path.terrain);
    visit(
        Info{
            "terrain-spacing",
            "METRES",
            "sample spacing of terrain files that do not say",
            0.01,
            1e5},
        s.path.terrain_spacing_m);
    visit(
        Info{
            "place",
            "X,Y|LAT,LON",
            "where the path's origin lies: metres east,north of the map centre, or degrees such as "
            "49.3N,123.1W or, on the map, 49.3,-123.1 [map centre]"},
        s.path.place);
    visit(
        Info{
            "heading",
            "DEGREES",
            "turns the whole path, clockwise [the heading of least relief]",
            -360.0,
            360.0},
        s.path.heading_deg);
    visit(
        Info{
            "height-mode",
            "MODE",
            "clear: lift the path to its named clearance; follow: follow the ground; datum: as it "
            "is [clear; datum for a track with its own place]"},
        s.path.height_mode);
    visit(
        Info{"lenient", "", "clip legs that ask more than the aircraft can give, and say so"},
        s.path.lenient);
}

/// Fields that say from where it is seen, and on what picture.
template <class SomeSettings, class Visit>
void visit_view_settings(SomeSettings& s, Visit& visit) {
    constexpr double far_m = 1e7;
    using Info = FieldInfo;
    visit(Info{"view", "VIEW", "chase, cockpit, tower, orbit or free"}, s.view.kind);
    visit(
        Info{
            "eye",
            "X,Y,Z",
            "eye point of the tower and free views, metres east,north,up",
            -far_m,
            far_m},
        s.view.eye_m);
    visit(
        Info{"look", "X,Y,Z", "what the free view looks at, metres east,north,up", -far_m, far_m},
        s.view.look_m);
    visit(
        Info{
            "fov",
            "DEGREES",
            "vertical field of view [45; the tower zooms in on the aircraft]",
            1.0,
            150.0},
        s.view.fov_deg);
    visit(
        Info{
            "azimuth",
            "DEGREES",
            "chase, orbit: eye turned around the aircraft, clockwise from above; else the look "
            "turned right",
            -360.0,
            360.0},
        s.view.azimuth_deg);
    visit(Info{"elevation", "DEGREES", "the same upwards", -89.0, 89.0}, s.view.elevation_deg);
    visit(
        Info{
            "zoom",
            "FACTOR",
            "chase, orbit: how many times nearer; else how many times larger",
            0.05,
            100.0},
        s.view.zoom);
    visit(
        Info{
            "inset",
            "VIEW",
            "a second view in a corner of the picture: chase, cockpit, ... [none]"},
        s.view.inset);
    visit(
        Info{
            "head-up-display", "", "speed, heading, pitch ladder and more before the cockpit view"},
        s.view.head_up_display);
    visit(Info{"size", "WIDTHxHEIGHT", "picture size in pixels", 16, 8192}, s.view.size_px);
    visit(Info{"samples", "N", "samples a pixel, 1 or 4", 1, 4}, s.view.samples);
    visit(
        Info{
            "context",
            "KIND",
            "who draws: osmesa (no GPU, no display), egl or window (the display's driver)"},
        s.drawing.context);
}

/// Fields that say which frames are drawn, and how fast.
template <class SomeSettings, class Visit>
void visit_time_settings(SomeSettings& s, Visit& visit) {
    using Info = FieldInfo;
    visit(Info{"rate", "HZ", "frames a simulated second", 0.1, 1000.0}, s.time.rate_hz);
    visit(
        Info{"frame-per-sample", "", "one frame a path sample, as the 1989 tables use"},
        s.time.frame_per_sample);
    visit(Info{"start", "S", "begin so far into the path", 0.0, 1e6}, s.time.start_s);
    visit(
        Info{"frames", "N", "stop after so many frames [the whole path]", 1, 100000000},
        s.time.frames);
    visit(
        Info{"seconds", "S", "stop after so much simulated time [the whole path]", 0.001, 1e6},
        s.time.seconds);
    visit(
        Info{"warm-up", "N", "first frames that statistics leave out", 0, 1000000}, s.time.warm_up);
    visit(Info{"realtime", "", "no faster than the clock"}, s.time.realtime);
    visit(
        Info{
            "pictures",
            "N",
            "with --record: every Nth frame as PNG, 0 = none [one a simulated second]",
            0,
            100000000},
        s.time.pictures);
    visit(
        Info{
            "adapt",
            "WHAT,...",
            "what follows the frame time: terrain (its triangles, from an eighth to four times "
            "--triangles, so that a frame uses 75 to 90 % of its time), shading (the share "
            "of smooth polygons, so that a frame keeps its time), or none"},
        s.adapt);
}

/// Fields that say how the ground is refined.
template <class SomeSettings, class Visit>
void visit_ground_settings(SomeSettings& s, Visit& visit) {
    using Info = FieldInfo;
    visit(
        Info{
            "mesh",
            "METRIC",
            "what refines the ground: screen-error (error in pixels, bisection), or the paper's "
            "quadtree by midpoint or printed (corner slopes) roughness [screen-error; midpoint "
            "where only the quadtree has what is asked for]"},
        s.ground.mesh);
    visit(
        Info{
            "propagation",
            "RULE",
            "how roughness reaches coarser nodes: crack-free, or printed (leaves cracks)"},
        s.ground.propagation);
    visit(
        Info{"fans", "KIND", "partial: quadrants refine singly; full: all four at once"},
        s.ground.fans);
    visit(
        Info{
            "detail",
            "CONTROL",
            "triangle control: exact (counted in each frame), damped (weighted mean), previous, "
            "literal, or fixed C"},
        s.ground.detail);
    visit(
        Info{
            "triangles",
            "N",
            "triangles of ground that are held [20000; no end with error-px]",
            100,
            10000000},
        s.ground.triangles);
    visit(
        Info{
            "error-px",
            "PIXELS",
            "screen-error: refine to this error and no further [0.25, within the triangles]",
            0.01,
            1000.0},
        s.ground.error_px);
    visit(
        Info{"geomorphs", "", "screen-error: vertices move into place instead of jumping"},
        s.ground.geomorphs);
    visit(
        Info{
            "mesh-ahead",
            "",
            "screen-error: mesh the ground of the next frame while this one is drawn"},
        s.ground.mesh_ahead);
    visit(
        Info{"earth-curvature", "", "screen-error: distant ground and aircraft sink by d^2 / 2R"},
        s.ground.earth_curvature);
    visit(
        Info{
            "resolution-c",
            "C",
            "C of the first frame; 0 = what meets the target; not for exact",
            0.0,
            1e6},
        s.ground.resolution_c);
    visit(
        Info{
            "roughness-c",
            "c",
            "weight of roughness against distance [20 for midpoint, 5 for printed]",
            0.0,
            1000.0},
        s.ground.roughness_c);
    visit(
        Info{
            "control-a",
            "a",
            "triangles a unit of C in the control; 0 = from the ground's own gain",
            0.0,
            1e9},
        s.ground.control_a);
    visit(
        Info{
            "show-mesh",
            "WHAT",
            "lines along the edges of the ground's triangles: none, edges, or levels (a colour for "
            "each halving of their size)"},
        s.ground.show_mesh);
    visit(
        Info{"control-r", "r", "earlier frames in the damping's mean", 0, 64}, s.ground.control_r);
}

/// Fields that say sky, haze, sun and colours.
template <class SomeSettings, class Visit>
void visit_air_settings(SomeSettings& s, Visit& visit) {
    using Info = FieldInfo;
    visit(Info{"sky", "", "sky and the plain beyond the map's edge"}, s.air.sky);
    visit(
        Info{
            "visibility",
            "METRES",
            "distance at which haze leaves 1/e of a colour; 0 = no haze",
            0.0,
            1e7},
        s.air.visibility_m);
    visit(
        Info{"background", "RRGGBB", "colour of the empty picture, and of the haze"},
        s.air.background);
    visit(
        Info{"sun-azimuth", "DEGREES", "sun, clockwise from north", -360.0, 360.0},
        s.air.sun_azimuth_deg);
    visit(
        Info{"sun-elevation", "DEGREES", "sun above the horizon", 0.0, 90.0},
        s.air.sun_elevation_deg);
    visit(
        Info{"water-level", "METRES", "level ground at or below it is water", -12000.0, 9000.0},
        s.air.water_level_m);
    visit(
        Info{
            "palette",
            "NAME",
            "ground colours: temperate or arid [arid for the canyon, else temperate]"},
        s.air.palette);
    visit(
        Info{
            "ground-shading",
            "KIND",
            "vertex: ground lit at each vertex; texture: at each pixel, which without a GPU takes "
            "2 "
            "to 3 times as long a frame; auto: texture with a drape or a GPU"},
        s.air.ground_shading);
    visit(
        Info{
            "drape",
            "FILE",
            "image laid over the ground: by its coordinate system, or from edge to edge, north up, "
            "where it has none"},
        s.air.drape);
}

/// Calls visit(FieldInfo, field) for every field of Settings: the one list from which command line,
/// settings files and run.json are made.
template <class SomeSettings, class Visit>
void visit_settings(SomeSettings& s, Visit&& visit) {
    visit_path_settings(s, visit);
    visit_view_settings(s, visit);
    visit_time_settings(s, visit);
    visit_surface_settings(s, visit);
    visit_shading_settings(s, visit);
    visit_ground_settings(s, visit);
    visit_air_settings(s, visit);
}

} // namespace octant::ui::settings
