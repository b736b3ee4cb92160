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

/// Where samples of a surface's triangles aim on the target: at the nearest place, or, where the
/// target faces against the triangle there, at the nearest one that faces its way.
class SampleAims {
public:
    /// `fields`: of the grid of samples on each triangle.
    explicit SampleAims(int fields)
        : samples_(middle_grid(fields)) {}

    /// Aims from where the surface is now.
    void take(const WorkingSurface& surface, const PolishTarget& target, int threads);

    /// The squared distances from a triangle's samples to where they aim, by the area they stand
    /// for; across the triangle, and with less weight along it.
    double cost(std::uint32_t face, const std::array<glm::dvec3, 3>& corners) const;

    /// Adds them to a fit of the vertex at that corner.
    void add_to(
        VertexFit& fit,
        std::uint32_t face,
        const std::array<glm::dvec3, 3>& corners,
        std::size_t corner) const;

    /// The squared distances of samples of such a triangle, by their area.
    double true_cost(const PolishTarget& target, const std::array<glm::dvec3, 3>& corners) const;

private:
    struct Aim {
        glm::dvec3 place{0.0};
        double pull = 1.0;
    };

    double mean_square(const WorkingSurface& surface) const;

    std::vector<TriangleSample> samples_;
    std::vector<Aim> aims_;  ///< of each triangle's samples
    double usual_off_ = 0.0; ///< root of the mean square, when they were taken last
};

/// Calls `work(first, end)` for ranges of all triangles, on several threads.
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
