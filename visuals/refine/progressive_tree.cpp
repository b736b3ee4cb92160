// Builds a hierarchy from the splits of a file and checks each of them: that the node is active, that its leaves are
// divided into two non-empty parts, that its faces join both parts with one corner elsewhere, and that its two cut
// vertices differ, as J. Kim and S. Lee's rule (2001, section 3) demands in the state that the simplification went
// through.
#include "visuals/refine/progressive_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace octant::visuals::refine {

namespace {

bool is_finite(const glm::vec3& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

bool lies_in(std::uint32_t leaf, std::uint32_t begin, std::uint32_t end) { return leaf >= begin && leaf < end; }

/// The one corner of a face that is not a leaf in [begin, end).
std::uint32_t outside_corner(const TreeFace& face, std::uint32_t begin, std::uint32_t end) {
    return *std::ranges::find_if(face.corners, [&](std::uint32_t corner) { return !lies_in(corner, begin, end); });
}

/// Whether a face has one corner in [begin, middle), one in [middle, end) and one outside, all of them below `all`.
bool lies_across(
    const TreeFace& face, std::uint32_t begin, std::uint32_t middle, std::uint32_t end, std::uint32_t all) {
    int first = 0;
    int second = 0;
    for (const std::uint32_t corner : face.corners) {
        first += lies_in(corner, begin, middle) ? 1 : 0;
        second += lies_in(corner, middle, end) ? 1 : 0;
        if (corner >= all) { return false; }
    }
    return first == 1 && second == 1;
}

bool is_permutation_of_places(const std::vector<std::uint32_t>& numbers) {
    std::vector<bool> met(numbers.size(), false);
    for (const std::uint32_t number : numbers) {
        if (number >= met.size() || met[number]) { return false; }
        met[number] = true;
    }
    return true;
}

} // namespace

bool ProgressiveTree::add_root(const TreeNode& root) {
    active_.emplace(root.begin, static_cast<std::uint32_t>(nodes_.size()));
    nodes_.push_back(root);
    return root.begin < root.end && is_finite(root.position_m);
}

bool ProgressiveTree::roots_cover_leaves(std::uint32_t leaves) {
    leaves_ = leaves;
    std::vector<TreeNode> roots = nodes_;
    std::ranges::sort(roots, {}, &TreeNode::begin);
    std::uint32_t covered = 0;
    for (const TreeNode& root : roots) {
        if (root.begin != covered) { return false; }
        root_begins_.push_back(root.begin);
        covered = root.end;
    }
    if (covered != leaves) { return false; }
    starts_.assign(leaves);
    for (const std::uint32_t begin : root_begins_) { starts_.add(begin); }
    return true;
}

std::uint32_t ProgressiveTree::add_face(const TreeFace& face) {
    faces_.push_back(face);
    return static_cast<std::uint32_t>(faces_.size() - 1);
}

bool ProgressiveTree::add_base_face(const TreeFace& face) {
    add_face(face);
    std::array<std::uint32_t, 3> roots{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto behind = std::ranges::upper_bound(root_begins_, face.corners[k]);
        if (face.corners[k] >= leaves_) { return false; }
        roots[k] = static_cast<std::uint32_t>(behind - root_begins_.begin());
    }
    return roots[0] != roots[1] && roots[1] != roots[2] && roots[2] != roots[0];
}

/// Whether the active vertices next to both children differ. If they are the same, the split must wait for that vertex
/// to split first, which in a damaged file might never end.
bool ProgressiveTree::is_cut_apart(const TreeSplit& split, std::uint32_t end) const {
    return !split.left || !split.right ||
           starts_.last_up_to(outside_corner(*split.left, split.begin, end)) !=
               starts_.last_up_to(outside_corner(*split.right, split.begin, end));
}

bool ProgressiveTree::add_split(const TreeSplit& split) {
    const auto at = active_.find(split.begin);
    if (at == active_.end()) { return false; }
    GrownSplit grown;
    grown.node = at->second;
    grown.first_child = static_cast<std::uint32_t>(nodes_.size());
    grown.error_m = split.error_m;
    const std::uint32_t end = nodes_[grown.node].end;
    bool good = split.middle > split.begin && split.middle < end && std::isfinite(split.error_m) &&
                split.error_m >= 0.0F && is_finite(split.first.position_m) && is_finite(split.second.position_m);
    for (const auto& face : {split.left, split.right}) {
        good = good && (!face || lies_across(*face, split.begin, split.middle, end, leaves_));
    }
    if (!good || !is_cut_apart(split, end)) { return false; }
    grown.left_face = split.left ? add_face(*split.left) : none;
    grown.right_face = split.right ? add_face(*split.right) : none;
    nodes_.push_back(split.first);
    nodes_.back().begin = split.begin;
    nodes_.back().end = split.middle;
    nodes_.push_back(split.second);
    nodes_.back().begin = split.middle;
    nodes_.back().end = end;
    at->second = grown.first_child;
    active_.emplace(split.middle, grown.first_child + 1);
    starts_.add(split.middle);
    splits_.push_back(grown);
    return true;
}

bool ProgressiveTree::number(std::vector<std::uint32_t> vertices, std::vector<std::uint32_t> faces) {
    vertex_numbers_ = std::move(vertices);
    face_numbers_ = std::move(faces);
    return is_permutation_of_places(vertex_numbers_) && is_permutation_of_places(face_numbers_);
}

/// For each node its number in ProgressiveMeshData: the leaves by their place in the order, then the inner nodes, the
/// last split first.
std::vector<std::uint32_t> ProgressiveTree::final_numbers() const {
    std::vector<std::uint32_t> numbers(nodes_.size(), none);
    auto next = static_cast<std::uint32_t>(nodes_.size());
    for (const GrownSplit& split : splits_) { numbers[split.node] = --next; }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> leaves;
    for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
        if (numbers[node] == none) { leaves.emplace_back(nodes_[node].begin, node); }
    }
    std::ranges::sort(leaves);
    for (std::uint32_t place = 0; place < leaves.size(); ++place) { numbers[leaves[place].second] = place; }
    return numbers;
}

ProgressiveMeshData ProgressiveTree::parts() const {
    const std::vector<std::uint32_t> numbers = final_numbers();
    const std::size_t leaves = nodes_.size() - splits_.size();
    ProgressiveMeshData parts;
    parts.positions_m.resize(nodes_.size());
    parts.normals.resize(nodes_.size());
    parts.colours.resize(nodes_.size());
    std::vector<std::uint32_t> begins(leaves);
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
        parts.positions_m[numbers[node]] = nodes_[node].position_m;
        parts.normals[numbers[node]] = nodes_[node].normal;
        parts.colours[numbers[node]] = nodes_[node].colour;
        if (numbers[node] < leaves) { begins[numbers[node]] = nodes_[node].begin; }
    }
    parts.splits.resize(splits_.size());
    for (const GrownSplit& split : splits_) {
        parts.splits[numbers[split.node] - leaves] = {numbers[split.first_child], numbers[split.first_child + 1],
            split.left_face, split.right_face, split.error_m};
    }
    parts.faces.resize(faces_.size());
    parts.face_materials.resize(faces_.size());
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
        Triangle corners = faces_[face].corners;
        for (std::uint32_t& corner : corners) {
            const auto behind = std::ranges::upper_bound(begins, corner);
            corner = static_cast<std::uint32_t>(behind - begins.begin() - 1);
        }
        parts.faces[face] = corners;
        parts.face_materials[face] = faces_[face].material;
    }
    parts.original_faces = face_numbers_;
    parts.original_vertices = vertex_numbers_;
    for (auto leaf = static_cast<std::uint32_t>(parts.original_vertices.size()); leaf < leaves; ++leaf) {
        parts.original_vertices.push_back(leaf);
    }
    return parts;
}

} // namespace octant::visuals::refine
