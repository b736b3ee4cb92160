#pragma once

#include "models/simplify/collapsible_mesh.h"
#include "models/simplify/polish_target.h"
#include "models/simplify/triangle_samples.h"
#include "models/simplify/vertex_fit.h"
#include "models/simplify/working_surface.h"
#include "sim/base/worker_team.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::models::simplify {

/// Pairs sample points of a surface's triangles with the points of the target surface at which they
/// aim: the correspondences of iterated closest points. A sample aims at the nearest point of the
/// target, or, where the target faces against the triangle there (the opposite side of a thin
/// part), at the nearest point that faces its way. All lengths are in working units.
class SampleAims {
public:
    /// `fields` is the number of grid fields along a triangle's side, so that each triangle has
    /// fields^2 samples.
    explicit SampleAims(int fields)
        : samples_(middle_grid(fields)) {}

    /// Finds the aims of all samples for the surface as it is now. `threads` does not change the
    /// result.
    void take(const WorkingSurface& surface, const PolishTarget& target, int threads);

    /// The cost of a triangle with the given corners: the sum over its samples of weight (the area
    /// that a sample stands for) times squared distance to the sample's aim. Distances along the
    /// triangle count by `sideways` only.
    double cost(std::uint32_t face, const std::array<glm::dvec3, 3>& corners) const;

    /// The largest squared distance from a sample of a triangle with the given corners to its aim.
    double most2(std::uint32_t face, const std::array<glm::dvec3, 3>& corners) const;

    /// Adds the samples of a triangle to the least-squares fit of the vertex at one of its corners.
    void add_to(
        VertexFit& fit,
        std::uint32_t face,
        const std::array<glm::dvec3, 3>& corners,
        std::size_t corner) const;

    /// The area-weighted squared distances from samples of any triangle to the nearest points of
    /// the target, which are searched anew.
    double true_cost(const PolishTarget& target, const std::array<glm::dvec3, 3>& corners) const;

private:
    struct Aim {
        glm::dvec3 place{0.0};
        double pull = 1.0; ///< The weight of the sample.
    };

    double mean_square(const WorkingSurface& surface) const;

    std::vector<TriangleSample> samples_;
    std::vector<Aim> aims_;  ///< For each triangle slot the aims of its samples.
    double usual_off_ = 0.0; ///< The root mean square distance to the aims that were taken last.
};

/// Calls `work(first, end)` for ranges that cover all triangle slots, on several threads.
template <typename Work>
void for_face_ranges(const CollapsibleMesh& mesh, int threads, const Work& work) {
    constexpr std::size_t chunk = 256;
    const std::size_t slots = mesh.face_slots();
    share_out((slots + chunk - 1) / chunk, threads, [&](std::size_t part, std::size_t) {
        const std::size_t end = std::min((part + 1) * chunk, slots);
        work(static_cast<std::uint32_t>(part * chunk), static_cast<std::uint32_t>(end));
    });
}

} // namespace octant::models::simplify
