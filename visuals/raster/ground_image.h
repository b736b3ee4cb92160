#pragma once

#include "visuals/raster/vertex_stage.h"
#include "visuals/scene/ground_texture.h"

#include <array>
#include <cstdint>
#include <vector>

namespace octant::visuals::raster {

/// The ground's texture as it looks under the light: colours, darkened by their normals, in levels
/// of half the size each.
class GroundImage {
public:
    /// At least two texels each way.
    struct Level {
        Level(int columns, int rows)
            : width(columns)
            , height(rows)
            , last_place{(columns - 1) * 65536.0 - 1.0, (rows - 1) * 65536.0 - 1.0} {}

        int width;
        int height;
        /// Across and up, with a texel right and above: 2^-16 texel; the rest are 0.
        alignas(32) std::array<double, 4> last_place;
        std::vector<std::uint32_t> texels; ///< red in the lowest byte; rows from the south
    };

    void load(const scene::GroundTexture& texture);

    /// Lights the texture anew if the light is another one than last time.
    void light(const Light& light);

    /// Takes places in shares of the texture, which has been loaded, to texels whose middles lie at
    /// whole numbers.
    TexelPlace texel_place(const scene::TexturePlace& place) const;

    const std::vector<Level>& levels() const { return levels_; }

private:
    scene::GroundTexture texture_;
    Light light_;
    std::vector<Level> levels_;
};

} // namespace octant::visuals::raster
