#pragma once

#include "visuals/gl/object.h"

#include <cstdint>

namespace octant::visuals::gl {

/// What the vertices of one aircraft have in common: scene::AircraftDraw, scene::RefinedDraw.
struct ModelInstance {
    std::uint32_t first_part = 0;
    std::uint32_t first_smooth = 0;
    std::uint32_t smooth_tint = 0;
    std::uint32_t flat_tint = 0;
};

/// The vertex array of scene::ModelVertex, one ModelInstance an instance.
Object make_model_array(
    const Functions& gl,
    GLuint vertices,
    GLuint indices,
    GLuint instances,
    const char* label = "aircraft");

} // namespace octant::visuals::gl
