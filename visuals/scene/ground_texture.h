#pragma once

#include "models/heights/image.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"
#include "visuals/terrain/ground_samples.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// Values over the ground, row after row from the south, each from the west.
struct GroundImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> texels;
    glm::dvec2 first_m{0.0}; ///< world place of the first texel's middle
    glm::dvec2 step_m{1.0};  ///< from one texel's middle to the next
};

/// What the ground is lit and coloured with at each pixel instead of at each vertex.
struct GroundTexture {
    GroundImage albedo;          ///< 3 bytes a texel: red, green, blue before light falls on it
    GroundImage normal;          ///< 2 bytes a texel: x and y of the unit normal, each 128 + 127 x
    glm::vec3 mean_colour{0.0F}; ///< of the lit ground, linear parts 0..1
};

/// Largest width and height of a drape, pixels.
inline constexpr int largest_texture = 8192;

/// Largest width and height of what is made of samples, texels.
inline constexpr int largest_from_samples = 4097;

/// The normals of the ground, and its colours or, where `drape` is given and there, the image's. A
/// texel a sample; of ground with more than largest_from_samples a side, every second one, fourth,
/// ... with slope and cover filtered to that distance, so that a large imported ground gives its
/// coarser levels and the others stay on the disk. `drape` reaches from edge to edge of the ground,
/// north up, and has at most largest_texture pixels a side (asserted). Uses all processors; same
/// bytes for any number of them.
GroundTexture ground_texture(
    const terrain::GroundSamples& ground,
    const AirSettings& settings,
    const models::heights::Image* drape);

/// The same without its texels, which a renderer has: all that plans need.
GroundTexture without_texels(const GroundTexture& texture);

/// Where an eye stands in the texture.
TexturePlaces texture_places(const GroundTexture& texture, const glm::dvec3& eye_m);

} // namespace octant::visuals::scene
