#pragma once

#include "sim/aircraft_state.h"
#include "visuals/overlay/overlay_canvas.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>

// What lies over pictures. Each function draws on an empty canvas that the caller keeps; the result is valid until the
// canvas is used again. No allocation once warmed up.

namespace octant::visuals::overlay {

/// What a head-up display shows beside the state's own values.
struct InstrumentReadings {
    sim::AircraftState state;
    double height_m = 0.0;                       ///< above datum
    std::optional<double> height_above_ground_m; ///< nothing outside the map
};

/// Head-up display of the cockpit view: true airspeed in knots, altitude in feet, heading tape, pitch ladder and
/// flight-path marker that lie on the world behind them, load factor, height above ground, Mach number, vertical speed.
/// Lines and letters are triangles with soft edges, so that no multisampling is needed. Sizes go with the picture's
/// height. It is fixed ahead of the pilot: a look aside moves it out of the picture.
scene::OverlayDraw draw_head_up_display(
    OverlayCanvas& canvas, const InstrumentReadings& readings, const scene::Camera& camera, const glm::ivec2& size_px);

/// A name at a position of the world; eye at the origin.
struct WorldLabel {
    glm::dvec3 at_m{0.0};
    std::string_view name;
};

/// What explains a path in the picture: names where their positions are in view, a scale for what is as far as the
/// aircraft (`aircraft_m`, eye at the origin), and a mark that points north.
scene::OverlayDraw draw_path_annotations(OverlayCanvas& canvas, const scene::Camera& camera, const glm::ivec2& size_px,
    const glm::dvec3& aircraft_m, std::span<const WorldLabel> labels);

/// Lines of text in the upper left corner of a picture, in the strokes of the head-up display: small letters become
/// capitals. A line that is too long for the picture goes on below, indented. Sizes go with the picture's height.
scene::OverlayDraw draw_text(OverlayCanvas& canvas, std::span<const std::string> lines, const glm::ivec2& size_px);

} // namespace octant::visuals::overlay
