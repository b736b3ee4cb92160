#pragma once

#include "visuals/refine/progressive_mesh.h"
#include "visuals/refine/selective_refiner.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace octant::visuals::refine {

/// Where a mesh is seen from, in the mesh's own axes (those of its file), metres.
struct RefineView {
    glm::dvec3 eye_m{0.0};
    glm::dvec3 forward{0.0, 1.0, 0.0}; ///< A unit vector along the line of sight.
    /// The unit normals of the view frustum's four side planes, which pass through the eye, pointing inwards; zero
    /// means that there is no such side.
    std::array<glm::dvec3, 4> side_normals{};
    double focal_px = 869.1; ///< How many pixels an object of 1 m covers at a distance of 1 m.
    double near_m = 0.01;    ///< Anything nearer counts as being this far away.

    bool operator==(const RefineView&) const = default;
};

/// A view with a frustum for a picture of the given size. `up` need not be perpendicular to the line of sight but must
/// not be along it. `fov_rad` is the vertical field of view.
RefineView picture_view(const glm::dvec3& eye_m, const glm::dvec3& look_m, const glm::dvec3& up, double fov_rad,
    double width_px, double height_px);

/// How much an error counts, depending on where it is. silhouette_weight >= front_weight >= back_weight.
struct CriterionOptions {
    /// The weight where the silhouette may run, because errors show most there.
    double silhouette_weight = 2.0;
    double front_weight = 1.0;
    /// The weight of a node whose normal cone faces away from the eye entirely.
    double back_weight = 0.0;
    /// The weight outside the view frustum; it is not 0, because the node may soon be inside.
    double outside_weight = 0.1;
    /// Weights are taken as the largest within this angle, so that they do not change at once when the eye moves.
    double angle_margin_rad = 0.0;
};

/// The screen-space error of an inner node in pixels, weighted by its orientation and place. A node's is never more
/// than its parent's, so the nodes above a threshold always form the top of each tree.
double projected_error_px(
    const ProgressiveMesh& mesh, std::uint32_t node, const RefineView& view, const CriterionOptions& options = {});

/// A region in which the mesh is to be refined.
struct Sphere {
    glm::dvec3 centre_m{0.0}; ///< In the mesh's own axes.
    double radius_m = 0.0;
};

/// Splits until every original vertex inside one of the spheres is active, as in the paper's example of the cow whose
/// chest alone is refined. Returns how many splits that requests: the inner nodes that have such a vertex below them;
/// splits forced by the rule are not counted. Does not call repair().
std::size_t refine_regions(SelectiveRefiner& refiner, std::span<const Sphere> regions);

/// Splits until every original vertex below a node is active. Returns the requested splits as refine_regions does.
std::size_t refine_subtree(SelectiveRefiner& refiner, std::uint32_t node);

/// Splits every inner node whose projected error exceeds `error_px`. Returns how many these are. Does not call
/// repair().
std::size_t refine_for_view(
    SelectiveRefiner& refiner, const RefineView& view, double error_px, const CriterionOptions& options = {});

} // namespace octant::visuals::refine
