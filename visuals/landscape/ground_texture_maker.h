#pragma once

#include "models/heights/image.h"
#include "visuals/nature/climate.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"
#include "visuals/terrain/ground_query.h"

#include <glm/vec3.hpp>

namespace octant::visuals::landscape {

/// Largest width and height of a drape, pixels.
inline constexpr int max_texture_size_px = 8192;

/// Largest width and height of what is made of samples, texels.
inline constexpr int max_sampled_size_texels = 4097;

/// The normals of the ground, and its colours or, where `drape` is given and there, the image's. A texel a sample; of
/// ground with more than max_sampled_size_texels a side, every second one, fourth, ... with slope and cover filtered to
/// that distance, so that a large imported ground gives its coarser levels and the others stay on the disk. `drape`
/// reaches from edge to edge of the ground, north up, and has at most max_texture_size_px pixels a side (asserted).
/// Uses all processors; same bytes for any number of them. What the relief takes from the light is in the colours.
scene::GroundTexture ground_texture(const terrain::GroundSamples& ground, const scene::AirSettings& settings,
    const models::heights::Image* drape, const nature::Climate& climate = {});

/// The same without its texels, which a renderer has: all that plans need.
scene::GroundTexture without_texels(const scene::GroundTexture& texture);

/// Where an eye stands in the texture.
scene::GroundTextureTransforms ground_texture_transforms(const scene::GroundTexture& texture, const glm::dvec3& eye_m);

} // namespace octant::visuals::landscape
