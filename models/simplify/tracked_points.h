#pragma once

#include "models/simplify/point_block.h"
#include "models/simplify/target_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// Positions of tracked points are rounded to about this share of the diagonal; smaller distances
/// mean nothing.
inline constexpr double point_rounding = 1e-7;
/// The squared distance that is nothing but rounding, for the largest of many.
inline constexpr double peak_rounding2 = 100.0 * point_rounding * point_rounding;

/// Sample points of the original surface. Each has the share of the original's area that it stands
/// for as its weight, and is in the list of that triangle of the current surface that is nearest to
/// it. Collapses and moves only touch the lists of triangles that change.
class TrackedPoints {
public:
    /// Makes a point of every vertex and one or more points on each triangle: about `wanted` in
    /// all, or more if vertices and triangles alone are more. Where `wanted` is at most the number
    /// of vertices there are none on triangles, and vertices are left out evenly. Every vertex must
    /// lie in a triangle (asserted).
    TrackedPoints(const TargetMesh& original, std::size_t wanted);

    std::size_t size() const { return places_.size(); }

    bool coloured() const { return !colours_.empty(); }

    const std::array<float, 3>& place(std::uint32_t point) const { return places_[point]; }

    const std::array<float, 3>& colour(std::uint32_t point) const { return colours_[point]; }

    float weight(std::uint32_t point) const { return weights_[point]; }

    float distance2(std::uint32_t point) const { return distances2_[point]; }

    std::uint32_t face(std::uint32_t point) const { return faces_[point]; }

    /// The weighted sum of squared distances, colours included, of a triangle's points.
    double cost(std::uint32_t face) const { return costs_[face]; }

    /// Appends a triangle's points to a block.
    void gather(std::uint32_t face, PointBlock& points) const;

    /// Moves the points of a block from their lists to those of `faces[points.nearest]`. The block
    /// must hold all points of all `emptied` triangles. Returns the largest squared distance.
    float assign(
        const PointBlock& points,
        std::span<const std::uint32_t> emptied,
        std::span<const std::uint32_t> faces);

    /// Makes room for triangles numbered below `count`.
    void make_face_room(std::size_t count);

    /// Puts every point into the list of triangle `faces[point]`. Distances and costs are unknown
    /// after that.
    void assign_all(std::span<const std::uint32_t> faces, std::size_t face_slots);

private:
    void add(const glm::dvec3& place, const glm::dvec3* colour, double weight, std::uint32_t face);
    void add_on(const TargetMesh& original, std::uint32_t face, std::size_t count, double area);
    void add_vertices(
        const TargetMesh& original,
        const std::vector<double>& areas,
        const std::vector<std::uint32_t>& faces,
        std::size_t stride);
    void make_room(std::size_t points);

    std::vector<std::array<float, 3>> places_;
    std::vector<std::array<float, 3>> colours_; ///< Empty = no colours.
    std::vector<float> weights_;
    std::vector<float> distances2_;
    std::vector<std::uint32_t> faces_;
    std::vector<std::uint32_t> next_;  ///< The next point in the same list.
    std::vector<std::uint32_t> first_; ///< For each triangle the head of its list.
    std::vector<std::uint32_t> counts_;
    std::vector<double> costs_;
};

/// The weighted sum of squared distances of a block's points from `first` up to `end`, after
/// find_nearest; with colour differences where `coloured`.
double cost_sum(const PointBlock& points, std::size_t first, std::size_t end, bool coloured);

} // namespace octant::models::simplify
