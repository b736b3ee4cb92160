#pragma once

#include "models/colour_vertex.h"
#include "visuals/raster/projection.h"
#include "visuals/raster/screen_vertex.h"
#include "visuals/scene/frame_plan.h"

#include <glm/mat4x4.hpp>

#include <cstdint>
#include <span>

namespace octant::visuals::raster {

/// What every corner of a picture is lit and hazed by.
struct Light {
    glm::vec3 ambient{0.0F};
    glm::vec3 sunlight{0.0F};
    glm::vec3 to_sun{0.0F};
    glm::vec3 haze{0.0F}; ///< display values 0..1
    float per_m = 0.0F;   ///< one over the visibility; 0: no haze
    float falloff_per_m = 0.0F;
    glm::vec2 horizontal_to_sun{0.0F};
    glm::vec3 sunward{0.0F}; ///< display values 0..1
};

// Where the fall of the haze's density is looked at as a straight line, and where it ends; powers
// of e.
constexpr float min_haze_fall = 4e-3F;
constexpr float max_haze_fall = 60.0F;

Light light_of(const scene::FramePlan& plan);

/// Where corners go. All spans are as long as what they are made of.
struct ScreenCorners {
    std::span<ScreenVertex> vertices;
    std::span<ClipPlace> clip;
    std::span<FlatColour> flat; ///< of aircraft alone
    std::span<LitCorner> lit{}; ///< of aircraft that are lit in each pixel; else empty
};

/// Takes x and y in world axes with the eye subtracted to texels.
struct TexelPlace {
    glm::vec2 at_eye{0.0F};
    glm::vec2 per_m{0.0F};
};

/// How the corners of one aircraft are turned and coloured.
struct AircraftLook {
    std::span<const glm::mat4> parts;
    std::span<const std::uint32_t> smooth; ///< words, from the aircraft's first
    scene::Tints tints{};
};

void place_aircraft(
    std::span<const scene::ModelVertex> from,
    const AircraftLook& look,
    const Projection& projection,
    const Light& light,
    const ScreenCorners& to);

} // namespace octant::visuals::raster
