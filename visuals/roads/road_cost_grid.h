#pragma once

#include "visuals/terrain/ground_samples.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace octant::visuals::roads {

/// What roads on a ground keep to.
struct RoadConstraints {
    double water_m = 0.0;
    /// Nobody lives higher above the water than this.
    double max_town_height_m = 1500.0;
    /// Whether a place must be left free; may be empty.
    std::function<bool(const glm::dvec2& place_m)> is_blocked;
};

/// A ground as builders of roads see it: on cells some hundred metres wide, how steep it is, how
/// high above the floor of its valley, and where nobody builds. Cells are numbered row after row
/// from the south-west.
class RoadCostGrid {
public:
    /// The ground is needed by the constructor alone. Without cells where the ground is too small
    /// or its cells would be too wide to show valleys.
    RoadCostGrid(const terrain::GroundSamples& ground, const RoadConstraints& constraints);

    int columns() const { return columns_; }

    int rows() const { return rows_; }

    double cell_m() const { return cell_m_; }

    std::size_t cell(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }

    glm::ivec2 column_row(std::size_t cell) const {
        const auto columns = static_cast<std::size_t>(columns_);
        return {static_cast<int>(cell % columns), static_cast<int>(cell / columns)};
    }

    /// The middle of a cell in world axes.
    glm::dvec2 place_m(std::size_t cell) const {
        return first_m_ + cell_m_ * glm::dvec2(column_row(cell));
    }

    double height_m(std::size_t cell) const { return heights_m_[cell]; }

    /// Above the lowest ground within some 1.5 km.
    double height_above_valley_m(std::size_t cell) const { return heights_m_[cell] - valley_floors_m_[cell]; }

    /// Metres up a metre, of the ground around it.
    double slope(std::size_t cell) const { return slopes_[cell]; }

    /// Neither water, a cliff nor taken.
    bool is_free(std::size_t cell) const { return free_[cell] != 0; }

    /// Of a road between neighbouring free cells: its length on even ground in a valley, and more
    /// where it climbs, lies across a slope or above the valley.
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

} // namespace octant::visuals::roads
