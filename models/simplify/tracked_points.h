#pragma once

#include "models/simplify/point_block.h"
#include "models/simplify/working_surface.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// Places of tracked points are rounded to about that, of the diagonal: distances below say
/// nothing.
inline constexpr double point_rounding = 1e-7;
/// The same for the largest squared distance of many.
inline constexpr double peak_rounding2 = 100.0 * point_rounding * point_rounding;

/// Points of the original surface, each in the list of the triangle of the current surface that is
/// nearest to it, with the share of the original's area that it stands for.
class TrackedPoints {
public:
    /// Every vertex of the surface and one or more points of each triangle: about `wanted` in all,
    /// more where there are more vertices and triangles than that. Every vertex lies in a
    /// triangle (asserted).
    TrackedPoints(const WorkingSurface& original, std::size_t wanted);

    std::size_t size() const { return places_.size(); }

    bool coloured() const { return !colours_.empty(); }

    const std::array<float, 3>& place(std::uint32_t point) const { return places_[point]; }

    const std::array<float, 3>& colour(std::uint32_t point) const { return colours_[point]; }

    float weight(std::uint32_t point) const { return weights_[point]; }

    void set_weight(std::uint32_t point, float weight) { weights_[point] = weight; }

    float distance2(std::uint32_t point) const { return distances2_[point]; }

    std::uint32_t face(std::uint32_t point) const { return faces_[point]; }

    /// Weighted sum of squared distances, colours included, of a triangle's points.
    double cost(std::uint32_t face) const { return costs_[face]; }

    /// Adds a triangle's points to a block.
    void gather(std::uint32_t face, PointBlock& points) const;

    /// Moves the points of a block from where they are listed to `faces[points.nearest]`. All
    /// points of all `emptied` triangles must be in the block. Returns the largest squared
    /// distance.
    float assign(
        const PointBlock& points,
        std::span<const std::uint32_t> emptied,
        std::span<const std::uint32_t> faces);

    /// Makes room for triangles with numbers below `count`.
    void make_face_room(std::size_t count);

    /// Puts every point into the list of `faces[point]`; distances are not known then.
    void assign_all(std::span<const std::uint32_t> faces, std::size_t face_slots);

private:
    void add(const glm::dvec3& place, const glm::dvec3* colour, double weight, std::uint32_t face);

    std::vector<std::array<float, 3>> places_;
    std::vector<std::array<float, 3>> colours_; ///< empty = none
    std::vector<float> weights_;
    std::vector<float> distances2_;
    std::vector<std::uint32_t> faces_;
    std::vector<std::uint32_t> next_;  ///< in the list of the same triangle
    std::vector<std::uint32_t> first_; ///< of each triangle
    std::vector<std::uint32_t> counts_;
    std::vector<double> costs_;
};

/// Weighted sum over a block after find_nearest, from `first` to `end`.
double cost_sum(const PointBlock& points, std::size_t first, std::size_t end, bool coloured);

} // namespace octant::models::simplify
