#pragma once

#include "models/colour_vertex.h"
#include "visuals/scene/frame_plan.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// A range of Veils::draw()'s indices.
struct TransparentRange {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// Transparent triangles of a frame on their way into the picture: seen through the haze, cut at the view's edges and
/// placed. Keeps its memory.
class TransparentGeometry {
public:
    /// Forgets the last frame. The haze must outlive the frame.
    void begin(const glm::mat4& world_to_clip, const glm::ivec2& size_px, const scene::Haze& haze);

    /// Adds triangles, either way round: world axes with the eye subtracted, their alpha says how much of what is
    /// behind they cover. Returns what is seen of them.
    TransparentRange add(std::span<const models::ColourVertex> vertices, std::span<const std::uint32_t> indices);

    /// All that was added. Valid until the next call of another member.
    scene::OverlayDraw draw() const { return {vertices_, indices_}; }

private:
    struct TransparentVertex {
        glm::vec4 clip{0.0F};
        /// Display values and alpha; below 0 until it is asked for.
        glm::vec4 colour{-1.0F};
        /// A bit for each plane that it is behind.
        std::uint32_t outside = 0;
    };

    TransparentVertex placed(const models::ColourVertex& vertex) const;
    void colour(const models::ColourVertex& vertex, TransparentVertex& vertex_out) const;
    void cut();
    void add_polygon(std::span<const TransparentVertex> corners);

    glm::mat4 world_to_clip_{1.0F};
    glm::vec2 size_px_{1.0F};
    const scene::Haze* haze_ = nullptr;
    std::vector<TransparentVertex> vertex_cache_;
    std::vector<TransparentVertex> polygon_;
    std::vector<TransparentVertex> scratch_;
    std::vector<scene::OverlayVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

} // namespace octant::visuals::planning
