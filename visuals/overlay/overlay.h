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

// Overlays of pictures. Each function draws on an empty canvas of the caller; the result is valid until the canvas is
// used again. After the first pictures no function allocates memory.

namespace octant::visuals::overlay {

/// The input of a head-up display or an instrument panel: a state, and heights that the state does not hold.
struct InstrumentReadings {
    sim::AircraftState state;
    double height_m = 0.0;                       ///< above datum
    std::optional<double> height_above_ground_m; ///< nothing outside the map
};

/// Head-up display of the cockpit view: true airspeed in knots, altitude in feet, heading tape, pitch ladder and
/// flight-path marker that agree with the world behind them, load factor, height above ground, Mach number, vertical
/// speed. Lines and letters are triangles with soft edges, so that no multisampling is needed. Sizes are proportional
/// to the picture's height. The display is fixed in front of the pilot: turning the head moves it out of the picture.
scene::OverlayDraw draw_head_up_display(
    OverlayCanvas& canvas, const InstrumentReadings& readings, const scene::Camera& camera, const glm::ivec2& size_px);

/// A name at a position of the world; eye at the origin.
struct WorldLabel {
    glm::dvec3 at_m{0.0};
    std::string_view name;
};

/// Annotations of a path: the names of positions in view, a scale bar that is valid at the distance of the aircraft
/// (`aircraft_m`, eye at the origin), and an arrow that points north.
scene::OverlayDraw draw_path_annotations(OverlayCanvas& canvas, const scene::Camera& camera, const glm::ivec2& size_px,
    const glm::dvec3& aircraft_m, std::span<const WorldLabel> labels);

/// Lines of text in the upper left corner of a picture, in the strokes of the head-up display: small letters become
/// capitals. A line that is too long for the picture goes on below, indented. Sizes go with the picture's height.
scene::OverlayDraw draw_text(OverlayCanvas& canvas, std::span<const std::string> lines, const glm::ivec2& size_px);

} // namespace octant::visuals::overlay
