// A grid of equal cells as counting-sorted lists. Points lie on surfaces: with eight cells a point a cell that is not
// empty holds a few.
#include "models/planar/vertex_grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace octant::models::planar {

namespace {

constexpr int max_cells_an_axis = 128;

} // namespace

VertexGrid::VertexGrid(std::span<const glm::dvec3> points) {
    glm::dvec3 most(std::numeric_limits<double>::lowest());
    least_ = glm::dvec3(std::numeric_limits<double>::max());
    for (const glm::dvec3& point : points) {
        least_ = glm::min(least_, point);
        most = glm::max(most, point);
    }
    const glm::dvec3 extent = points.empty() ? glm::dvec3(0.0) : most - least_;
    const double largest = std::max({extent.x, extent.y, extent.z});
    const double an_axis =
        std::clamp(2.0 * std::cbrt(static_cast<double>(points.size())), 1.0, static_cast<double>(max_cells_an_axis));
    cell_ = largest > 0.0 ? largest / an_axis : 1.0;
    cells_ = glm::ivec3(extent / cell_) + 1;
    first_.assign(index_of(cells_ - 1) + 2, 0);
    for (const glm::dvec3& point : points) { ++first_[index_of(cell_of(point)) + 1]; }
    for (std::size_t i = 1; i < first_.size(); ++i) { first_[i] += first_[i - 1]; }
    numbers_.resize(points.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < points.size(); ++i) { numbers_[next[index_of(cell_of(points[i]))]++] = i; }
    places_.reserve(points.size());
    for (const std::uint32_t number : numbers_) { places_.push_back(points[number]); }
}

glm::ivec3 VertexGrid::cell_of(const glm::dvec3& point) const {
    const glm::dvec3 at = glm::floor((point - least_) / cell_);
    return glm::ivec3(glm::clamp(at, glm::dvec3(0.0), glm::dvec3(cells_ - 1)));
}

std::size_t VertexGrid::index_of(const glm::ivec3& cell) const {
    const glm::ivec3& size = cells_;
    return static_cast<std::size_t>((cell.z * size.y + cell.y) * size.x + cell.x);
}

void VertexGrid::append_in_box(const glm::dvec3& least, const glm::dvec3& most, std::vector<std::uint32_t>& out) const {
    const glm::ivec3 from = cell_of(least);
    const glm::ivec3 to = cell_of(most);
    for (int z = from.z; z <= to.z; ++z) {
        for (int y = from.y; y <= to.y; ++y) {
            const std::size_t begin = first_[index_of({from.x, y, z})];
            const std::size_t end = first_[index_of({to.x, y, z}) + 1];
            for (std::size_t i = begin; i < end; ++i) {
                const glm::dvec3& point = places_[i];
                if (glm::all(glm::greaterThanEqual(point, least)) && glm::all(glm::lessThanEqual(point, most))) {
                    out.push_back(numbers_[i]);
                }
            }
        }
    }
}

void VertexGrid::append_near_segment(
    const glm::dvec3& from, const glm::dvec3& to, double reach, std::vector<std::uint32_t>& out) const {
    constexpr double max_pieces = 4.0 * max_cells_an_axis;
    const double pieces = std::clamp(std::ceil(glm::distance(from, to) / cell_), 1.0, max_pieces);
    for (double i = 0.0; i < pieces; ++i) {
        const glm::dvec3 begin = glm::mix(from, to, i / pieces);
        const glm::dvec3 end = glm::mix(from, to, (i + 1.0) / pieces);
        // Twice the reach: places between the pieces' ends are rounded.
        append_in_box(glm::min(begin, end) - 2.0 * reach, glm::max(begin, end) + 2.0 * reach, out);
    }
}

std::vector<std::uint32_t> one_place(
    std::span<const glm::dvec3> points, std::span<const std::uint32_t> kind, double reach) {
    const VertexGrid near(points);
    std::vector<std::uint32_t> place(points.size());
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        found.clear();
        near.append_in_box(points[i] - reach, points[i] + reach, found);
        place[i] = i;
        for (const std::uint32_t other : found) {
            const bool joins = other < i && place[other] == other && kind[other] == kind[i] &&
                               glm::distance(points[other], points[i]) <= reach;
            if (joins) { place[i] = std::min(place[i], other); }
        }
    }
    return place;
}

} // namespace octant::models::planar
