#pragma once

#include "models/colour_vertex.h"
#include "visuals/raster/projection.h"
#include "visuals/raster/vertex_stage.h"

#include <span>

namespace octant::visuals::raster {

/// Corners that have the colours they show, but for haze; the sky has none.
void project_coloured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const VertexOutputs& to);

/// Corners of ground that a texture colours.
void project_textured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const TexelTransform& to_texels, const VertexOutputs& to);

} // namespace octant::visuals::raster
