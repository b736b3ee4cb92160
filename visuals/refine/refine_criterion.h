#pragma once

#include "visuals/refine/progressive_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace octant::visuals::refine {

/// Where a mesh is seen from, in the mesh's own axes.
struct RefineView {
    glm::dvec3 eye_m{0.0};
    glm::dvec3 ahead{0.0, 1.0, 0.0}; ///< unit vector
    /// Unit normals of the frustum's four sides, through the eye, inward; zero = no such side.
    std::array<glm::dvec3, 4> side_normals{};
    double focal_px = 869.1; ///< pixels that 1 m takes at 1 m
    double near_m = 0.01;    ///< what is nearer counts as this far

    bool operator==(const RefineView&) const = default;
};

/// A view with sides for a picture of so many pixels. `up` need not be square to `ahead`, only not
/// along it. fov_rad: of the height.
RefineView picture_view(
    const glm::dvec3& eye_m,
    const glm::dvec3& look_m,
    const glm::dvec3& up,
    double fov_rad,
    double width_px,
    double height_px);

struct CriterionOptions {
    double silhouette_weight = 2.0; ///< of errors where the outline may run: they show most
    double front_weight = 1.0;
    double back_weight = 0.0;    ///< of what is turned away as a whole
    double outside_weight = 0.1; ///< of what is not in the picture: it may be soon
    double play_rad = 0.0;       ///< weights are the largest for directions so far off
};

/// Error of an inner node as it would show on the screen, pixels, weighted. A node's is never more
/// than its parent's (weights: silhouette >= front >= back): what must be split is a tree's top.
double projected_error_px(
    const ProgressiveMesh& mesh,
    std::uint32_t node,
    const RefineView& view,
    const CriterionOptions& options = {});

} // namespace octant::visuals::refine
