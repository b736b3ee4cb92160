#pragma once

#include "visuals/gl/object.h"
#include "visuals/scene/land_cover_contrast.h"
#include "visuals/scene/ground_texture.h"

namespace octant::visuals::gl {

/// What the texels of a ground image are.
enum class TextureKind {
    Colours, ///< red, green, blue: 3 bytes a texel
    Slopes   ///< x and y of a normal: 2 bytes a texel
};

/// A texture with all its mip levels, filtered between them (trilinear), on a GPU also along the
/// line of sight (anisotropic); beyond its edge it continues as at the edge. Throws Error when the
/// driver has no memory for it.
Object make_texture(const Functions& gl, const scene::GroundImage& image, TextureKind kind);

/// The ground's fine pattern, a byte a texel, with its own levels; it repeats beyond its edge.
Object make_detail_texture(const Functions& gl);

/// A texel for each kind (up) and pattern (right): the shares by which a colour changes.
Object make_texture(const Functions& gl, const scene::LandCoverContrast& contrast);

} // namespace octant::visuals::gl
