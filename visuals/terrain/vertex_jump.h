#pragma once

#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/mesh_surface.h"
#include "visuals/terrain/picture_view.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::terrain {

/// The largest change of the drawn ground from one frame to the next (popping).
struct VertexJump {
    double jump_px = 0.0;
    glm::dvec3 place_m{0.0}; ///< Where it happens, on the later mesh.
};

/// Measures popping along a flight. Its memory is reused from frame to frame.
class JumpMeter {
public:
    /// Takes the next frame's mesh, relative to `view.eye_m`, and compares it with the last one,
    /// both as seen from `view`: at each vertex of either mesh that both frames show, how far apart
    /// the two surfaces are on the screen. Returns nothing for the first frame.
    std::optional<VertexJump> next(const GroundMesh& mesh, const PictureView& view);

private:
    struct Frame {
        MeshSurface surface;
        std::vector<glm::dvec3> vertices_m; ///< In world axes.
        PictureView view;
    };

    static void
    compare_at(const Frame& own, const Frame& other, const Frame& later, VertexJump& most);

    std::array<Frame, 2> frames_;
    std::size_t taken_ = 0;
    std::vector<std::uint8_t> used_; ///< For each vertex whether a triangle uses it.
};

} // namespace octant::visuals::terrain
