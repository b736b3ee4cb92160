// Triangle fans of a restricted quadtree.
//
// Source: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that Minimize Flickering Effect",
// equations (1) and (3) and steps 3 and 4 of section 2; fans after S. Roettger, W. Heidrich, P.
// Slusallek, H.-P. Seidel, "Real-Time Generation of Continuous Levels of Detail for Height Fields".
// Deviations:
// - l is sqrt(dx^2 + dy^2 + (eye's height above the ground below it)^2), with dx, dy to the node's
//   centre: the third part is the same for all nodes, so that l changes by no more than the way
//   between two centres and splitting is monotone down the tree.
// - The root is always in the mesh, whatever its f.
// - C is raised to the tree's smallest and multiplied by the view's magnification.
// - An edge keeps its mid-point where this node has a child beside it; else where the node beyond
//   the edge is in the mesh or would be but for the frustum; and always at the field's border.
#include "visuals/terrain/mesher.h"

#include "visuals/terrain/frustum.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace octant::visuals::terrain {

namespace {

constexpr unsigned south_west = 1;
constexpr unsigned south_east = 2;
constexpr unsigned north_west = 4;
constexpr unsigned north_east = 8;
constexpr unsigned all_quadrants = 15;

/// Edges of a fan counter-clockwise from the south one: the corners are those of the two quadrants.
struct FanEdge {
    int corner_a_east; ///< corners in half edges from the south-west corner
    int corner_a_north;
    int corner_b_east;
    int corner_b_north;
    unsigned quadrant_a;
    unsigned quadrant_b;
};

constexpr std::array<FanEdge, 4> fan_edges = {{
    {0, 0, 2, 0, south_west, south_east},
    {2, 0, 2, 2, south_east, north_east},
    {2, 2, 0, 2, north_east, north_west},
    {0, 2, 0, 0, north_west, south_west},
}};

} // namespace

Mesher::Mesher(const Quadtree& tree, std::span<const std::uint32_t> colours)
    : tree_(&tree)
    , colours_(colours)
    , in_mesh_(tree.nodes().size(), 0)
    , vertex_of_sample_(colours.size(), 0) {
    [[maybe_unused]] const models::HeightField& field = tree.field();
    assert(
        colours.size() ==
        static_cast<std::size_t>(field.columns()) * static_cast<std::size_t>(field.rows()));
    assert(tree.levels() <= 16);
    for (int level = 0; level < tree.levels(); ++level) {
        levels_.push_back(
            {tree.edge_samples(level),
             tree.columns(level),
             tree.rows(level),
             tree.index_of(level, 0, 0),
             0.5F * static_cast<float>(tree.edge_samples(level)),
             0.0F});
    }
}

GroundMesh Mesher::mesh(const MeshView& view, const Detail& detail) {
    look_from(view, detail);
    fans_.clear();
    counters_ = {};
    visit({}, planes_of(view.frustum_normals));
    make_room();
    for (const GroundFan& fan : fans_) {
        emit(fan);
    }
    for (const GroundFan& fan : fans_) {
        in_mesh_[fan.node] = 0;
    }
    first_stamp_ += vertex_count_;
    counters_.triangles = static_cast<int>(index_count_ / 3);
    return {
        std::span(vertices_).first(vertex_count_),
        std::span(indices_).first(index_count_),
        counters_};
}

void Mesher::look_from(const MeshView& view, const Detail& detail) {
    assert(view.magnification >= 1.0);
    assert(detail.roughness_weight >= 0.0 && detail.roughness_weight < 1e6);
    const models::HeightField& field = tree_->field();
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
    const double resolution =
        std::max(detail.resolution, tree_->options().min_resolution) * view.magnification;
    for (LevelView& level : levels_) {
        level.reach = static_cast<float>(resolution * level.edge);
    }
}

/// Equation (3): f < 1, both sides times d and squared.
bool Mesher::wants_split(int level, int column, int row) const {
    const LevelView& at = levels_[static_cast<std::size_t>(level)];
    const float east = static_cast<float>(2 * column + 1) * at.half_edge - eye_column_;
    const float north = static_cast<float>(2 * row + 1) * at.half_edge - eye_row_;
    const std::size_t node = at.first +
                             static_cast<std::size_t>(row) * static_cast<std::size_t>(at.columns) +
                             static_cast<std::size_t>(column);
    const float roughness = roughness_of(tree_->nodes()[node]);
    const float reach = at.reach * std::max(roughness_weight_ * roughness, 1.0F);
    return east * east + north * north + eye_height_squared_ < reach * reach;
}

/// Whether a node is in the unculled mesh.
bool Mesher::is_split(int level, int column, int row) const {
    for (; level > 0; --level) {
        const bool wanted = fan_kind_ == FanKind::Partial
                                ? wants_split(level, column, row)
                                : wants_split(level - 1, column / 2, row / 2);
        if (!wanted) {
            return false;
        }
        column /= 2;
        row /= 2;
    }
    return true;
}

/// planes_cutting for the box of a node's samples.
unsigned Mesher::planes_cutting_node(const GroundFan& node, unsigned planes) const {
    const models::HeightField& field = tree_->field();
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
    return planes_cutting(view_.frustum_normals, planes, centre_m, half_m);
}

/// Puts a node and all that is split below it into fans_. `planes`: those that the node's box may
/// reach beyond.
void Mesher::visit(GroundFan fan, unsigned planes) {
    fan.at_frustum = planes != 0;
    in_mesh_[fan.node] = 1;
    const std::size_t own = fans_.size();
    fans_.push_back(fan);
    const int below = fan.level + 1;
    if (below == tree_->levels()) {
        return;
    }
    const LevelView& next = levels_[static_cast<std::size_t>(below)];
    const bool full = fan_kind_ == FanKind::Full;
    const bool full_split = full && wants_split(fan.level, fan.column, fan.row);
    std::array<GroundFan, 4> children;
    std::array<unsigned, 4> child_planes{};
    for (unsigned q = 0; q < 4; ++q) {
        const int column = 2 * fan.column + static_cast<int>(q & 1U);
        const int row = 2 * fan.row + static_cast<int>(q >> 1U);
        const auto quadrant = static_cast<std::uint8_t>(1U << q);
        if (column >= next.columns || row >= next.rows) {
            fan.hidden |= quadrant;
            continue;
        }
        GroundFan& child = children[q];
        child.node = static_cast<std::uint32_t>(
            next.first + static_cast<std::size_t>(row) * static_cast<std::size_t>(next.columns) +
            static_cast<std::size_t>(column));
        child.column = static_cast<std::uint16_t>(column);
        child.row = static_cast<std::uint16_t>(row);
        child.level = static_cast<std::uint8_t>(below);
        ++counters_.nodes_visited;
        child_planes[q] = planes == 0 ? 0 : planes_cutting_node(child, planes);
        if (child_planes[q] == outside_frustum) {
            fan.hidden |= quadrant;
        }
        if (full ? full_split : wants_split(below, column, row)) {
            fan.split |= quadrant;
        }
    }
    fans_[own] = fan;
    const unsigned drawn = fan.split & ~static_cast<unsigned>(fan.hidden);
    for (unsigned q = 0; q < 4; ++q) {
        if ((drawn >> q & 1U) != 0) {
            visit(children[q], child_planes[q]);
        }
    }
}

/// Room for nine vertices and eight triangles a fan, and stamps for all of them.
void Mesher::make_room() {
    const std::size_t most_vertices = std::min(9 * fans_.size(), vertex_of_sample_.size());
    if (vertices_.size() < most_vertices) {
        vertices_.resize(most_vertices + most_vertices / 4);
    }
    if (indices_.size() < 24 * fans_.size()) {
        indices_.resize(30 * fans_.size());
    }
    vertex_count_ = 0;
    index_count_ = 0;
    if (std::numeric_limits<std::uint32_t>::max() - first_stamp_ < most_vertices) {
        std::fill(vertex_of_sample_.begin(), vertex_of_sample_.end(), 0U);
        first_stamp_ = 1;
    }
}

/// Whether the node beyond one edge is in the mesh, or the field ends there.
bool Mesher::has_neighbour(const GroundFan& fan, int east, int north) const {
    const LevelView& at = levels_[fan.level];
    const int column = fan.column + east;
    const int row = fan.row + north;
    if (column < 0 || row < 0 || column >= at.columns || row >= at.rows) {
        return true;
    }
    const std::ptrdiff_t step = east + static_cast<std::ptrdiff_t>(north) * at.columns;
    if (in_mesh_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(fan.node) + step)] != 0) {
        return true;
    }
    return fan.at_frustum && is_split(fan.level, column, row);
}

/// Bit k: edge k of fan_edges has a mid-point.
unsigned Mesher::middles_of(const GroundFan& fan) const {
    constexpr std::array<std::array<int, 2>, 4> beyond = {{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
    unsigned middles = 0;
    for (unsigned k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        if ((fan.split & (edge.quadrant_a | edge.quadrant_b)) != 0 ||
            has_neighbour(fan, beyond[k][0], beyond[k][1])) {
            middles |= 1U << k;
        }
    }
    return middles;
}

void Mesher::emit(const GroundFan& fan) {
    if (fan.split == all_quadrants) {
        return;
    }
    const models::HeightField& field = tree_->field();
    const int last_column = field.columns() - 1;
    const int last_row = field.rows() - 1;
    const int edge = levels_[fan.level].edge;
    const int half = edge / 2;
    const int west = fan.column * edge;
    const int south = fan.row * edge;
    const bool cut = west + edge > last_column || south + edge > last_row;
    const auto sample = [&](int east, int north) {
        return Sample{
            std::min(west + east * half, last_column), std::min(south + north * half, last_row)};
    };
    const Sample centre = sample(1, 1);
    const std::size_t first_index = index_count_;
    const auto triangle = [&](Sample a, Sample b) {
        if (cut && (a.column - centre.column) * (b.row - centre.row) ==
                       (a.row - centre.row) * (b.column - centre.column)) {
            return;
        }
        indices_[index_count_] = vertex_at(centre);
        indices_[index_count_ + 1] = vertex_at(a);
        indices_[index_count_ + 2] = vertex_at(b);
        index_count_ += 3;
    };
    const unsigned middles = middles_of(fan);
    const unsigned covered = fan.split | fan.hidden;
    for (unsigned k = 0; k < 4; ++k) {
        const FanEdge& at = fan_edges[k];
        const Sample a = sample(at.corner_a_east, at.corner_a_north);
        const Sample b = sample(at.corner_b_east, at.corner_b_north);
        if ((middles >> k & 1U) == 0) {
            triangle(a, b);
            continue;
        }
        const Sample middle = sample(
            (at.corner_a_east + at.corner_b_east) / 2, (at.corner_a_north + at.corner_b_north) / 2);
        if ((covered & at.quadrant_a) == 0) {
            triangle(a, middle);
        }
        if ((covered & at.quadrant_b) == 0) {
            triangle(middle, b);
        }
    }
    counters_.fans += index_count_ > first_index ? 1 : 0;
}

std::uint32_t Mesher::vertex_at(Sample at) {
    const models::HeightField& field = tree_->field();
    const std::size_t sample =
        static_cast<std::size_t>(at.row) * static_cast<std::size_t>(field.columns()) +
        static_cast<std::size_t>(at.column);
    std::uint32_t& stamp = vertex_of_sample_[sample];
    if (stamp >= first_stamp_) {
        return stamp - first_stamp_;
    }
    stamp = first_stamp_ + vertex_count_;
    const double height_m = static_cast<double>(field.height_m(at.column, at.row));
    vertices_[vertex_count_] = {
        glm::vec3(
            static_cast<float>(west_m_ + at.column * field.spacing_m()),
            static_cast<float>(south_m_ + at.row * field.spacing_m()),
            static_cast<float>(height_m - view_.eye_m.z)),
        colours_[sample]};
    return vertex_count_++;
}

} // namespace octant::visuals::terrain
