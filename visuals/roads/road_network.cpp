#include "visuals/roads/road_network.h"

#include "visuals/roads/road_routes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace octant::visuals::roads {

namespace {

constexpr double min_square_m = 150.0;
constexpr double max_squares = 700.0; ///< a side

/// Height between samples; those of the border beyond it.
double height_at(const terrain::GroundSamples& ground, const glm::dvec2& place_m) {
    const glm::dvec2 last(ground.columns() - 2, ground.rows() - 2);
    const glm::dvec2 grid =
        glm::clamp(ground.grid_from_world(place_m.x, place_m.y), glm::dvec2(0.0), last);
    const glm::ivec2 cell(grid);
    const glm::dvec2 part = grid - glm::dvec2(cell);
    const auto along = [&](int row) {
        return glm::mix(ground.height_m(cell.x, row), ground.height_m(cell.x + 1, row), part.x);
    };
    return glm::mix(along(cell.y), along(cell.y + 1), part.y);
}

/// Whether the middle line of a piece is nearer to a place than so much.
bool is_nearer(const RoadSection& section, const glm::dvec2& place_m, double distance_m) {
    const std::vector<RoadPoint>& line = section.levels[0];
    for (std::size_t i = 1; i < line.size(); ++i) {
        if (distance_to_segment_m(place_m, line[i - 1].at_m, line[i].at_m) < distance_m) {
            return true;
        }
    }
    return false;
}

} // namespace

RoadNetwork::RoadNetwork(const terrain::GroundSamples& ground, const RoadConstraints& constraints) {
    build(ground, constraints);
    if (!sections_.empty()) {
        index();
    }
}

void RoadNetwork::build(const terrain::GroundSamples& ground, const RoadConstraints& constraints) {
    const RoadCostGrid cells(ground, constraints);
    const auto is_free = [&](const glm::dvec2& place_m) {
        return height_at(ground, place_m) > constraints.water_m &&
               !(constraints.is_blocked && constraints.is_blocked(place_m));
    };
    std::vector<glm::dvec2> places_m;
    for (const Route& route : find_routes(cells, find_towns(cells, constraints))) {
        places_m.clear();
        for (const std::size_t cell : route) {
            places_m.push_back(cells.place_m(cell));
        }
        std::vector<glm::dvec2> line_m = smooth_centre_line(places_m, cells.cell_m(), is_free);
        if (!line_m.empty()) {
            append_sections(std::move(line_m), sections_);
        }
    }
}

std::size_t RoadNetwork::grid_cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_size_.x) +
           static_cast<std::size_t>(column);
}

RoadNetwork::GridRange
RoadNetwork::grid_range(const glm::dvec2& min_m, const glm::dvec2& max_m) const {
    const glm::dvec2 end(grid_size_);
    const auto clamped = [&](const glm::dvec2& at_m) {
        return glm::ivec2(
            glm::clamp(glm::floor((at_m - first_m_) / grid_cell_m_), glm::dvec2(-1.0), end));
    };
    return {glm::max(clamped(min_m), glm::ivec2(0)), glm::min(clamped(max_m), grid_size_ - 1)};
}

/// The squares that a stretch of a piece may touch.
void RoadNetwork::add_cells(
    const RoadPoint& from,
    const RoadPoint& to,
    std::uint32_t number,
    std::vector<std::pair<std::uint32_t, std::uint32_t>>& places) const {
    const glm::dvec2 aside_m = glm::max(glm::abs(from.to_left_edge_m), glm::abs(to.to_left_edge_m));
    const double length_m = glm::distance(from.at_m, to.at_m);
    const int parts = std::max(static_cast<int>(std::ceil(length_m / grid_cell_m_)), 1);
    for (int part = 0; part < parts; ++part) {
        const glm::dvec2 first_m = glm::mix(from.at_m, to.at_m, static_cast<double>(part) / parts);
        const glm::dvec2 last_m =
            glm::mix(from.at_m, to.at_m, static_cast<double>(part + 1) / parts);
        const GridRange own =
            grid_range(glm::min(first_m, last_m) - aside_m, glm::max(first_m, last_m) + aside_m);
        for (int row = own.first.y; row <= own.last.y; ++row) {
            for (int column = own.first.x; column <= own.last.x; ++column) {
                places.emplace_back(static_cast<std::uint32_t>(grid_cell(column, row)), number);
            }
        }
    }
}

void RoadNetwork::index() {
    glm::dvec2 max_m = sections_.front().max_m;
    first_m_ = sections_.front().min_m;
    for (const RoadSection& section : sections_) {
        first_m_ = glm::min(first_m_, section.min_m);
        max_m = glm::max(max_m, section.max_m);
    }
    const glm::dvec2 extent_m = max_m - first_m_;
    grid_cell_m_ = std::max(min_square_m, std::max(extent_m.x, extent_m.y) / max_squares);
    grid_size_ = glm::ivec2(glm::floor(extent_m / grid_cell_m_)) + 1;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> places; // square, piece
    for (std::uint32_t number = 0; number < sections_.size(); ++number) {
        for (const std::vector<RoadPoint>& level : sections_[number].levels) {
            for (std::size_t i = 1; i < level.size(); ++i) {
                add_cells(level[i - 1], level[i], number, places);
            }
        }
    }
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    first_of_.assign(grid_cell(0, grid_size_.y) + 1, 0);
    for (const auto& [grid_cell, number] : places) {
        ++first_of_[grid_cell + 1];
        sections_by_cell_.push_back(number);
    }
    for (std::size_t i = 1; i < first_of_.size(); ++i) {
        first_of_[i] += first_of_[i - 1];
    }
    const auto width = static_cast<std::size_t>(grid_size_.x) + 1;
    sums_.assign(width * (static_cast<std::size_t>(grid_size_.y) + 1), 0);
    for (int row = 0; row < grid_size_.y; ++row) {
        for (int column = 0; column < grid_size_.x; ++column) {
            const std::size_t at =
                static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
            const std::size_t own = grid_cell(column, row);
            sums_[at + width + 1] =
                sums_[at + width] + sums_[at + 1] - sums_[at] + first_of_[own + 1] - first_of_[own];
        }
    }
}

bool RoadNetwork::may_intersect(const glm::dvec2& min_m, const glm::dvec2& max_m) const {
    if (sections_.empty()) {
        return false;
    }
    const GridRange in = grid_range(min_m, max_m);
    if (in.first.x > in.last.x || in.first.y > in.last.y) {
        return false;
    }
    const auto sum = [&](int column, int row) {
        return sums_
            [static_cast<std::size_t>(row) * (static_cast<std::size_t>(grid_size_.x) + 1) +
             static_cast<std::size_t>(column)];
    };
    return sum(in.last.x + 1, in.last.y + 1) + sum(in.first.x, in.first.y) !=
           sum(in.last.x + 1, in.first.y) + sum(in.first.x, in.last.y + 1);
}

void RoadNetwork::sections_in_box(
    const glm::dvec2& min_m,
    const glm::dvec2& max_m,
    std::vector<std::uint32_t>& numbers) const {
    if (sections_.empty()) {
        return;
    }
    const GridRange in = grid_range(min_m, max_m);
    for (int row = in.first.y; row <= in.last.y; ++row) {
        for (int column = in.first.x; column <= in.last.x; ++column) {
            const std::size_t own = grid_cell(column, row);
            for (std::uint32_t i = first_of_[own]; i < first_of_[own + 1]; ++i) {
                numbers.push_back(sections_by_cell_[i]);
            }
        }
    }
}

bool RoadNetwork::is_near(const glm::dvec2& place_m, double distance_m) const {
    if (sections_.empty()) {
        return false;
    }
    const GridRange in = grid_range(place_m - distance_m, place_m + distance_m);
    for (int row = in.first.y; row <= in.last.y; ++row) {
        for (int column = in.first.x; column <= in.last.x; ++column) {
            const std::size_t own = grid_cell(column, row);
            for (std::uint32_t i = first_of_[own]; i < first_of_[own + 1]; ++i) {
                if (is_nearer(sections_[sections_by_cell_[i]], place_m, distance_m)) {
                    return true;
                }
            }
        }
    }
    return false;
}

} // namespace octant::visuals::roads
