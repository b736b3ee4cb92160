#pragma once

#include "models/texture.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::raster {

/// A texture of a model as triangles sample it, from its picture as it was loaded: nothing is copied.
struct MeshTexture {
    struct Level {
        const std::uint32_t* texels =
            nullptr; ///< row after row from the top, red in the lowest byte, alpha in the highest
        std::int32_t width = 0;
        std::int32_t height = 0;
    };

    explicit MeshTexture(const models::SurfaceTexture& from);

    models::SurfaceTexture texture;
    std::vector<Level> levels;
    bool has_holes = false;        ///< where the alpha is below the threshold
    std::uint32_t threshold = 0;   ///< 65,535 = full
    bool has_share_of_own = false; ///< transparent surfaces are more so by the texture's alpha
};

} // namespace octant::visuals::raster
