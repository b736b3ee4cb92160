#pragma once

#include "models/simplify/peak_heights.h"
#include "models/simplify/polish_target.h"
#include "models/simplify/surface_cost.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/triangle_samples.h"
#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// A sample of a triangle whose corner 0 moves.
struct SeenSample {
    glm::dvec3 place{0.0};
    glm::dvec3 off{0.0};    ///< to the target
    glm::dvec3 normal{0.0}; ///< of its triangle
    double share = 0.0;     ///< of corner 0 in its place
    double area = 0.0;      ///< that it stands for
    bool turned = false;    ///< faces against the target
};

/// More than that need not be seen.
struct HeightLimits {
    double most2 = std::numeric_limits<double>::infinity();
    double squares = std::numeric_limits<double>::infinity(); ///< with turned area at its price
    double price = 0.0;
    double turned = std::numeric_limits<double>::infinity();

    bool allow(const Heights& heights) const {
        return heights.most2 <= most2 && heights.turned <= turned &&
               heights.squares + price * heights.turned <= squares;
    }
};

/// How far some triangles of a surface are from the target as they are and as they would be, both
/// ways: the tracked points in their lists, and a grid of samples on each of them.
class RingHeights {
public:
    /// `spacing`: of the samples of a triangle, about; 0: a grid of as many samples as triangles of
    /// the target come on one of the surface, its border too.
    RingHeights(
        const WorkingSurface& surface,
        TrackedPoints& points,
        const PolishTarget& target,
        double spacing = 0.0);

    /// What is looked at: one triangle, the triangles at a vertex, or those of an edge.
    void take_face(std::uint32_t face);
    void take_ring(std::uint32_t vertex);
    void take_pair(HalfEdge h);

    /// The ring with its vertex elsewhere; the other two as they are now.
    void set_ring(const glm::dvec3& place, const glm::dvec3& colour);
    void set_faces();

    /// Both ways around the triangles that were set; not all of it where that is above a limit.
    Heights seen(const HeightLimits& limits);

    /// Takes over the points' lists after what was seen last.
    void keep() { points_.assign(cost_.block(), faces_, faces_); }

    const std::vector<SeenSample>& samples() const { return samples_; } ///< of what was seen last

    std::span<const RingFace> ring() const { return ring_; }

    std::span<const std::uint32_t> faces() const { return faces_; }

    std::span<const Heights> each() const { return each_; } ///< of faces()

    /// Largest squared distance of the points alone, of what was seen last.
    double points_most2() const { return points_most2_; }

    std::size_t looks() const { return looks_; } ///< samples looked at so far

    const SurfaceCost& cost() const { return cost_; }

    const std::vector<std::array<glm::dvec3, 3>>& corners() const { return corners_; }

private:
    Heights points_heights();
    void add_samples(std::size_t i, Heights& heights, const HeightLimits& limits);
    std::size_t count_for(const std::array<glm::dvec3, 3>& corners) const;

    const WorkingSurface& surface_;
    TrackedPoints& points_;
    PolishTarget target_;
    NearestInTurn in_turn_;
    double spacing_ = 0.0;
    std::vector<TriangleSample> samples_on_; ///< of one triangle; with a spacing its first ones
    SurfaceCost cost_;
    std::vector<RingFace> ring_;
    std::vector<std::uint32_t> faces_;               ///< whose points are in cost_
    std::vector<std::array<glm::dvec3, 3>> corners_; ///< of the triangles in cost_
    std::vector<Heights> each_;                      ///< around each of these triangles
    std::vector<SeenSample> samples_;                ///< of what was seen last
    std::size_t looks_ = 0;
    double points_most2_ = 0.0;
};

} // namespace octant::models::simplify
