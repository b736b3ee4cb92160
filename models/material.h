#pragma once

#include "models/texture.h"

#include <glm/vec3.hpp>

#include <memory>
#include <string>

namespace octant::models {

// Display values are the colours of this project: red, green and blue, 0..1, encoded as sRGB (IEC 61966-2-1), thus
// non-linear in light. They go to the screen times 255. Model files contain them, except glTF files, whose colours are
// linear in light.

/// Converts components that are linear in light, 0..1 each, to display values.
glm::dvec3 srgb_from_linear(const glm::dvec3& linear);

/// Converts display values, 0..1 each, to components that are linear in light. In double, thus a float survives the
/// conversion to linear and back to the bit.
glm::dvec3 linear_from_srgb(const glm::dvec3& display);

/// A named surface colour with an optional texture image.
struct Material {
    std::string name;
    glm::vec3 colour{0.7F}; ///< red, green, blue: display values 0..1
    /// The file of the texture image, or the name of an image inside the mesh's file; empty = none.
    std::string picture = {};
    /// The encoded image if it is inside the mesh's file, else null.
    std::shared_ptr<const std::string> picture_bytes = {};
    /// The decoded image, for drawing; none unless the reader was asked for it (meshfile::ReadOptions::textures).
    SurfaceTexture texture = {};
    /// The file of the image by which the surface glows, or the name of one inside the mesh's file; empty = none.
    std::string emissive_picture = {};
    /// The share of what is behind that it hides, 0..1.
    float opacity = 1.0F;
    /// Mirrors its surroundings as glass does though it is opaque. Only of polygon models.
    bool is_mirror = false;
};

/// Surfaces of less opacity are transparent, such as the glass of canopies; readers leave out those of less than
/// seen_from_opacity, as nothing is seen of them.
inline constexpr float opaque_from_opacity = 0.98F;
inline constexpr float seen_from_opacity = 0.02F;

inline bool is_transparent(const Material& material) { return material.opacity < opaque_from_opacity; }

inline bool is_glass(const Material& material) { return is_transparent(material) || material.is_mirror; }

/// Puts a decoded picture on a material whose file does not say what the picture's alpha does.
void set_picture(Material& material, std::shared_ptr<const TexturePicture> picture);

} // namespace octant::models
