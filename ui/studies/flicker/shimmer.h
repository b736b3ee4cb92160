#pragma once

#include "ui/flight/flight_cameras.h"
#include "visuals/scene/picture.h"
#include "visuals/terrain/ground_samples.h"

#include <glm/vec2.hpp>

#include <vector>

namespace octant::ui::studies::flicker {

/// A pixel of one frame and where the ground that it shows was in the frame before.
struct ReprojectedPixel {
    glm::ivec2 pixel{0};    ///< column and row from the upper left
    glm::dvec2 before{0.0}; ///< the same in the frame before, between pixels; whole = a centre
};

/// Every fourth pixel, both ways, of the later frame that shows ground which the earlier one
/// shows too, at full resolution; not those near the aircraft. `radius_m`: of the earth, 0 = flat.
std::vector<ReprojectedPixel> reprojected_pixels(
    const visuals::terrain::GroundSamples& ground,
    const flight::FlightCamera& earlier,
    const flight::FlightCamera& later,
    const glm::ivec2& size_px,
    double radius_m);

/// Mean absolute change of luminance (0 to 255) over the places; 0 without any.
double mean_change(
    const visuals::scene::Picture& earlier,
    const visuals::scene::Picture& later,
    const std::vector<ReprojectedPixel>& matches);

} // namespace octant::ui::studies::flicker
