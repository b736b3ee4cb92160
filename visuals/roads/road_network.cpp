#include "visuals/roads/road_network.h"

#include "visuals/roads/road_routes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace octant::visuals::roads {

namespace {

constexpr double square_m = 500.0;

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

} // namespace

RoadNetwork::RoadNetwork(const terrain::GroundSamples& ground, const RoadWish& wish) {
    lay(ground, wish);
    if (!pieces_.empty()) {
        index();
    }
}

void RoadNetwork::lay(const terrain::GroundSamples& ground, const RoadWish& wish) {
    const RoadGround cells(ground, wish);
    const auto is_free = [&](const glm::dvec2& place_m) {
        return height_at(ground, place_m) > wish.water_m &&
               !(wish.is_taken && wish.is_taken(place_m));
    };
    std::vector<glm::dvec2> places_m;
    for (const Route& route : road_routes(cells, road_towns(cells, wish))) {
        places_m.clear();
        for (const std::size_t cell : route) {
            places_m.push_back(cells.place_m(cell));
        }
        append_pieces(rounded(places_m, cells.cell_m(), is_free), pieces_);
    }
}

std::size_t RoadNetwork::square(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(counts_.x) +
           static_cast<std::size_t>(column);
}

RoadNetwork::Squares
RoadNetwork::squares(const glm::dvec2& least_m, const glm::dvec2& most_m) const {
    const glm::dvec2 end(counts_);
    const auto clamped = [&](const glm::dvec2& at_m) {
        return glm::ivec2(
            glm::clamp(glm::floor((at_m - first_m_) / square_m), glm::dvec2(-1.0), end));
    };
    return {glm::max(clamped(least_m), glm::ivec2(0)), glm::min(clamped(most_m), counts_ - 1)};
}

void RoadNetwork::index() {
    glm::dvec2 most_m = pieces_.front().most_m;
    first_m_ = pieces_.front().least_m;
    for (const RoadPiece& piece : pieces_) {
        first_m_ = glm::min(first_m_, piece.least_m);
        most_m = glm::max(most_m, piece.most_m);
    }
    counts_ = glm::ivec2(glm::floor((most_m - first_m_) / square_m)) + 1;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> places; // square, piece
    for (std::uint32_t number = 0; number < pieces_.size(); ++number) {
        const Squares own = squares(pieces_[number].least_m, pieces_[number].most_m);
        for (int row = own.first.y; row <= own.last.y; ++row) {
            for (int column = own.first.x; column <= own.last.x; ++column) {
                places.emplace_back(static_cast<std::uint32_t>(square(column, row)), number);
            }
        }
    }
    std::ranges::sort(places);
    first_of_.assign(square(0, counts_.y) + 1, 0);
    for (const auto& [square, number] : places) {
        ++first_of_[square + 1];
        by_square_.push_back(number);
    }
    for (std::size_t i = 1; i < first_of_.size(); ++i) {
        first_of_[i] += first_of_[i - 1];
    }
    const auto width = static_cast<std::size_t>(counts_.x) + 1;
    sums_.assign(width * (static_cast<std::size_t>(counts_.y) + 1), 0);
    for (int row = 0; row < counts_.y; ++row) {
        for (int column = 0; column < counts_.x; ++column) {
            const std::size_t at =
                static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
            const std::size_t own = square(column, row);
            sums_[at + width + 1] =
                sums_[at + width] + sums_[at + 1] - sums_[at] + first_of_[own + 1] - first_of_[own];
        }
    }
}

bool RoadNetwork::may_meet(const glm::dvec2& least_m, const glm::dvec2& most_m) const {
    if (pieces_.empty()) {
        return false;
    }
    const Squares in = squares(least_m, most_m);
    if (in.first.x > in.last.x || in.first.y > in.last.y) {
        return false;
    }
    const auto sum = [&](int column, int row) {
        return sums_
            [static_cast<std::size_t>(row) * (static_cast<std::size_t>(counts_.x) + 1) +
             static_cast<std::size_t>(column)];
    };
    return sum(in.last.x + 1, in.last.y + 1) + sum(in.first.x, in.first.y) !=
           sum(in.last.x + 1, in.first.y) + sum(in.first.x, in.last.y + 1);
}

void RoadNetwork::pieces_by(
    const glm::dvec2& least_m,
    const glm::dvec2& most_m,
    std::vector<std::uint32_t>& numbers) const {
    if (pieces_.empty()) {
        return;
    }
    const Squares in = squares(least_m, most_m);
    for (int row = in.first.y; row <= in.last.y; ++row) {
        for (int column = in.first.x; column <= in.last.x; ++column) {
            const std::size_t own = square(column, row);
            for (std::uint32_t i = first_of_[own]; i < first_of_[own + 1]; ++i) {
                const RoadPiece& piece = pieces_[by_square_[i]];
                if (piece.least_m.x <= most_m.x && piece.most_m.x >= least_m.x &&
                    piece.least_m.y <= most_m.y && piece.most_m.y >= least_m.y) {
                    numbers.push_back(by_square_[i]);
                }
            }
        }
    }
}

bool RoadNetwork::is_near(const glm::dvec2& place_m, double within_m) const {
    std::vector<std::uint32_t> numbers;
    pieces_by(place_m - within_m, place_m + within_m, numbers);
    return std::ranges::any_of(numbers, [&](std::uint32_t number) {
        const std::vector<RoadPoint>& line = pieces_[number].levels[0];
        for (std::size_t i = 1; i < line.size(); ++i) {
            if (distance_from_stretch_m(place_m, line[i - 1].at_m, line[i].at_m) < within_m) {
                return true;
            }
        }
        return false;
    });
}

} // namespace octant::visuals::roads
