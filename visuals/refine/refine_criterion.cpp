// The view criterion: H. Hoppe, "View-Dependent Refinement of Progressive Meshes", 1997, section 4 (view frustum,
// surface orientation, screen-space geometric error), over the bounding spheres and normal cones of the hierarchy.
//
// projected error = focal length in pixels * error of the node / distance to its bounding sphere * weight for
// orientation * weight for the frustum.
//
// Deviations: each node has one error for all directions, which the simplifier brings, instead of two fitted to
// samples; the silhouette has a weight of its own; weights change gradually over `ramp_rad` instead of in a step.
#include "visuals/refine/refine_criterion.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace octant::visuals::refine {

// Refinement of a fresh front in one go: J. Kim, S. Lee, "Truly Selective Refinement of Progressive Meshes", Graphics
// Interface 2001, section 4. Which nodes must split is known beforehand, so all are handed to split_all at once, which
// chooses an order of its own.

namespace {

/// Splits all ancestors of the marked nodes, so that these become active. `marked` has one flag for each node and is
/// changed.
std::size_t refine_above(SelectiveRefiner& refiner, std::vector<bool>& marked) {
    const ProgressiveMesh& mesh = refiner.mesh();
    for (std::uint32_t node = 0; node < mesh.node_count(); ++node) {
        const std::uint32_t parent = mesh.parent(node);
        if (marked[node] && parent != none) { marked[parent] = true; }
    }
    std::vector<std::uint32_t> wanted;
    for (auto node = static_cast<std::uint32_t>(mesh.node_count()); node-- > mesh.leaf_count();) {
        if (marked[node]) { wanted.push_back(node); }
    }
    refiner.split_all(wanted);
    return wanted.size();
}

} // namespace

std::size_t refine_regions(SelectiveRefiner& refiner, std::span<const Sphere> regions) {
    const ProgressiveMesh& mesh = refiner.mesh();
    std::vector<bool> marked(mesh.node_count(), false);
    for (std::uint32_t leaf = 0; leaf < mesh.leaf_count(); ++leaf) {
        const glm::dvec3 at_m = glm::dvec3(mesh.position_m(leaf)) + mesh.parts().origin_m;
        marked[leaf] = std::ranges::any_of(
            regions, [&](const Sphere& region) { return glm::distance(at_m, region.centre_m) <= region.radius_m; });
    }
    return refine_above(refiner, marked);
}

std::size_t refine_subtree(SelectiveRefiner& refiner, std::uint32_t node) {
    const ProgressiveMesh& mesh = refiner.mesh();
    std::vector<bool> marked(mesh.node_count(), false);
    marked[node] = true;
    for (std::uint32_t below = node; below >= mesh.leaf_count(); --below) {
        if (marked[below]) {
            marked[mesh.split_of(below).first] = true;
            marked[mesh.split_of(below).second] = true;
        }
    }
    return refine_above(refiner, marked);
}

std::size_t refine_for_view(
    SelectiveRefiner& refiner, const RefineView& view, double error_px, const CriterionOptions& options) {
    const ProgressiveMesh& mesh = refiner.mesh();
    std::vector<std::uint32_t> wanted;
    for (auto node = static_cast<std::uint32_t>(mesh.node_count()); node-- > mesh.leaf_count();) {
        if (projected_error_px(mesh, node, view, options) > error_px) { wanted.push_back(node); }
    }
    refiner.split_all(wanted);
    return wanted.size();
}

namespace {

constexpr double right_angle_rad = 0.5 * std::numbers::pi;
/// The angle over which weights change. With a step in their place, nodes would be split and collapsed again and again
/// while the eye moves.
constexpr double ramp_rad = 0.26;

/// The weight for orientation, by the largest and least angle between any normal below the node and the direction to
/// the eye. It is monotone towards the root, because spheres and cones are nested.
double facing_weight(
    const ProgressiveMesh& mesh, std::uint32_t node, const glm::dvec3& to_eye_m, const CriterionOptions& options) {
    const double distance_m = glm::length(to_eye_m);
    const double radius_m = static_cast<double>(mesh.radius_m(node));
    if (distance_m <= radius_m) { return options.silhouette_weight; }
    const double cosine = glm::dot(glm::dvec3(mesh.normal(node)), to_eye_m) / distance_m;
    const double angle_rad = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double angle_margin_rad =
        static_cast<double>(mesh.cone_rad(node)) + std::asin(radius_m / distance_m) + options.angle_margin_rad;
    // Largest and smallest angle between a normal below the node and the way to the eye; monotone up the tree, and so
    // is the weight.
    const double max_turn = (angle_rad + angle_margin_rad - right_angle_rad) / ramp_rad;
    const double min_turn = (angle_rad - angle_margin_rad - right_angle_rad) / ramp_rad;
    const double outline = std::clamp(1.0 + max_turn, 0.0, 1.0);
    const double turned = std::clamp(min_turn, 0.0, 1.0);
    const double weight = options.front_weight + outline * (options.silhouette_weight - options.front_weight);
    return weight + turned * (options.back_weight - weight);
}

/// The weight for the view frustum, by the largest angle by which the whole bounding sphere lies outside one of its
/// sides.
double picture_weight(
    double radius_m, const glm::dvec3& to_eye_m, const RefineView& view, const CriterionOptions& options) {
    const double distance_m = glm::length(to_eye_m);
    if (distance_m <= radius_m) { return 1.0; }
    const double angle_margin_rad = std::asin(radius_m / distance_m) + options.angle_margin_rad;
    double outside_rad = 0.0;
    for (const glm::dvec3& normal : view.side_normals) {
        const double sine = glm::dot(normal, to_eye_m) / distance_m;
        outside_rad = std::max(outside_rad, std::asin(std::clamp(sine, -1.0, 1.0)) - angle_margin_rad);
    }
    return 1.0 + std::min(1.0, outside_rad / ramp_rad) * (options.outside_weight - 1.0);
}

} // namespace

RefineView picture_view(const glm::dvec3& eye_m, const glm::dvec3& look_m, const glm::dvec3& up, double fov_rad,
    double width_px, double height_px) {
    RefineView view;
    view.eye_m = eye_m;
    view.forward = glm::normalize(look_m - eye_m);
    const glm::dvec3 right = glm::normalize(glm::cross(view.forward, up));
    const glm::dvec3 above = glm::cross(right, view.forward);
    const double half_height = std::tan(0.5 * fov_rad);
    const double half_width = half_height * width_px / height_px;
    view.focal_px = 0.5 * height_px / half_height;
    view.side_normals = {glm::normalize(half_width * view.forward - right),
        glm::normalize(half_width * view.forward + right), glm::normalize(half_height * view.forward - above),
        glm::normalize(half_height * view.forward + above)};
    return view;
}

double projected_error_px(
    const ProgressiveMesh& mesh, std::uint32_t node, const RefineView& view, const CriterionOptions& options) {
    const glm::dvec3 to_eye_m = view.eye_m - (glm::dvec3(mesh.position_m(node)) + mesh.parts().origin_m);
    const double radius_m = static_cast<double>(mesh.radius_m(node));
    const double away_m = std::max(glm::length(to_eye_m) - radius_m, view.near_m);
    const double error_px = view.focal_px * static_cast<double>(mesh.error_m(node)) / away_m;
    return facing_weight(mesh, node, to_eye_m, options) * picture_weight(radius_m, to_eye_m, view, options) * error_px;
}

} // namespace octant::visuals::refine
