#pragma once

#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_samples.h"
#include "visuals/terrain/perspective_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// How far a mesh misses the full-resolution ground in one picture, in pixels.
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
        std::vector<std::uint64_t> covered; ///< One bit for each sample, rows of whole words.
        std::vector<float> errors_px;
        std::int64_t uncovered = 0;
    };

    using Corners = std::array<glm::dvec3, 3>;

    void measure_band(Band& band, std::span<const std::uint32_t> indices, const Picture& picture);
    void measure_triangle(Band& band, const Corners& corners, const Picture& picture) const;
    void count_uncovered(Band& band, const Picture& picture) const;

    GroundSamples ground_;
    int threads_;
    std::size_t words_per_row_;
    std::vector<Band> bands_;
    std::vector<float> errors_px_;
    /// The vertices of the mesh: samples east and north, and metres above the eye.
    std::vector<glm::dvec3> grid_vertices_;
};

} // namespace octant::visuals::terrain
