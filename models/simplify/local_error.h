#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/simplify/quadrics.h"
#include "models/simplify/surface_samples.h"
#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// A least-squares fit of one vertex: the change of its position and colour that minimizes a sum of squared distances,
/// taken as linear functions of both.
class VertexFit {
public:
    /// Adds a pair of a point and its nearest point on a triangle whose corner 0 is the vertex. `off` runs from the
    /// nearest point to the point; `share` is the vertex's barycentric weight in the nearest point; `normal` is the
    /// triangle's unit normal.
    void add(const glm::dvec3& off, const glm::dvec3& normal, double share, double weight);

    /// Adds the colour of such a pair. `off` is the point's colour minus that of the nearest point, `gradient` the
    /// gradient of the latter on the triangle.
    void add_colour(const glm::dvec3& off, const std::array<glm::dvec3, 3>& gradient, double share, double weight);

    /// The step of the position.
    glm::dvec3 way() const;

    /// The change of the colour.
    glm::dvec3 colour_change() const;

private:
    Quadric matrix_;
    glm::dvec3 right_side_{0.0};
    double colour_weight_ = 0.0;
    glm::dvec3 colour_sum_{0.0};
};

/// The corners of a triangle and, on coloured meshes, their colours.
struct ColouredTriangle {
    std::array<std::uint32_t, 3> vertices{none, none, none}; ///< none = a vertex that is new or moves
    std::array<glm::dvec3, 3> places{};
    std::array<glm::dvec3, 3> colours{};
};

/// The two-sided error around a step: from the samples whose triangles change to the new triangles (forward), and from
/// points of the new triangles to the original (backward). The vertex that a step moves or makes is corner 0 of each
/// new triangle.
///
/// Calls for a step of Optimizer: gather() the triangles that change; set_ring() or set_triangles(); forward_error()
/// and fit() for the vertex's position, move_corner() there; measured() for the error; if the step is made, keep()
/// after the change of the mesh. Calls for a collapse, whose vertex is placed by quadrics: gather(), set_ring(),
/// forward_error(), backward_error(), and keep() after the change of the mesh.
class LocalError {
public:
    LocalError(const WorkingSurface& surface, SurfaceSamples& samples, const OriginalSurface& original)
        : surface_(surface), samples_(samples), original_(original) {}

    /// Loads the samples of the triangles that change.
    void gather(std::span<const std::uint32_t> faces);

    /// Sets the new triangles: those of a ring with their moving corner at `place`, with the colour `colour`.
    void set_ring(std::span<const RingFace> ring, const glm::dvec3& place, const glm::dvec3& colour);

    /// Moves corner 0 of all new triangles.
    void move_corner(const glm::dvec3& place, const glm::dvec3& colour);

    /// Sets the new triangles. Each is expected to be near the present one of `near`.
    void set_triangles(std::span<const ColouredTriangle> triangles, std::span<const std::uint32_t> near);

    /// Measures the backward errors of all present triangles and the colour errors of their samples. Returns the
    /// largest squared backward distance, with what backward_error() adds.
    double measure_all_back();

    /// Measures from the samples to the new triangles.
    double forward_error();

    /// Measures from the new triangles to the original, until the sum exceeds `limit`. Where the original faces against
    /// a triangle at the foot of one of its inner points, the triangle's area is added to the squared distance.
    double backward_error(double limit = std::numeric_limits<double>::infinity());

    /// The sum of both errors; only a lower bound if it exceeds `limit`.
    double measured(double limit = std::numeric_limits<double>::infinity());

    /// The largest squared distance of the last measurement, in both directions, with what backward_error() adds.
    double max_distance2() { return std::max(max_there2(), max_back2_); }

    /// The sum of the present errors of the loaded triangles.
    double present() const { return current_forward_error_ + current_backward_error_; }

    double current_forward_error() const { return current_forward_error_; }

    /// An error below this may consist of rounding only.
    double rounding() const { return sample_rounding * sample_rounding * area_; }

    /// The least-squares step of corner 0 for the last forward_error(). `with_back` includes the present backward
    /// errors, which requires that the new triangles are the present ones.
    VertexFit fit(bool with_back) const;

    /// From now on backward distances also start from points of the edges, and the largest distance is that to the
    /// whole other surface. The error does not change.
    void measure_densely();

    /// Only squared distances above this one are searched for in the whole other surface (measure_densely).
    void set_trusted2(double distance2) { trusted2_ = distance2; }

    /// The step of corner 0 that lowers the largest distance of the last dense measurement, in both directions: a
    /// least-squares fit with large weights of far points.
    glm::dvec3 max_error_step();

    /// The approximate number of distances to triangles that one measurement computes.
    double work() const;

    /// The sum of work() over all measurements.
    double work_done() const { return work_done_; }

    /// Accepts the step of the last complete measurement, after the mesh was changed: moves the samples to the lists of
    /// `faces`, the numbers of the new triangles in their order. `emptied` are the loaded triangles; `vertex` is the
    /// vertex that is new or moves, or none.
    void keep(std::span<const std::uint32_t> emptied, std::span<const std::uint32_t> faces, std::uint32_t vertex);

    /// Copies the backward foot of a vertex to a new vertex at the same position.
    void copy_vertex(std::uint32_t from, std::uint32_t to) { samples_.from_vertex(to) = samples_.from_vertex(from); }

private:
    double max_there2();

    /// A point of a new triangle and its way to the original.
    struct BackPoint {
        glm::dvec3 off{0.0};
        std::uint32_t triangle = 0; ///< The new one.
        double share = 0.0;         ///< The barycentric weight of corner 0.
    };

    void flatten();
    BackwardFoot checked(const BackwardFoot& from, const glm::dvec3& place) const;
    void measure_densely(std::uint32_t triangle);
    void measure_colours(std::uint32_t face);
    std::uint32_t start_near(std::uint32_t face, const glm::dvec3& place);
    BackwardFoot backward_foot(const OriginalPoint& start, const glm::dvec3& place) const;

    const WorkingSurface& surface_;
    SurfaceSamples& samples_;
    const OriginalSurface& original_;
    SampleBlock block_;
    std::vector<ColouredTriangle> triangles_;
    std::vector<std::uint32_t> near_; ///< For each new triangle a present one.
    /// The corner of that one which is corner 0 of the new one, where known.
    std::vector<std::uint32_t> turns_;
    std::vector<FlatTriangle> flat_;
    std::vector<double> back_errors_;                      ///< For each new triangle.
    std::vector<std::array<BackwardFoot, 3>> from_points_; ///< By the corners of each new triangle.
    BackwardFoot from_moving_;                             ///< From corner 0 where that is new or moves.
    /// The vertex that moves, or is merged with another one; none = it is new.
    std::uint32_t moving_ = none;
    double max_back2_ = 0.0;
    bool is_dense_ = false;
    double trusted2_ = 0.0;
    /// Of the present triangles when measure_densely() was called, their numbers, and for each number whether it
    /// changed since.
    std::unique_ptr<const measure::TriangleBvh> present_tree_;
    std::vector<std::uint32_t> present_faces_;
    std::vector<std::uint8_t> face_changed_;
    std::vector<std::uint32_t> gathered_; ///< The triangles that were loaded.
    std::vector<BackPoint> back_points_;  ///< Empty unless measured densely.
    double work_done_ = 0.0;
    double current_forward_error_ = 0.0;
    double current_backward_error_ = 0.0;
    double area_ = 0.0;
    std::vector<std::uint32_t> start_candidates_; ///< The triangles that start_near() looks at.
    std::vector<std::uint32_t> face_marks_;       ///< For each triangle slot the last search that met it.
    std::uint32_t face_mark_ = 0;                 ///< The number of the last search.
};

} // namespace octant::models::simplify
