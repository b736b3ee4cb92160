#pragma once

#include "visuals/gl/object.h"
#include "visuals/scene/ground_texture.h"

namespace octant::visuals::gl {

enum class TextureKind {
    Colours, ///< 3 bytes a texel
    Slopes   ///< 2 bytes a texel
};

/// A texture with all its smaller sizes, filtered between them, on a GPU also along the line of
/// sight; beyond its edge it continues as at the edge. Throws Error when the driver has
/// no memory for it.
Object make_texture(const Functions& gl, const scene::GroundImage& image, TextureKind kind);

} // namespace octant::visuals::gl
