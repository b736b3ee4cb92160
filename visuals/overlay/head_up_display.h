#pragma once

#include "sim/aircraft_state.h"
#include "visuals/overlay/overlay_canvas.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

#include <optional>

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
class HeadUpDisplay {
public:
    /// Valid until the next call. No allocation once warmed up.
    scene::OverlayDraw draw(const InstrumentReadings& inputs, const scene::Camera& camera, const glm::ivec2& size_px);

private:
    OverlayCanvas canvas_;
};

} // namespace octant::visuals::overlay
