#pragma once

#include "models/colour_vertex.h"
#include "sim/base/bit_set.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_query.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::terrain {

/// The camera of a perspective picture. World axes, metres.
struct PerspectiveView {
    glm::dvec3 eye_m{0.0};
    glm::dvec3 right{1.0, 0.0, 0.0}; ///< Together with `up` and `ahead`: orthogonal unit vectors.
    glm::dvec3 up{0.0, 0.0, 1.0};
    glm::dvec3 ahead{0.0, 1.0, 0.0};
    double focal_px = 869.1; ///< As MeshView::focal_px.
    double half_width_px = 640.0;
    double half_height_px = 360.0;
    double near_m = 10.0; ///< Nothing nearer is measured.

    /// Converts a vector relative to the eye to view axes (right, up, ahead), metres.
    glm::dvec3 seen_m(const glm::dvec3& from_eye_m) const {
        return {glm::dot(right, from_eye_m), glm::dot(up, from_eye_m), glm::dot(ahead, from_eye_m)};
    }

    /// Whether a point in view axes is in the picture.
    bool shows(const glm::dvec3& seen) const {
        return seen.z >= near_m && focal_px * seen.x <= half_width_px * seen.z &&
               -focal_px * seen.x <= half_width_px * seen.z && focal_px * seen.y <= half_height_px * seen.z &&
               -focal_px * seen.y <= half_height_px * seen.z;
    }

    /// The pixels right of and above the middle. The point must be in front of the eye.
    glm::dvec2 pixel(const glm::dvec3& seen) const { return glm::dvec2(seen.x, seen.y) * (focal_px / seen.z); }
};

/// The changes dn_k = N_k - N_{k-1}, k >= 1, of the number of triangles in a run N_0, N_1, ...
struct ChangeStatistics {
    double mean = 0.0; ///< The mean of |dn|.
    int largest = 0;   ///< The largest |dn|.
    /// Flicker, in triangles a frame: the sum of min(|dn_k|, |dn_{k-1}|) over all k at which dn_k and dn_{k-1} have
    /// opposite signs, divided by the number of frames. A change that is taken back in the next frame counts with the
    /// amount taken back; steady growth counts nothing.
    double flicker_triangles = 0.0;
};

/// The figures of the changes dn_k with k >= `first`, where first >= 1. All are zero when there are no such changes.
ChangeStatistics change_statistics(std::span<const int> triangles, std::size_t first);

/// The number of frames before the frame from which on dn = 0 until the end; nothing when those are fewer than
/// `stable_frames` frames.
std::optional<int> frames_until_constant(std::span<const int> triangles, std::size_t stable_frames);

/// The number of frames before the first one from which on `stable_frames` frames in a row miss `target` by at most
/// `share` of it; nothing when there is none.
std::optional<int> frames_until_within(std::span<const int> triangles, int target, double share, int stable_frames);

/// The error of a mesh against the full-resolution ground in one picture, in pixels.
struct ProjectedError {
    double maximum_px = 0.0;
    double p999_px = 0.0; ///< The 99.9th percentile by nearest rank.
    double p99_px = 0.0;
    double rms_px = 0.0;
    double mean_px = 0.0;
    /// The number of measured samples: inside the frustum, above or below the mesh.
    std::int64_t samples = 0;
    /// Samples inside the frustum without a mesh there: 0 unless it has holes.
    std::int64_t uncovered = 0;
    /// Triangles of the mesh that are not wholly outside one plane of the frustum.
    int triangles_in_view = 0;
};

/// Measures meshes against a ground. Its memory is reused from mesh to mesh.
class ProjectedErrorMeter {
public:
    /// `threads` is at least 1; the figures do not depend on it.
    explicit ProjectedErrorMeter(GroundSamples ground, int threads = 2);

    /// Every sample of the ground inside the frustum (the near plane included) counts once: its error is the distance
    /// on the screen between it and the mesh's surface at the same x, y. A surface nearer than the near plane is
    /// projected from there. The positions in `mesh` are relative to `view.eye_m` and lowered by d^2 / (2
    /// `earth_radius_m`), and so are the samples; 0 = flat earth.
    ProjectedError measure(const GroundMesh& mesh, const PerspectiveView& view, double earth_radius_m = 0.0);

private:
    struct Picture;

    /// Some rows of samples, measured by one thread.
    struct Band {
        int first_row = 0;
        int end_row = 0;
        BitMatrix covered; ///< One bit for each sample.
        std::vector<float> errors_px;
        std::int64_t uncovered = 0;
    };

    using Corners = std::array<glm::dvec3, 3>;

    void measure_band(Band& band, std::span<const std::uint32_t> indices, const Picture& picture);
    void measure_triangle(Band& band, const Corners& corners, const Picture& picture) const;
    void count_uncovered(Band& band, const Picture& picture) const;

    GroundSamples ground_;
    int threads_;
    std::vector<Band> bands_;
    std::vector<float> errors_px_;
    /// The vertices of the mesh: samples east and north, and metres above the eye.
    std::vector<glm::dvec3> grid_vertices_;
};

/// The defects of a mesh. If all counts are 0, the ground is a single surface without a crack, hole or fold.
struct Conformity {
    /// Edges without a triangle on the other side, although the frustum sees them and the field goes on there.
    int open_edges = 0;
    /// Vertices inside an edge of a triangle that they do not belong to (T-junctions).
    int t_junctions = 0;
    int overlapping_edges = 0; ///< Edges with more than one triangle on a side.
    /// Triangles that are not counter-clockwise from above or have no area.
    int inverted_triangles = 0;
    int duplicate_vertices = 0; ///< Vertices at a position in plan that has another one.

    bool is_conforming() const {
        return open_edges + t_junctions + overlapping_edges + inverted_triangles + duplicate_vertices == 0;
    }

    /// The counts in one line.
    std::string text() const;
};

/// Checks a mesh that was made for `view` by matching edges.
Conformity check_conformity(const GroundSamples& ground, const GroundMesh& mesh, const MeshView& view);

/// The surface of a mesh as a function of the position in plan. The mesh itself is not needed after set_mesh().
class MeshSurface {
public:
    /// Takes a mesh whose positions are relative to `eye_m`.
    void set_mesh(const GroundMesh& mesh, const glm::dvec3& eye_m);

    /// The number of the triangle above or below a position, one of them at an edge; nothing where there is no mesh.
    std::optional<std::uint32_t> triangle_at(double x_m, double y_m) const;

    /// The world height of the surface; nothing where there is no mesh.
    std::optional<double> height_at(double x_m, double y_m) const;

    /// The first intersection of the line between two world positions with the mesh, as a fraction of the line; nothing
    /// without one.
    std::optional<double> first_hit(const glm::dvec3& from_m, const glm::dvec3& to_m) const;

private:
    /// A triangle in a cell. The size of cells halves from level to level; a triangle is entered into the cells of the
    /// smallest size that is as large as the triangle: four at most.
    struct Entry {
        std::uint32_t level = 0;
        std::int32_t column = 0;
        std::int32_t row = 0;
        std::uint32_t triangle = 0;
        std::uint32_t next = 0; ///< The next entry of the same hash slot; none = end.
    };

    static constexpr int levels = 32;

    struct Corners {
        glm::dvec3 a;
        glm::dvec3 b;
        glm::dvec3 c;
    };

    Corners corners_of(std::uint32_t triangle) const;
    std::size_t slot_of(std::uint32_t level, std::int32_t column, std::int32_t row) const;
    void add(std::uint32_t triangle);
    bool covers(std::uint32_t triangle, const glm::dvec2& place_m) const;

    glm::dvec3 eye_m_{0.0};
    std::uint32_t levels_used_ = 0;      ///< A bit mask of levels.
    std::vector<glm::dvec3> vertices_m_; ///< Relative to the eye.
    std::vector<std::uint32_t> indices_;
    std::vector<std::uint32_t> slots_; ///< For each hash slot its first entry.
    std::vector<Entry> entries_;
};

/// The largest change of the drawn ground from one frame to the next (popping).
struct VertexPopping {
    double popping_px = 0.0;
    glm::dvec3 place_m{0.0}; ///< Where it happens, on the later mesh.
};

/// Measures popping along a flight over one ground. Its memory is reused from frame to frame.
class PoppingMeter {
public:
    /// Takes the next frame's mesh, relative to `view.eye_m`, and compares it with the last one, both as seen from
    /// `view`: at each vertex of either mesh that both frames show, how far apart the two surfaces are on the screen.
    /// Returns nothing for the first frame.
    std::optional<VertexPopping> next(const GroundMesh& mesh, const PerspectiveView& view);

private:
    /// A frame's mesh and its surface.
    class Frame {
    public:
        void set_mesh(const GroundMesh& mesh, const PerspectiveView& view);

        const PerspectiveView& view() const { return view_; }

        /// Calls set_mesh(number, position in world axes) for the vertices that triangles use.
        template <typename Take>
        void for_each_used(const Take& set_mesh) const;

        /// The height of this frame's surface at a vertex of another one; nothing where there is none.
        std::optional<double> height_at(const Frame& other, std::uint32_t vertex);

    private:
        std::optional<double> own_height_at(const glm::dvec3& place_m) const;
        std::size_t slot_of(const glm::i64vec2& cell) const;

        PerspectiveView view_;
        std::vector<models::ColourVertex> vertices_;
        std::vector<std::uint32_t> indices_;
        std::vector<VertexMorph> morphs_;    ///< Empty where the mesh has none.
        std::vector<glm::dvec3> vertices_m_; ///< In world axes.
        std::vector<std::uint8_t> used_;     ///< For each vertex whether a triangle uses it.
        std::vector<std::uint32_t> slots_;   ///< For each hash slot a vertex + 1; 0 = none.
        MeshSurface surface_;
        bool has_surface_ = false; ///< Whether surface_ is that of this mesh.
    };

    static void compare_at(const Frame& own, Frame& other, const Frame& later, VertexPopping& most);

    std::array<Frame, 2> frames_;
    std::size_t taken_ = 0;
};

} // namespace octant::visuals::terrain
