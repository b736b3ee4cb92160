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

/// Largest width and height of a texture made from samples, texels.
inline constexpr int max_sampled_size_texels = 4097;

/// Normals and colours of the ground; colours are those of `drape` where it is given and has an opaque pixel. One texel
/// a sample; ground with more than max_sampled_size_texels samples a side gives every second sample, fourth, ... with
/// slope and cover filtered to that distance, so that the finer levels of a large imported ground are not read. `drape`
/// covers the ground from edge to edge, north up, and has at most max_texture_size_px pixels a side (asserted). Colours
/// include the shadows of the relief. Uses all processors; the bytes do not depend on their number.
scene::GroundTexture ground_texture(const terrain::GroundSamples& ground, const scene::AirSettings& settings,
    const models::heights::Image* drape, const nature::Climate& climate = {});

/// A copy without the texels, for frame plans: the texels are in the renderer.
scene::GroundTexture without_texels(const scene::GroundTexture& texture);

/// The transforms from world axes with this eye subtracted to the texture.
scene::GroundTextureTransforms ground_texture_transforms(const scene::GroundTexture& texture, const glm::dvec3& eye_m);

} // namespace octant::visuals::landscape
