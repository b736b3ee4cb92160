#include "visuals/raster/mesh_texture.h"

#include <bit>
#include <cassert>

namespace octant::visuals::raster {

MeshTexture::MeshTexture(const models::SurfaceTexture& from) : texture(from) {
    // The four bytes of a texel are read as one number.
    static_assert(std::endian::native == std::endian::little);
    assert(from.picture != nullptr && !from.picture->levels.empty());
    for (const models::TextureLevel& level : from.picture->levels) {
        assert(level.rgba.size() == 4 * static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height));
        levels.push_back({reinterpret_cast<const std::uint32_t*>(level.rgba.data()), level.width, level.height});
    }
    const bool is_opaque = from.picture->is_opaque;
    has_holes = from.alpha == models::TextureAlpha::Mask && !is_opaque;
    threshold = static_cast<std::uint32_t>(from.threshold * 65535.0F);
    has_share_of_own = from.alpha == models::TextureAlpha::Blend && !is_opaque;
}

} // namespace octant::visuals::raster
