#pragma once

#include "visuals/raster/vertex_stage.h"
#include "visuals/scene/frame_plan.h"

#include <array>
#include <cstdint>
#include <vector>

namespace octant::visuals::raster {

/// The ground's texture as it looks under the light: colours, darkened by their normals, in levels of half the size
/// each.
class LitGroundTexture {
public:
    /// At least two texels each way.
    struct MipLevel {
        MipLevel(int columns, int rows)
            : width(columns), height(rows), stride(stride_of(columns)), texels(number(0, rows)) {}

        int width;
        int height;
        int stride;                        ///< texels from a row to the next
        std::vector<std::uint32_t> texels; ///< red in the lowest byte; rows from the south

        std::size_t number(int column, int row) const {
            return static_cast<std::size_t>(row) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(column);
        }

    private:
        /// An odd number of cache lines: texels above each other share no place in a cache.
        static int stride_of(int columns) { return (columns + line - 1) / line / 2 * 2 * line + line; }

        static constexpr int line = 16;
    };

    void load(const scene::GroundTexture& texture);

    /// Lights the texture anew if the light is another one than last time.
    void light(const Light& light);

    /// Takes places in shares of the texture, which has been loaded, to texels whose middles lie at whole numbers.
    TexelTransform texel_transform(const scene::TextureTransform& place) const;

    const std::vector<MipLevel>& levels() const { return levels_; }

private:
    scene::GroundTexture texture_;
    Light light_;
    std::vector<MipLevel> levels_;
};

} // namespace octant::visuals::raster
