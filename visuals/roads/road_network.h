#pragma once

#include "visuals/roads/road_curve.h"
#include "visuals/roads/road_cost_grid.h"
#include "visuals/terrain/ground_samples.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::roads {

/// Made-up roads along the valleys of a ground. They follow from its heights alone, and from what
/// they have to keep off.
class RoadNetwork {
public:
    /// Loading work; the ground is needed by the constructor alone. Without roads where the ground
    /// is too small, too coarse or too rough.
    RoadNetwork(const terrain::GroundSamples& ground, const RoadConstraints& constraints);

    std::span<const RoadSection> sections() const { return sections_; }

    /// False only where no road touches this box.
    bool may_intersect(const glm::dvec2& min_m, const glm::dvec2& max_m) const;

    /// Appends numbers of the pieces that may touch this box, some of them more than once.
    void sections_in_box(
        const glm::dvec2& min_m,
        const glm::dvec2& max_m,
        std::vector<std::uint32_t>& numbers) const;

    /// Whether a road's middle line is nearer than so much.
    bool is_near(const glm::dvec2& place_m, double distance_m) const;

private:
    /// Squares of a grid over the ground.
    struct GridRange {
        glm::ivec2 first;
        glm::ivec2 last;
    };

    void build(const terrain::GroundSamples& ground, const RoadConstraints& constraints);
    void index();
    void add_cells(
        const RoadPoint& from,
        const RoadPoint& to,
        std::uint32_t number,
        std::vector<std::pair<std::uint32_t, std::uint32_t>>& places) const;
    GridRange grid_range(const glm::dvec2& min_m, const glm::dvec2& max_m) const;
    std::size_t grid_cell(int column, int row) const;

    std::vector<RoadSection> sections_;
    glm::dvec2 first_m_{0.0}; ///< of the squares
    double grid_cell_m_ = 0.0;
    glm::ivec2 grid_size_{0};
    std::vector<std::uint32_t> first_of_; ///< for each square, and the end, a place in sections_by_cell_
    std::vector<std::uint32_t> sections_by_cell_;
    /// How often a piece lies in a square south-west of here: (columns + 1) x (rows + 1).
    std::vector<std::uint32_t> sums_;
};

} // namespace octant::visuals::roads
