#pragma once

#include "models/colour_vertex.h"
#include "visuals/raster/projection.h"
#include "visuals/scene/frame_plan.h"

#include <glm/mat4x4.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace octant::visuals::raster {

/// The light and the haze of a picture.
struct Light {
    glm::vec3 ambient{0.0F};
    glm::vec3 sunlight{0.0F};
    glm::vec3 to_sun{0.0F};
    glm::vec3 haze{0.0F}; ///< display values 0..1
    float per_m = 0.0F;   ///< one over the visibility; 0: no haze
    float falloff_per_m = 0.0F;
    glm::vec2 horizontal_to_sun{0.0F};
    glm::vec3 sunward_colour{0.0F}; ///< display values 0..1
    std::optional<scene::MirroredSky> mirrored_sky{};
};

Light light_of(const scene::FramePlan& plan);

/// The colour of the haze before a place in world axes with the eye subtracted, 1/128 level.
std::array<std::uint16_t, 3> haze_before(const glm::vec3& at_m, const Light& light);

/// exp(-x) for x >= 0 as the vertex stage computes it: by sums and products alone, so that all processors agree.
/// Relative error below 4e-6: that of the product x * log2(e) at x = 80, where nothing is left to see.
float exp_of_minus(float x);

/// Memory for projected vertices. All spans have as many elements as there are vertices to project.
struct VertexOutputs {
    std::span<ScreenVertex> vertices;
    std::span<ClipPosition> clip;
    std::span<FlatColour> flat; ///< only for aircraft
    std::span<LitVertex> lit{}; ///< only for aircraft that are lit in each pixel
};

/// Takes x and y in world axes with the eye subtracted to texels.
struct TexelTransform {
    glm::vec2 at_eye{0.0F};
    glm::vec2 per_m{0.0F};
};

/// How the vertices of one aircraft are turned and coloured.
struct AircraftDrawState {
    std::span<const glm::mat4> parts;
    std::span<const std::uint32_t> smooth; ///< words, from the aircraft's first
    scene::PolygonTints tints{};
    bool has_textures = false;
};

/// Projects vertices of ground, shadows and sky and hazes their colours, except those of the sky, which include it.
void project_coloured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const VertexOutputs& to);

/// Projects vertices of textured ground.
void project_textured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const TexelTransform& to_texels, const VertexOutputs& to);

/// Projects vertices of an aircraft, lights and hazes them. Of vertices with a texture the colours are those of a white
/// texel as SurfacePlanes has them, without haze; their fourth value is the haze's share.
void project_aircraft(std::span<const scene::ModelVertex> from, const AircraftDrawState& state,
    const Projection& projection, const Light& light, const VertexOutputs& to);

} // namespace octant::visuals::raster
