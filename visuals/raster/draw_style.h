#pragma once

#include "visuals/raster/triangle.h"
#include "visuals/scene/paint_step.h"

#include <glm/vec4.hpp>

#include <cstdint>
#include <span>

namespace octant::visuals::raster {

/// How the triangles of one step are drawn.
struct DrawStyle {
    Fill fill = Fill::Gouraud;
    scene::DepthUse depth = scene::DepthUse::None;
    std::uint16_t group = 0; ///< depth group, from 1
    bool culls_back_faces = false;
    bool has_detail_texture = false;                   ///< ground whose corners say their share of it
    float opacity = 1.0F;                     ///< as scene::PaintStep
    std::span<const glm::vec4> clip_planes{}; ///< as scene::Clip
};

} // namespace octant::visuals::raster
