#pragma once

#include "models/colour_vertex.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/mesh_surface.h"
#include "visuals/terrain/perspective_view.h"

#include <glm/gtc/type_precision.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::terrain {

/// The largest change of the drawn ground from one frame to the next (popping).
struct VertexPopping {
    double popping_px = 0.0;
    glm::dvec3 place_m{0.0}; ///< Where it happens, on the later mesh.
};

/// Measures popping along a flight over one ground. Its memory is reused from frame to frame.
class PoppingMeter {
public:
    /// Takes the next frame's mesh, relative to `view.eye_m`, and compares it with the last one, both as seen from
    /// `view`: at each vertex of either mesh that both frames show, how far apart the two surfaces are on the screen.
    /// Returns nothing for the first frame.
    std::optional<VertexPopping> next(const GroundMesh& mesh, const PerspectiveView& view);

private:
    /// A frame's mesh and what finds the height of its surface.
    class Frame {
    public:
        void set_mesh(const GroundMesh& mesh, const PerspectiveView& view);

        const PerspectiveView& view() const { return view_; }

        /// Calls set_mesh(number, position in world axes) for the vertices that triangles use.
        template <typename Take>
        void for_each_used(const Take& set_mesh) const;

        /// The height of this frame's surface at a vertex of another one; nothing where there is none.
        std::optional<double> height_at(const Frame& other, std::uint32_t vertex);

    private:
        std::optional<double> own_height_at(const glm::dvec3& place_m) const;
        std::size_t slot_of(const glm::i64vec2& cell) const;

        PerspectiveView view_;
        std::vector<models::ColourVertex> vertices_;
        std::vector<std::uint32_t> indices_;
        std::vector<VertexMorph> morphs_;    ///< Empty where the mesh has none.
        std::vector<glm::dvec3> vertices_m_; ///< In world axes.
        std::vector<std::uint8_t> used_;     ///< For each vertex whether a triangle uses it.
        std::vector<std::uint32_t> slots_;   ///< For each hash slot a vertex + 1; 0 = none.
        MeshSurface surface_;
        bool has_surface_ = false; ///< Whether surface_ is that of this mesh.
    };

    static void compare_at(const Frame& own, Frame& other, const Frame& later, VertexPopping& most);

    std::array<Frame, 2> frames_;
    std::size_t taken_ = 0;
};

} // namespace octant::visuals::terrain
