// Which nodes of the restricted quadtree split: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD
// Method that Minimize Flickering Effect", equations (1) and (3).
//
// Deviations:
// - Equation (3), f = l / (d C max(c d2, 1)) < 1, is evaluated as C > l / (d max(c d2, 1)), with
//   both sides squared. The right side belongs to the node and the view alone, so that the C of
//   every step of N(C) is known.
// - l is sqrt(dx^2 + dy^2 + (eye's height above the ground below it)^2), with dx, dy to the node's
//   centre. The third part is the same for all nodes, so that l changes by no more than the
//   distance between two centres and splitting is monotone down the tree.
// - The root is always in the mesh, whatever its f.
// - C is raised to the tree's smallest and multiplied by the view's magnification.
#include "visuals/terrain/quadtree_criterion.h"

#include "visuals/terrain/frustum.h"

#include <cassert>
#include <cmath>

namespace octant::visuals::terrain {

namespace {

/// More than the rounding of heights in double precision can amount to.
constexpr double height_margin_m = 1e-6;

} // namespace

QuadtreeCriterion::QuadtreeCriterion(const Quadtree& tree)
    : tree_(&tree) {
    for (int level = 0; level < tree.levels(); ++level) {
        const auto edge = static_cast<float>(tree.edge_samples(level));
        levels_.push_back(
            {tree.edge_samples(level),
             tree.columns(level),
             tree.rows(level),
             tree.index_of(level, 0, 0),
             edge,
             0.5F * edge});
    }
}

void QuadtreeCriterion::set_view(const MeshView& view, const QuadtreeDetail& detail) {
    assert(view.magnification >= 1.0);
    assert(detail.roughness_weight >= 0.0 && detail.roughness_weight < 1e6);
    const models::heights::HeightField& field = tree_->field();
    const glm::dvec2 half_m = field.half_extent_m();
    const double ground_m = field
                                .height_at(
                                    std::clamp(view.eye_m.x, -half_m.x, half_m.x),
                                    std::clamp(view.eye_m.y, -half_m.y, half_m.y))
                                .value_or(0.0);
    view_ = view;
    west_m_ = -half_m.x - view.eye_m.x;
    south_m_ = -half_m.y - view.eye_m.y;
    eye_column_ = static_cast<float>(-west_m_ / field.spacing_m());
    eye_row_ = static_cast<float>(-south_m_ / field.spacing_m());
    const double height = std::max(view.eye_m.z - ground_m, 0.0) / field.spacing_m();
    eye_height_squared_ = static_cast<float>(height * height);
    fan_kind_ = detail.fans;
    roughness_weight_ = static_cast<float>(detail.roughness_weight);
}

double QuadtreeCriterion::resolution_of(float limit) const {
    return std::max(
        std::sqrt(static_cast<double>(limit)) / view_.magnification,
        tree_->options().min_resolution);
}

std::array<float, 4> QuadtreeCriterion::critical_squared_of_four(int level, int column, int row) const {
    std::array<float, 4> critical{};
    if (fan_kind_ == FanKind::Full) {
        critical.fill(critical_squared(level, column, row));
        return critical;
    }
    const Level& at = levels_[static_cast<std::size_t>(level)];
    const std::size_t east = column + 1 < at.columns ? 1 : 0;
    const std::size_t north = row + 1 < at.rows ? static_cast<std::size_t>(at.columns) : 0;
    const QuadtreeNode* first = tree_->nodes().data() + node_at(level, column, row);
    const std::array<float, 4> roughness = {
        roughness_of(first[0]),
        roughness_of(first[east]),
        roughness_of(first[north]),
        roughness_of(first[north + east])};
    for (unsigned q = 0; q < 4; ++q) {
        critical[q] = critical_squared_at(
            at, column + static_cast<int>(q & 1U), row + static_cast<int>(q >> 1U), roughness[q]);
    }
    return critical;
}

NodeBox QuadtreeCriterion::box_of(const GroundFan& node) const {
    const models::heights::HeightField& field = tree_->field();
    const QuadtreeNode& bounds = tree_->nodes()[node.node];
    const int edge = levels_[node.level].edge;
    const int west = node.column * edge;
    const int south = node.row * edge;
    NodeBox box{
        field.sample_m(west, south),
        field.sample_m(
            std::min(west + edge, field.columns() - 1), std::min(south + edge, field.rows() - 1))};
    box.min_m.z = tree_->lowest_m(bounds) - height_margin_m;
    box.max_m.z = tree_->highest_m(bounds) + height_margin_m;
    return box;
}

unsigned QuadtreeCriterion::crossed_planes_of_node(const GroundFan& node, unsigned planes) const {
    const models::heights::HeightField& field = tree_->field();
    const QuadtreeNode& bounds = tree_->nodes()[node.node];
    const int edge = levels_[node.level].edge;
    const int west = node.column * edge;
    const int south = node.row * edge;
    const int east = std::min(west + edge, field.columns() - 1);
    const int north = std::min(south + edge, field.rows() - 1);
    const double half_spacing_m = 0.5 * field.spacing_m();
    const double low_m = tree_->lowest_m(bounds) - view_.eye_m.z;
    const double high_m = tree_->highest_m(bounds) - view_.eye_m.z;
    const glm::dvec3 centre_m(
        west_m_ + (west + east) * half_spacing_m,
        south_m_ + (south + north) * half_spacing_m,
        0.5 * (low_m + high_m));
    const glm::dvec3 half_m(
        (east - west) * half_spacing_m, (north - south) * half_spacing_m, 0.5 * (high_m - low_m));
    return crossed_planes(view_.frustum_normals, planes, centre_m, half_m);
}

} // namespace octant::visuals::terrain
