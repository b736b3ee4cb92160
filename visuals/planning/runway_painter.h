#pragma once

#include "models/heights/runway_strip.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/nature/daylight.h"
#include "visuals/nature/runway.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/ground_paint.h"
#include "visuals/planning/sight.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// Lays a runway on the triangles of the ground: each of its patches is cut to each triangle, a
/// little too wide, and lies in its plane, whatever the mesh, to be painted right after it. What
/// looks narrow takes the colour of what it lies on and is left out from there on; so is what lies
/// on triangles out of view. Keeps its memory.
class RunwayPainter {
public:
    /// Null: there is no runway, and nothing is painted.
    explicit RunwayPainter(std::shared_ptr<const models::heights::RunwayStrip> strip);

    void light_by(const nature::Daylight& day);

    /// The most triangles that it takes, of so many that are aimed at: fewer from farther off.
    int most_triangles(const glm::dvec3& eye_m, int triangle_target) const;

    /// Paints on GroundMesher::triangles as they are before facing, the nearest first; markings
    /// only while there are fewer than `most` triangles.
    void paint(
        const scene::TriangleDraw& triangles,
        const landscape::GroundMesher& ground,
        const FrameView& view,
        bool nearest_first,
        int most);

    /// What paint() made.
    GroundPaints paints() const { return {paints_, corners_}; }

    int triangles() const { return triangles_; }

private:
    /// A convex polygon on the strip: metres along and to the left.
    struct Piece {
        std::array<glm::dvec2, 8> corners;
        std::size_t count = 0;
    };

    /// How much of a patch lies on a triangle.
    enum class Touch : std::uint8_t { None, Part, Whole };

    /// A side of a triangle on the strip, a unit vector outwards, and how far its ends move along
    /// that for one overlap.
    struct Side {
        glm::dvec2 from_m;
        glm::dvec2 to_m;
        glm::dvec2 out;
        double from_moved_m = 0.0;
        double to_moved_m = 0.0;
    };

    /// A patch as it is seen in this frame.
    struct Seen {
        glm::dvec2 least_m;
        glm::dvec2 most_m;
        std::uint32_t colour = 0;
        bool is_marking = false;
    };

    void choose_patches(const FrameView& view);
    void paint_triangle(std::uint32_t triangle, int most);
    void place_sides();
    static Piece whole(const Seen& patch);
    Touch touch_of(const Piece& patch) const;
    Piece piece_of(const Piece& patch, double overlaps) const;
    void paint_patch(const Seen& patch, std::uint32_t triangle);
    static void cut(Piece& piece, const glm::dvec2& from, const glm::dvec2& to);

    std::shared_ptr<const models::heights::RunwayStrip> strip_;
    std::vector<nature::RunwayPatch> patches_;
    glm::vec3 light_{1.0F};
    std::vector<Seen> seen_;
    std::vector<std::uint32_t> candidates_;
    std::vector<GroundPaint> paints_;
    std::vector<glm::dvec3> corners_;
    glm::dvec3 eye_m_{0.0};
    double overlap_rad_ = 0.0;
    // The triangle at hand.
    SightPolygon triangle_;
    Plane plane_;
    std::array<Side, 3> sides_;
    int triangles_ = 0;
};

} // namespace octant::visuals::planning
