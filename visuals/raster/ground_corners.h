#pragma once

#include "models/colour_vertex.h"
#include "visuals/raster/projection.h"
#include "visuals/raster/vertex_stage.h"

#include <span>

namespace octant::visuals::raster {

/// Corners that have the colours they show, but for haze; the sky has none.
void place_coloured(
    std::span<const models::ColourVertex> from,
    const Projection& projection,
    const Light& light,
    const ScreenCorners& to);

/// Corners of ground that a texture colours.
void place_textured(
    std::span<const models::ColourVertex> from,
    const Projection& projection,
    const Light& light,
    const TexelPlace& to_texels,
    const ScreenCorners& to);

} // namespace octant::visuals::raster
