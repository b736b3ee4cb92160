#pragma once

#include "models/heights/runway_strip.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/nature/daylight.h"
#include "visuals/nature/runway.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/decal_clipper.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace octant::visuals::planning {

/// Lays a runway on the triangles of the ground, each of its patches on each triangle, to be
/// painted right after it. What looks narrow takes the colour of what it lies on and is left out
/// from there on; so is what lies on triangles out of view. Keeps its memory.
class RunwayPainter {
public:
    /// Null: there is no runway, and nothing is painted.
    explicit RunwayPainter(std::shared_ptr<const models::heights::RunwayStrip> strip);

    void set_daylight(const nature::Daylight& day);

    /// The most triangles that it takes, of so many that are aimed at: fewer from farther off.
    int max_triangles(const glm::dvec3& eye_m, int triangle_target) const;

    /// Paints on the ground whose triangles the cutter has, the nearest first; markings only while
    /// the cutter has laid fewer than `most` triangles.
    void paint(
        const landscape::GroundMesher& ground,
        const FrameView& view,
        bool is_front_to_back,
        int most,
        DecalClipper& cutter);

private:
    /// A patch as it is seen in this frame.
    struct VisiblePatch {
        glm::dvec2 min_m;
        glm::dvec2 max_m;
        std::uint32_t colour = 0;
        bool is_marking = false;
    };

    void choose_patches(const FrameView& view);
    void paint_triangle(int most, DecalClipper& cutter) const;
    DecalClipper::Patch plan_outline(const VisiblePatch& patch) const;

    std::shared_ptr<const models::heights::RunwayStrip> strip_;
    std::vector<nature::RunwayRectangle> patches_;
    glm::vec3 light_{1.0F};
    std::vector<VisiblePatch> seen_;
    std::vector<std::uint32_t> candidates_;
    glm::dvec2 eye_m_{0.0};
};

} // namespace octant::visuals::planning
