#pragma once

#include "models/heights/height_field.h"
#include "visuals/terrain/bisection_tiles.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace octant::visuals::terrain {

/// A view of the samples of a HeightField or of GroundTiles. The ground must outlive it. World axes as in HeightField.
class GroundSamples {
public:
    explicit GroundSamples(const models::heights::HeightField& field)
        : GroundSamples(
              field, field.highest_m(),
              [](const void* ground, int column, int row) {
                  return static_cast<const models::heights::HeightField*>(ground)->height_m(column, row);
              },
              [](const void* ground, int row, std::span<float> heights_m) {
                  const auto& of = *static_cast<const models::heights::HeightField*>(ground);
                  for (int column = 0; column < of.columns(); ++column) {
                      heights_m[static_cast<std::size_t>(column)] = of.height_m(column, row);
                  }
              }) {}

    explicit GroundSamples(const GroundTiles& tiles)
        : GroundSamples(
              tiles, tiles.metadata().highest_m,
              [](const void* ground, int column, int row) {
                  return static_cast<const GroundTiles*>(ground)->height_m(column, row);
              },
              [](const void* ground, int row, std::span<float> heights_m) {
                  static_cast<const GroundTiles*>(ground)->copy_row(row, heights_m);
              }) {}

    int columns() const { return columns_; }

    int rows() const { return rows_; }

    double spacing_m() const { return spacing_m_; }

    /// Half the extent of the field from its centre, east and north, metres.
    glm::dvec2 half_extent_m() const { return half_extent_m_; }

    /// An upper bound of the heights.
    double highest_m() const { return highest_m_; }

    /// The height of a sample. Column and row must be within the grid.
    double height_m(int column, int row) const { return static_cast<double>(height_(ground_, column, row)); }

    /// The heights of all samples of a row, from west to east: for many at a time.
    void copy_row(int row, std::span<float> heights_m) const { copy_row_(ground_, row, heights_m); }

    /// The world position of a sample.
    glm::dvec3 sample_m(int column, int row) const {
        return {column * spacing_m_ - half_extent_m_.x, row * spacing_m_ - half_extent_m_.y, height_m(column, row)};
    }

    /// A position in samples east and north of the first sample; whole numbers at samples.
    glm::dvec2 grid_from_world(double x_m, double y_m) const {
        return (glm::dvec2(x_m, y_m) + half_extent_m_) / spacing_m_;
    }

private:
    using Height = float (*)(const void* ground, int column, int row);
    using CopyRow = void (*)(const void* ground, int row, std::span<float> heights_m);

    template <class Ground>
    GroundSamples(const Ground& ground, float highest_m, Height height, CopyRow copy_row)
        : ground_(&ground), height_(height), copy_row_(copy_row), highest_m_(static_cast<double>(highest_m)),
          columns_(ground.columns()), rows_(ground.rows()), spacing_m_(ground.spacing_m()),
          half_extent_m_(ground.half_extent_m()) {}

    const void* ground_;
    Height height_;
    CopyRow copy_row_;
    double highest_m_;
    int columns_;
    int rows_;
    double spacing_m_;
    glm::dvec2 half_extent_m_;
};

// Queries against the full-resolution ground. Its surface is bilinear between four samples, and lines are intersected
// with it exactly, cell by cell. The earth's curvature lowers everything at a horizontal distance d from the eye by d^2
// / (2 R); R = 0 is a flat earth.

/// The height of the ground; nothing outside the field.
std::optional<double> ground_height_m(const GroundSamples& ground, double x_m, double y_m);

/// The result of line_of_sight().
struct LineOfSight {
    bool visible = true; ///< The line is nowhere more than a micrometre below the ground.
    /// The first point of the ground that blocks the line, in world axes.
    std::optional<glm::dvec3> blocked_at_m;
    /// The height of the line above the ground where that is least; infinite where there is no ground below the line.
    double clearance_m = 0.0;
    glm::dvec3 min_clearance_at_m{0.0}; ///< The point of the ground at which the clearance is least.
};

/// Whether `to_m` is visible from `from_m`, both in world axes.
LineOfSight line_of_sight(
    const GroundSamples& ground, const glm::dvec3& from_m, const glm::dvec3& to_m, double radius_m);

/// The first point at which a ray meets the ground; nothing if it does not within `reach_m`. The direction is a unit
/// vector. The ray is straight and the ground is lowered by curvature; the returned point has the ground's own height,
/// without that.
std::optional<glm::dvec3> intersect_ground(const GroundSamples& ground, const glm::dvec3& from_m,
    const glm::dvec3& direction, double reach_m, double radius_m);

} // namespace octant::visuals::terrain
