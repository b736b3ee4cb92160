#pragma once

#include "models/simplify/polish_target.h"
#include "models/simplify/surface_cost.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/triangle_samples.h"
#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// Statistics of the distances seen around some triangles, both ways, in working units.
struct Heights {
    double most2 = 0.0;   ///< The largest squared distance.
    double squares = 0.0; ///< The sum of weight times squared distance.
    /// The sum of weight times distance to the eighth, which the largest distances dominate.
    double powers = 0.0;
    double turned = 0.0; ///< The area that faces against the target.

    void add(double distance2, double weight) {
        const double fourth = distance2 * distance2;
        most2 = std::max(most2, distance2);
        squares += weight * distance2;
        powers += weight * fourth * fourth;
    }

    void add(const Heights& other) {
        most2 = std::max(most2, other.most2);
        squares += other.squares;
        powers += other.powers;
        turned += other.turned;
    }
};

/// A sample of a triangle whose corner 0 is the vertex that moves.
struct SeenSample {
    glm::dvec3 place{0.0};
    glm::dvec3 off{0.0};    ///< The vector to the nearest point of the target.
    glm::dvec3 normal{0.0}; ///< The unit normal of its triangle.
    double share = 0.0;     ///< The barycentric weight of corner 0.
    double area = 0.0;      ///< The area that it stands for.
    bool turned = false;    ///< It faces against the target.
};

/// Limits at which measuring ends, because a candidate is already known to be too bad.
struct HeightLimits {
    double most2 = std::numeric_limits<double>::infinity();
    /// This limits squares + price * turned area.
    double squares = std::numeric_limits<double>::infinity();
    double price = 0.0;
    double turned = std::numeric_limits<double>::infinity();

    bool allow(const Heights& heights) const {
        return heights.most2 <= most2 && heights.turned <= turned &&
               heights.squares + price * heights.turned <= squares;
    }
};

/// How many samples there are on triangles.
struct SampleDensity {
    /// About the distance between samples. 0 means a grid on each triangle, border included, with
    /// as many samples as the target has triangles for each one of the surface.
    double spacing = 0.0;
    /// Of all triangles together the grids have at least about so many.
    std::size_t of_all = 0;
};

/// Measures how far some triangles of a surface are from the target, both ways, as they are and as
/// they would be after a change: by the tracked points in their lists, and by samples on each of
/// them.
class RingHeights {
public:
    RingHeights(
        const WorkingSurface& surface,
        TrackedPoints& points,
        const PolishTarget& target,
        const SampleDensity& density = {});

    /// Loads what is looked at: one triangle ...
    void take_face(std::uint32_t face);
    /// ... or the triangles at a vertex, which are measured after set_ring ...
    void take_ring(std::uint32_t vertex);
    /// ... or the two triangles at an edge.
    void take_pair(HalfEdge h);

    /// Sets the loaded ring as it would be with its vertex at `place`.
    void set_ring(const glm::dvec3& place, const glm::dvec3& colour);
    /// Sets the loaded triangles as they are now.
    void set_faces();

    /// Measures the triangles that were set, both ways. Ends early, with what it has, once a limit
    /// is exceeded.
    Heights seen(const HeightLimits& limits);

    /// Moves the tracked points to the lists of the triangles that seen() found nearest.
    void keep() { points_.assign(cost_.block(), faces_, faces_); }

    /// The samples that seen() looked at last.
    const std::vector<SeenSample>& samples() const { return samples_; }

    std::span<const RingFace> ring() const { return ring_; }

    std::span<const std::uint32_t> faces() const { return faces_; }

    /// The statistics of seen() for each one of faces().
    std::span<const Heights> each() const { return each_; }

    /// The largest squared distance of the tracked points alone, as seen last.
    double points_most2() const { return points_most2_; }

    /// How many samples were looked at so far.
    std::size_t looks() const { return looks_; }

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
    /// The samples of any triangle; with a spacing it uses as many of the first ones as it needs.
    std::vector<TriangleSample> samples_on_;
    SurfaceCost cost_;
    std::vector<RingFace> ring_;
    std::vector<std::uint32_t> faces_;               ///< The triangles whose points are in cost_.
    std::vector<std::array<glm::dvec3, 3>> corners_; ///< The corners of the triangles in cost_.
    std::vector<Heights> each_;                      ///< The statistics of each of these triangles.
    std::vector<SeenSample> samples_;                ///< The samples that were seen last.
    std::size_t looks_ = 0;
    double points_most2_ = 0.0;
};

} // namespace octant::models::simplify
