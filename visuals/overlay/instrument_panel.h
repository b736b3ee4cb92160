#pragma once

#include "visuals/overlay/dial_hands.h"
#include "visuals/overlay/head_up_display.h"
#include "visuals/overlay/overlay_canvas.h"
#include "visuals/overlay/overlay_layers.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace octant::visuals::overlay {

/// A round dial that faces the pilot: it lies square to the body's x axis.
struct Dial {
    enum class Quantity { Speed, Altitude, Attitude, Heading, LoadFactor };
    Quantity quantity = Quantity::Speed;
    glm::dvec3 centre_m{1.0, 0.0, 0.0}; ///< from the pilot's eye, body axes; x above 0
    double radius_m = 0.05;
};

/// The dials of one type of aircraft.
struct InstrumentLayout {
    std::vector<Dial> dials;
    DialScale speed_kt;
    DialScale load_g;
};

/// Working dials in the cockpit: true airspeed in knots, altitude in feet by two hands and in
/// digits, attitude, heading on a turning card, load factor in g. Drawn in perspective where they
/// lie, over the cockpit's polygons; nothing where a look aside moves them out of the picture.
class InstrumentPanel {
public:
    /// Valid until the next call. No allocation once warmed up.
    scene::OverlayDraw draw(
        const InstrumentLayout& layout,
        const InstrumentReadings& inputs,
        const scene::Camera& camera,
        const glm::ivec2& size_px);

private:
    OverlayCanvas faces_;
    OverlayCanvas hands_;
    OverlayLayers layers_;
};

} // namespace octant::visuals::overlay
