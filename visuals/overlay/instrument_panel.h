#pragma once

#include "visuals/overlay/overlay.h"
#include "visuals/overlay/overlay_canvas.h"
#include "visuals/scene/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace octant::visuals::overlay {

// Where the hands of dials stand: angles clockwise from the top, radians.

/// Ends of a dial's scale, in the unit that it shows.
struct DialScale {
    double min = 0.0;
    double max = 1.0;

    bool operator==(const DialScale&) const = default;
};

/// Hand of a dial whose scale runs clockwise over most of a turn, from the left of its foot to the right; beyond the
/// ends the hand stays there.
double scale_hand_rad(double value, const DialScale& scale);

/// Hand that turns once in `feet_per_turn`, straight up at sea level.
double altitude_hand_rad(double height_m, double feet_per_turn);

/// A scale in knots from 0 to a round number that holds a speed.
DialScale speed_scale_kt(double max_speed_mps);

/// A scale in g that holds two load factors and 1 g.
DialScale load_scale_g(double min_load_factor, double max_load_factor);

/// Distance of the numbers of a scale, in its unit: a round one, of which no more than nine fit, or five where they
/// have three digits.
double label_step(const DialScale& scale);

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

/// Adds working dials in the cockpit to the layers: true airspeed in knots, altitude in feet by two hands and in
/// digits, attitude, heading on a turning card, load factor in g. Drawn in perspective where they lie, over the
/// cockpit's polygons; nothing where a look aside moves them out of the picture. `canvases`: the caller's, for faces
/// and hands.
void add_instruments(OverlayLayers& layers, std::array<OverlayCanvas, 2>& canvases, const InstrumentLayout& layout,
    const InstrumentReadings& readings, const scene::Camera& camera, const glm::ivec2& size_px);

} // namespace octant::visuals::overlay
