#pragma once

#include "visuals/terrain/ground_query.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::roads {

/// The limits of where roads may run.
struct RoadConstraints {
    double water_m = 0.0;
    /// Nobody lives higher above the water than this.
    double max_town_height_m = 1500.0;
    /// Whether a place must be left free; may be empty.
    std::function<bool(const glm::dvec2& place_m)> is_blocked;
};

/// The ground in cells some hundred metres wide, for those who build roads: how steep each is, how high above the floor
/// of its valley, and whether nobody builds there. Cells are numbered row after row from the south-west.
class RoadCostGrid {
public:
    /// The ground is needed by the constructor alone. Without cells where the ground is too small or its cells would be
    /// too wide to show valleys.
    RoadCostGrid(const terrain::GroundSamples& ground, const RoadConstraints& constraints);

    int columns() const { return columns_; }

    int rows() const { return rows_; }

    double cell_m() const { return cell_m_; }

    std::size_t cell(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    }

    glm::ivec2 column_row(std::size_t cell) const {
        const auto columns = static_cast<std::size_t>(columns_);
        return {static_cast<int>(cell % columns), static_cast<int>(cell / columns)};
    }

    /// The middle of a cell in world axes.
    glm::dvec2 place_m(std::size_t cell) const { return first_m_ + cell_m_ * glm::dvec2(column_row(cell)); }

    double height_m(std::size_t cell) const { return heights_m_[cell]; }

    /// Above the lowest ground within some 1.5 km.
    double height_above_valley_m(std::size_t cell) const { return heights_m_[cell] - valley_floors_m_[cell]; }

    /// Metres up a metre, of the ground around it.
    double slope(std::size_t cell) const { return slopes_[cell]; }

    /// Neither water, a cliff nor taken.
    bool is_free(std::size_t cell) const { return free_[cell] != 0; }

    /// Of a road between neighbouring free cells: its length on even ground in a valley, and more where it climbs, lies
    /// across a slope or above the valley.
    double cost_m(std::size_t from, std::size_t to) const;

private:
    void read(const terrain::GroundSamples& ground, int stride, const RoadConstraints& constraints);
    void find_slopes();
    void find_valley_floors();

    int columns_ = 0;
    int rows_ = 0;
    double cell_m_ = 0.0;
    glm::dvec2 first_m_{0.0};
    std::vector<double> heights_m_;
    std::vector<double> valley_floors_m_;
    std::vector<double> slopes_;
    std::vector<std::uint8_t> free_;
};

/// Cells that a road goes through, neighbours of the grid or a knight's move apart, from one place where roads end or
/// meet to the next.
using Route = std::vector<std::size_t>;

/// Where people live: the best cell of each block some kilometres wide that has a good one, low in its valley and
/// level, at most a few hundred in all.
std::vector<std::size_t> find_towns(const RoadCostGrid& ground, const RoadConstraints& constraints);

/// Roads between towns that are near each other, each by the cheapest way, as few as join all that can be joined, and
/// some more where the way around would be long. No two run side by side in the same cells: what they share is a route
/// of its own.
std::vector<Route> find_routes(const RoadCostGrid& ground, const std::vector<std::size_t>& towns);

inline constexpr double half_width_m = 3.5;

/// A point of a road's middle line, and the way from there to its left edge.
struct RoadPoint {
    glm::dvec2 at_m;
    glm::dvec2 to_left_edge_m;
};

/// How far a level's middle line may lie off the finest one, metres.
inline constexpr std::array<double, 4> level_error_m = {0.1, 0.5, 2.0, 8.0};

/// No segment of a level is longer, except one step of the finest line: each segment has one light.
inline constexpr std::array<double, level_error_m.size()> max_segment_length_m = {25.0, 60.0, 150.0, 400.0};

/// A section of a road some hundred metres long, in levels of detail whose ends are the same. World axes.
struct RoadSection {
    std::array<std::vector<RoadPoint>, level_error_m.size()> levels; ///< at least two points each
    glm::dvec2 min_m{0.0};                                           ///< of its edges
    glm::dvec2 max_m{0.0};
};

/// The middle line through these places, rounded like a road, its ends where they are. Where rounding would lead it
/// over a place that `is_free` denies it goes nearly straight from place to place; empty where that is denied, too.
std::vector<glm::dvec2> smooth_centre_line(
    std::span<const glm::dvec2> places_m, double cell_m, const std::function<bool(const glm::dvec2&)>& is_free);

/// Simplifies a line (Douglas and Peucker 1973). Returns the indices of the points that stay, the first and the last
/// among them. No point lies farther than `error_m` from the simplified line, and no segment is longer than `max_gap_m`
/// unless it is one of the given line.
std::vector<std::size_t> simplify_line(std::span<const glm::dvec2> line_m, double error_m, double max_gap_m);

/// Cuts a line into sections; it is a half width longer at both ends, so that roads that meet there leave no gap.
void append_sections(std::vector<glm::dvec2> line_m, std::vector<RoadSection>& sections);

/// Made-up roads along the valleys of a ground. They follow from its heights alone, and from what they have to keep
/// off.
class RoadNetwork {
public:
    /// Loading work; the ground is needed by the constructor alone. Without roads where the ground is too small, too
    /// coarse or too rough.
    RoadNetwork(const terrain::GroundSamples& ground, const RoadConstraints& constraints);

    std::span<const RoadSection> sections() const { return sections_; }

    /// False only where no road touches this box.
    bool may_intersect(const glm::dvec2& min_m, const glm::dvec2& max_m) const;

    /// Appends numbers of the sections that may touch this box, some of them more than once.
    void sections_in_box(const glm::dvec2& min_m, const glm::dvec2& max_m, std::vector<std::uint32_t>& numbers) const;

    /// Whether the middle line of a road is nearer than `distance_m`.
    bool is_near(const glm::dvec2& place_m, double distance_m) const;

private:
    /// Squares of a grid over the ground.
    struct GridRange {
        glm::ivec2 first;
        glm::ivec2 last;
    };

    void build(const terrain::GroundSamples& ground, const RoadConstraints& constraints);
    void index();
    void add_cells(const RoadPoint& from, const RoadPoint& to, std::uint32_t number,
        std::vector<std::pair<std::uint32_t, std::uint32_t>>& places) const;
    GridRange grid_range(const glm::dvec2& min_m, const glm::dvec2& max_m) const;
    std::size_t grid_cell(int column, int row) const;

    std::vector<RoadSection> sections_;
    glm::dvec2 first_m_{0.0}; ///< of the squares
    double grid_cell_m_ = 0.0;
    glm::ivec2 grid_size_{0};
    std::vector<std::uint32_t> first_of_; ///< for each square, and the end, a place in sections_by_cell_
    std::vector<std::uint32_t> sections_by_cell_;
    /// How often a section lies in a square south-west of here: (columns + 1) x (rows + 1).
    std::vector<std::uint32_t> sums_;
};

} // namespace octant::visuals::roads
