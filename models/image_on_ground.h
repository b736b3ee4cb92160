#pragma once

#include "models/height_field.h"
#include "models/image.h"

namespace octant::models {

/// The image laid over the ground: reaches from edge to edge of the field, north up, alpha 0 where
/// it has nothing. A placed image is brought into the field's coordinate system (bilinear, to an
/// eighth of a pixel); its pixels keep about their size but are no larger than the field's
/// spacing. One without a place is stretched over the field as it is. At most `largest_px` a side.
/// `note` says where the image leaves ground uncovered.
///
/// Throws Error for a placed image over ground without a coordinate system, and for one that lies
/// elsewhere.
Image laid_on_ground(Image image, const HeightField& field, int largest_px);

} // namespace octant::models
