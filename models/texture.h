#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace octant::models {

/// One resolution of a picture that lies on surfaces.
struct TextureLevel {
    int width = 0;
    int height = 0;
    /// Row after row from the top, four bytes a texel: red, green, blue as display values (models/material.h), alpha.
    std::vector<std::uint8_t> rgba;
};

/// A picture that lies on surfaces, with its mip levels. It does not change once all models are loaded.
struct TexturePicture {
    std::string name; ///< of its file, for messages
    /// The finest one first, each half as wide and high as the one before (rounded down, at least 1), the last one of
    /// one texel.
    std::vector<TextureLevel> levels;
    bool is_opaque = true; ///< no texel has an alpha below 255

    std::size_t bytes() const;
};

/// What a texture shows beyond its edge.
enum class TextureWrap : std::uint8_t { Repeat, Clamp, Mirror };

/// What the alpha of a texture does.
enum class TextureAlpha : std::uint8_t {
    /// Nothing.
    Opaque,
    /// Where it is below the threshold there is no surface, elsewhere the surface is opaque.
    Mask,
    /// It is the share of what lies behind that the surface covers.
    Blend
};

/// How a surface shows a picture. The colour of the surface is multiplied by that of the picture.
struct SurfaceTexture {
    std::shared_ptr<const TexturePicture> picture; ///< null: the surface shows none
    TextureWrap wrap_u = TextureWrap::Repeat;
    TextureWrap wrap_v = TextureWrap::Repeat;
    TextureAlpha alpha = TextureAlpha::Opaque;
    float threshold = 0.5F; ///< of TextureAlpha::Mask, 0..1

    bool operator==(const SurfaceTexture&) const = default;
};

/// The picture with its mip levels made: each texel is the mean of those below it, weighted by area and, for the
/// colours, by alpha. `finest` must have 4 * width * height bytes, at least one texel (asserted).
TexturePicture texture_picture(std::string name, TextureLevel finest);

/// Removes the finest level of a picture that has several.
void halve(TexturePicture& picture);

} // namespace octant::models
