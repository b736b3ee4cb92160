// Point location in a mesh of very different triangles: a hashed hierarchical grid, in which every triangle is entered
// at the level of its own size.
#include "visuals/terrain/mesh_surface.h"

#include "sim/base/geometry2d.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace octant::visuals::terrain {

namespace {

constexpr double smallest_cell_m = 1.0;
constexpr std::uint32_t none = ~std::uint32_t{0};

/// A position this far beyond an edge, as a share of the triangle's size, still belongs to the triangle. That is more
/// than the rounding of floats far from the eye.
constexpr double edge_share = 1e-6;

glm::ivec2 cell_of(const glm::dvec2& place_m, double cell_m) { return glm::ivec2(glm::floor(place_m / cell_m)); }

} // namespace

void MeshSurface::set_mesh(const GroundMesh& mesh, const glm::dvec3& eye_m) {
    eye_m_ = eye_m;
    indices_.assign(mesh.indices.begin(), mesh.indices.end());
    vertices_m_.clear();
    for (const models::ColourVertex& vertex : mesh.vertices) { vertices_m_.emplace_back(vertex.position_m); }
    entries_.clear();
    levels_used_ = 0;
    slots_.assign(std::bit_ceil(indices_.size() + 1), none);
    const auto triangles = static_cast<std::uint32_t>(indices_.size() / 3);
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle) { add(triangle); }
}

MeshSurface::Corners MeshSurface::corners_of(std::uint32_t triangle) const {
    const std::size_t first = 3 * static_cast<std::size_t>(triangle);
    return {vertices_m_[indices_[first]], vertices_m_[indices_[first + 1]], vertices_m_[indices_[first + 2]]};
}

std::size_t MeshSurface::slot_of(std::uint32_t level, std::int32_t column, std::int32_t row) const {
    const std::uint64_t place =
        std::uint64_t{static_cast<std::uint32_t>(column)} << 32U | static_cast<std::uint32_t>(row);
    const std::uint64_t mixed = (place ^ std::uint64_t{level} << 58U) * 0x9e3779b97f4a7c15ULL;
    return static_cast<std::size_t>(mixed >> 32U) & (slots_.size() - 1);
}

void MeshSurface::add(std::uint32_t triangle) {
    const auto [a, b, c] = corners_of(triangle);
    const glm::dvec2 least = glm::min(glm::min(glm::dvec2(a), glm::dvec2(b)), glm::dvec2(c));
    const glm::dvec2 most = glm::max(glm::max(glm::dvec2(a), glm::dvec2(b)), glm::dvec2(c));
    const double margin_m = edge_share * (most.x - least.x + most.y - least.y);
    const double size_m = std::max(most.x - least.x, most.y - least.y) + 2.0 * margin_m;
    const int level = std::clamp(static_cast<int>(std::ceil(std::log2(size_m))), 0, levels - 1);
    const double cell_m = std::ldexp(smallest_cell_m, level);
    levels_used_ |= 1U << static_cast<unsigned>(level);
    const glm::ivec2 first = cell_of(least - margin_m, cell_m);
    const glm::ivec2 last = cell_of(most + margin_m, cell_m);
    for (int row = first.y; row <= last.y; ++row) {
        for (int column = first.x; column <= last.x; ++column) {
            const auto meadow_code = static_cast<std::uint32_t>(level);
            std::uint32_t& slot = slots_[slot_of(meadow_code, column, row)];
            entries_.push_back({meadow_code, column, row, triangle, slot});
            slot = static_cast<std::uint32_t>(entries_.size() - 1);
        }
    }
}

bool MeshSurface::covers(std::uint32_t triangle, const glm::dvec2& place_m) const {
    const auto [a, b, c] = corners_of(triangle);
    const glm::dvec2 p(a);
    const glm::dvec2 q(b);
    const glm::dvec2 r(c);
    const double least = -edge_share * octant::signed_area2(p, q, r);
    return octant::signed_area2(p, q, place_m) >= least && octant::signed_area2(q, r, place_m) >= least &&
           octant::signed_area2(r, p, place_m) >= least;
}

std::optional<std::uint32_t> MeshSurface::triangle_at(double x_m, double y_m) const {
    const glm::dvec2 place_m = glm::dvec2(x_m, y_m) - glm::dvec2(eye_m_);
    for (std::uint32_t left = levels_used_; left != 0; left &= left - 1) {
        const auto level = static_cast<std::uint32_t>(std::countr_zero(left));
        const glm::ivec2 cell = cell_of(place_m, std::ldexp(smallest_cell_m, static_cast<int>(level)));
        for (std::uint32_t k = slots_[slot_of(level, cell.x, cell.y)]; k != none;) {
            const Entry& entry = entries_[k];
            if (entry.level == level && entry.column == cell.x && entry.row == cell.y &&
                covers(entry.triangle, place_m)) {
                return entry.triangle;
            }
            k = entry.next;
        }
    }
    return std::nullopt;
}

std::optional<double> MeshSurface::height_at(double x_m, double y_m) const {
    const auto triangle = triangle_at(x_m, y_m);
    if (!triangle) { return std::nullopt; }
    const auto [a, b, c] = corners_of(*triangle);
    const glm::dvec2 place_m = glm::dvec2(x_m, y_m) - glm::dvec2(eye_m_);
    const double whole = octant::signed_area2(glm::dvec2(a), glm::dvec2(b), glm::dvec2(c));
    if (whole == 0.0) { return eye_m_.z + a.z; }
    const double of_b = octant::signed_area2(glm::dvec2(a), place_m, glm::dvec2(c)) / whole;
    const double of_c = octant::signed_area2(glm::dvec2(a), glm::dvec2(b), place_m) / whole;
    return eye_m_.z + a.z + of_b * (b.z - a.z) + of_c * (c.z - a.z);
}

std::optional<double> MeshSurface::first_hit(const glm::dvec3& from_m, const glm::dvec3& to_m) const {
    const glm::dvec3 start = from_m - eye_m_;
    const glm::dvec3 way = to_m - from_m;
    double nearest = std::numeric_limits<double>::infinity();
    const auto triangles = static_cast<std::uint32_t>(indices_.size() / 3);
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle) {
        const auto [a, b, c] = corners_of(triangle);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double approach = glm::dot(normal, way);
        if (approach == 0.0) { continue; }
        const double share = glm::dot(normal, a - start) / approach;
        if (share < 0.0 || share > 1.0 || share >= nearest) { continue; }
        if (covers(triangle, glm::dvec2(start + way * share))) { nearest = share; }
    }
    return nearest <= 1.0 ? std::optional(nearest) : std::nullopt;
}

} // namespace octant::visuals::terrain
