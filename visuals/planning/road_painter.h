#pragma once

#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/nature/daylight.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/paint_cutter.h"
#include "visuals/roads/road_network.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace octant::visuals::planning {

/// Lays the roads of a ground on its triangles, to be painted right after them. Each piece of a
/// road is shown by a level that looks at most a quarter of a pixel off; what looks about
/// as narrow as a pixel takes the colour of the ground before it is left out. Keeps its memory.
class RoadPainter {
public:
    /// Paints the roads of this ground under this light from the next frame on. Loading work.
    void follow(const landscape::Ground& ground, const nature::Daylight& day);

    /// The most triangles that it takes, of so many that are aimed at.
    int most_triangles(const glm::dvec3& eye_m, int triangle_target) const;

    /// Paints on the ground whose triangles the cutter has, the nearest first, at most so many
    /// triangles.
    void paint(
        const landscape::GroundMesher& ground,
        const FrameView& view,
        bool nearest_first,
        int most,
        PaintCutter& cutter);

private:
    /// What stretches between the points of a level show, display values.
    struct Look {
        glm::vec3 road;
        glm::vec3 ground;
    };

    struct PieceLook {
        std::array<std::vector<Look>, roads::level_error_m.size()> levels;
        glm::dvec3 middle_m{0.0};
        double radius_m = 0.0;
    };

    /// A stretch as it is seen in this frame, on the plan of the cutter.
    struct Seen {
        PaintCutter::Patch patch;
        glm::dvec2 least_m;
        glm::dvec2 most_m;
        std::uint32_t colour = 0;
    };

    /// Where the stretches of a piece lie in seen_, if they have been chosen in this frame.
    struct Chosen {
        std::uint64_t frame = 0;
        std::size_t first = 0;
        std::size_t end = 0;
    };

    void choose(std::uint32_t number, const FrameView& view);
    void paint_triangle(const FrameView& view, int limit, PaintCutter& cutter);

    std::shared_ptr<const roads::RoadNetwork> network_;
    std::vector<PieceLook> looks_; ///< of the network's pieces
    std::vector<Chosen> chosen_;   ///< likewise
    std::vector<Seen> seen_;
    std::vector<std::uint32_t> candidates_;
    std::vector<std::uint32_t> numbers_;
    std::uint64_t frame_ = 0;
};

} // namespace octant::visuals::planning
