#pragma once

#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/nature/daylight.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/decal_clipper.h"
#include "visuals/roads/road_network.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace octant::visuals::planning {

/// Lays the roads of a ground on its triangles, to be painted right after them. Each piece of a
/// road is shown by a level of detail; what looks about as narrow as a pixel takes the colour of
/// the ground before it is left out. Keeps its memory.
class RoadPainter {
public:
    /// Paints the roads of this ground under this light from the next frame on. Loading work.
    void follow(const landscape::Ground& ground, const nature::Daylight& day);

    /// The most triangles that it takes, of so many that are aimed at: none where no road can be
    /// seen, fewer from high up.
    int max_triangles(const FrameView& view, int triangle_target) const;

    /// Paints on the ground whose triangles the cutter has, the nearest first, at most so many
    /// triangles.
    void paint(
        const landscape::GroundMesher& ground,
        const FrameView& view,
        bool is_front_to_back,
        int most,
        DecalClipper& cutter);

private:
    struct SectionLight {
        glm::dvec3 middle_m{0.0};
        double radius_m = 0.0;
        /// For each level where the light of its stretches lies in lights_.
        std::array<std::size_t, roads::level_error_m.size()> first_light{};
        std::array<bool, roads::level_error_m.size()> is_lit{};
    };

    /// A stretch as it is seen in this frame, on the plan of the cutter.
    struct VisiblePatch {
        DecalClipper::Patch patch;
        glm::dvec2 min_m;
        glm::dvec2 max_m;
        glm::vec3 colour;
        /// Share of its own colour; the rest is the ground's.
        float own = 1.0F;
    };

    /// Where the stretches of a piece lie in seen_, if they have been chosen in this frame.
    struct SectionPatches {
        std::uint64_t frame = 0;
        std::size_t first = 0;
        std::size_t end = 0;
    };

    void light(std::uint32_t number, std::size_t level);
    void choose(std::uint32_t number, const FrameView& view);
    void paint_triangle(const FrameView& view, int limit, DecalClipper& cutter);

    std::shared_ptr<const landscape::Ground> ground_;
    std::optional<nature::Daylight> day_;
    std::shared_ptr<const roads::RoadNetwork> network_;
    double lowest_m_ = 0.0;         ///< of the roads
    std::vector<SectionLight> pieces_;     ///< of the network's
    std::vector<glm::vec3> lights_; ///< of stretches, worked out when they are first seen
    std::vector<SectionPatches> chosen_;    ///< one a piece
    std::vector<VisiblePatch> seen_;
    std::vector<std::uint32_t> candidates_;
    std::vector<std::uint32_t> numbers_;
    std::uint64_t frame_ = 0;
};

} // namespace octant::visuals::planning
