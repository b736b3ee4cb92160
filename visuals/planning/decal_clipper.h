#pragma once

#include "visuals/planning/frame_view.h"
#include "visuals/planning/ground_decals.h"
#include "visuals/planning/view_polygon.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::planning {

/// Cuts what is painted on the ground to the ground's triangles: each piece lies in the plane of
/// its triangle, whatever the mesh, and goes a little beyond its sides, so that no gap shows
/// between two of them. On the plan places are metres east and north of the eye. Keeps its memory.
class DecalClipper {
public:
    /// A convex quadrangle on the plan, counter-clockwise.
    using Patch = std::array<glm::dvec2, 4>;

    /// The most triangles of one piece: three cuts add a corner each.
    static constexpr int max_triangles = 5;

    /// Forgets the last frame. Triangles are GroundMesher::triangles as they are before facing, and
    /// must stay until the next call.
    void begin(const scene::TriangleDraw& triangles, const FrameView& view);

    /// Takes a triangle to lay patches on.
    void set_triangle(std::uint32_t triangle);

    /// The triangle at hand: its corners on the plan, counter-clockwise.
    const std::array<glm::dvec2, 3>& corners_m() const { return corners_on_plan_m_; }

    /// False where the eye sees nothing of the triangle at hand.
    bool is_seen() const;

    /// Mean colour of its corners, display values.
    glm::vec3 colour() const;

    /// Whether the triangle at hand stands on the ground and is no part of it.
    bool is_scenery() const;

    /// Lays what of a patch lies on the triangle at hand, if anything does, so many overlaps beyond
    /// the triangle's sides.
    void add_decal(const Patch& patch, std::uint32_t colour, GroundLayer layer, double overlaps);

    /// What has been laid since begin().
    GroundDecals decals() const { return {decals_, corners_m_}; }

    int triangles() const { return triangle_count_; }

private:
    /// A convex polygon on the plan.
    struct ClippedPatch {
        std::array<glm::dvec2, max_triangles + 3> corners;
        std::size_t count = 0;
    };

    using SideFlags = std::array<bool, 3>;

    /// A side of the triangle, a unit vector outwards, and how far its ends move along that for one
    /// overlap.
    struct Side {
        glm::dvec2 from_m;
        glm::dvec2 to_m;
        glm::dvec2 out;
        double from_moved_m = 0.0;
        double to_moved_m = 0.0;
    };

    bool may_be_in_view() const;
    void place_sides();
    std::optional<SideFlags> sides_across(const ClippedPatch& patch) const;
    ClippedPatch piece_of(const ClippedPatch& patch, const SideFlags& across, double overlaps) const;
    static void cut(ClippedPatch& piece, const glm::dvec2& from, const glm::dvec2& to);

    scene::TriangleDraw triangles_;
    const FrameView* view_ = nullptr;
    double overlap_rad_ = 0.0;
    std::vector<GroundDecal> decals_;
    std::vector<glm::dvec3> corners_m_;
    int triangle_count_ = 0;
    // The triangle at hand.
    std::uint32_t number_ = 0;
    ViewPolygon triangle_;
    bool has_sides_ = false;
    Plane plane_;
    std::array<Side, 3> sides_;
    std::array<glm::dvec2, 3> corners_on_plan_m_;
};

} // namespace octant::visuals::planning
