#pragma once

#include "models/heights/height_field.h"
#include "models/heights/image.h"

#include <glm/vec2.hpp>

#include <optional>
#include <string>

namespace octant::models::heights {

/// What an image is laid over: ground about its centre, whoever stores its heights.
struct GroundArea {
    std::string name;
    glm::dvec2 half_extent_m{0.0}; ///< from the centre, east and north
    double spacing_m = 1.0;        ///< of its samples
    std::optional<CoordinateSystem> system;
};

GroundArea area_of(const HeightField& field);

/// The image laid over the ground: reaches from edge to edge of it, north up, alpha 0 where it has nothing. A placed
/// image is brought into the ground's coordinate system (bilinear, to an eighth of a pixel); its pixels keep about
/// their size but are no larger than the ground's spacing. One without a place is stretched over the ground as it is.
/// At most `largest_px` a side. `note` says where the image leaves ground uncovered.
///
/// Throws Error for a placed image over ground without a coordinate system, and for one that lies elsewhere.
Image resampled_to_ground(Image image, const GroundArea& ground, int largest_px);

} // namespace octant::models::heights
