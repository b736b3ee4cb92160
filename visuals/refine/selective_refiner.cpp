// Selective refinement: J. Kim, S. Lee, "Truly Selective Refinement of Progressive Meshes", Graphics Interface 2001,
// section 4, with vsplit(vs, vt, vu, val, var) and ecol(vs, vt, vu), where val = ActiveAncestor(vs.l^) and var =
// ActiveAncestor(vs.r^) are the active cut vertices. A split is legal when val != var; else that vertex splits first.
//
// A split gives vs's slot to its first child, a new slot to the second, and moves those corners to the new slot whose
// original corners lie below the second child. A collapse does the reverse. Both touch only the faces around the
// vertex.
//
// Deviations:
// - The paper collapses wherever both children are active. In a state that no simplification went
//   through that can pinch the surface; here the link condition is tested and the collapse refused
//   (at the end of this file).
// - The paper does not speak of faces that turn over where fine meets coarse. See repair().
// - The paper walks around vs from one cut vertex to the other to divide its faces. Here the leaf
//   numbers of each face's original corners tell the side.
#include "visuals/refine/selective_refiner.h"

#include "sim/base/bit_set.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <functional>
#include <utility>

namespace octant::visuals::refine {

namespace {

RefinedVertex drawn(const NodeGeometry& shape) { return {shape.position_m, shape.normal, packed_rgba8(shape.colour)}; }

/// The given nodes without repetition in descending order.
std::vector<std::uint32_t> falling(std::span<const std::uint32_t> nodes, std::size_t node_count) {
    BitSet wanted(node_count);
    for (const std::uint32_t node : nodes) { wanted.add(node); }
    std::vector<std::uint32_t> ordered;
    ordered.reserve(nodes.size());
    for_each_bit(wanted.words(), [&](std::size_t node) { ordered.push_back(static_cast<std::uint32_t>(node)); });
    std::ranges::reverse(ordered);
    return ordered;
}

} // namespace

SelectiveRefiner::SelectiveRefiner(std::shared_ptr<const ProgressiveMesh> mesh, RefinerOptions options)
    : mesh_(std::move(mesh)), options_(std::move(options)), faces_(mesh_->leaf_count(), mesh_->face_count()) {
    stack_.reserve(64);
    path_.reserve(64);
    restart();
}

void SelectiveRefiner::restart() {
    faces_.clear();
    vertices_.clear();
    changed_.clear();
    recent_splits_.clear();
    starts_.assign(mesh_->leaf_count());
    slots_.assign(mesh_->leaf_count());
    for (const std::uint32_t root : mesh_->roots()) {
        starts_.add(mesh_->first_leaf(root));
        const std::uint32_t slot = new_slot();
        slots_.set(mesh_->first_leaf(root), slot);
        put(slot, root, mesh_->shape(root));
        mark_changed(slot);
    }
    active_count_ = faces_.vertex_count();
    const std::vector<bool> base = mesh_->base_faces();
    for (std::uint32_t face = 0; face < base.size(); ++face) {
        if (base[face]) {
            std::array<std::uint32_t, 3> corners = mesh_->faces()[face];
            for (std::uint32_t& corner : corners) { corner = slot_above(corner); }
            dirty_faces_.mark(faces_.add(corners, face));
        }
    }
}

std::uint32_t SelectiveRefiner::new_slot() {
    const std::uint32_t slot = faces_.add_vertex();
    if (slot >= vertices_.size()) {
        reserve_up_to(vertices_, vertices_.size() + 1, mesh_->leaf_count());
        vertices_.emplace_back();
    }
    dirty_vertices_.mark(slot);
    return slot;
}

/// Puts a node into a slot, drawn at its own position.
void SelectiveRefiner::put(std::uint32_t slot, std::uint32_t node, const NodeGeometry& shape) {
    faces_.set_vertex_label(slot, node);
    vertices_[slot] = drawn(shape);
}

std::size_t SelectiveRefiner::split(std::uint32_t node) { return split_single(node, nullptr); }

/// As split(); adds the nodes that the rule demanded to `forced` unless that is null. The common case, an active node
/// with two different cut vertices, takes no detour.
std::size_t SelectiveRefiner::split_single(std::uint32_t node, std::vector<std::uint32_t>* forced) {
    assert(!mesh_->is_leaf(node));
    const std::uint32_t leaf = mesh_->first_leaf(node);
    const std::uint32_t begins_there = starts_.has(leaf) ? node_at(slots_[leaf]) : none;
    if (begins_there < node) {
        return 0; // it is split
    }
    if (begins_there == node && !options_.required_split) {
        if (const Cuts cuts = active_cuts(node); cuts.left != cuts.right) { // nearly always
            apply_split(node, cuts);
            return 1;
        }
    }
    const std::size_t before = counts_.splits;
    split_with_prerequisites(node, forced);
    return counts_.splits - before;
}

/// Splits an inner node that is not split yet, after its ancestors and whatever the rule demands. Works on a stack of
/// nodes, each of which waits for the one above it.
void SelectiveRefiner::split_with_prerequisites(std::uint32_t node, std::vector<std::uint32_t>* forced) {
    // The node itself and its ancestors were asked for; every other split counts as forced.
    path_.clear();
    for (std::uint32_t at = node; at != none && !is_split(at); at = mesh_->parent(at)) { path_.push_back(at); }
    stack_.push_back(node);
    while (!stack_.empty()) {
        const std::uint32_t next = stack_.back();
        if (is_split(next)) {
            stack_.pop_back();
        } else if (!is_active(next)) {
            stack_.push_back(mesh_->parent(next));
        } else if (const std::uint32_t first = options_.required_split ? options_.required_split(*this, next) : none;
                   first != none) {
            stack_.push_back(first);
        } else if (const Cuts cuts = active_cuts(next); cuts.left == cuts.right) {
            stack_.push_back(node_at(slots_[cuts.left]));
        } else {
            apply_split(next, cuts);
            stack_.pop_back();
            if (std::ranges::find(path_, next) == path_.end()) {
                ++counts_.forced_by_rule;
                if (forced != nullptr) { forced->push_back(next); }
            }
        }
    }
}

/// Splits in descending order of node numbers. By the numbering of ProgressiveMesh parents then come before children,
/// and each split finds most of what it reads in the cache.
std::size_t SelectiveRefiner::split_all(std::span<const std::uint32_t> nodes) {
    const std::size_t before = counts_.splits;
    const std::vector<std::uint32_t> ordered = falling(nodes, mesh_->node_count());
    std::vector<std::uint32_t> forced;
    for (const std::uint32_t node : ordered) { split_single(node, &forced); }
    // A forced split was asked for after all when one of the given nodes lies below it.
    for (const std::uint32_t node : forced) {
        const auto next = std::ranges::lower_bound(ordered, node, std::greater{});
        const std::uint32_t below = mesh_->last_leaf(node) - mesh_->first_leaf(node);
        counts_.forced_by_rule -= static_cast<std::size_t>(next != ordered.end() && *next + below > node);
    }
    return counts_.splits - before;
}

/// The first leaves of val and var: where the active vertices next to both children begin.
SelectiveRefiner::Cuts SelectiveRefiner::active_cuts(std::uint32_t node) const {
    const std::uint32_t left = mesh_->split_of(node).left_cut;
    const std::uint32_t right = mesh_->split_of(node).right_cut;
    return {left == none ? none : starts_.last_up_to(left), right == none ? none - 1 : starts_.last_up_to(right)};
}

/// vsplit: replaces an active node by its children, given its active cut vertices, which must differ.
void SelectiveRefiner::apply_split(std::uint32_t node, const Cuts& cuts) {
    const VertexSplit split = mesh_->split_of(node);
    const std::uint32_t middle = split.middle;
    const std::uint32_t first_slot = slots_[split.first_leaf];
    const std::uint32_t second_slot = new_slot();
    starts_.add(middle);
    slots_.set(middle, second_slot);
    ++active_count_;
    ++counts_.splits;
    if (options_.records_splits) { recent_splits_.push_back(node); }
    const auto shapes = mesh_->child_shapes(node);
    put(first_slot, split.first, shapes[0]);
    put(second_slot, split.second, shapes[1]);
    dirty_vertices_.mark(first_slot);
    faces_.move_corners(first_slot, second_slot, [&](std::uint32_t corner) {
        const bool moves = mesh_->faces()[faces_.label(corner / 3)][corner % 3] >= middle;
        dirty_faces_.mark_if(corner / 3, moves);
        return moves;
    });
    const auto add_face = [&](std::uint32_t face, std::uint32_t cut_leaf, std::uint32_t cut) {
        const std::uint32_t cut_slot = slots_[cut];
        std::array<std::uint32_t, 3> corners = mesh_->faces()[face];
        for (std::uint32_t& corner : corners) {
            corner = corner == cut_leaf ? cut_slot : corner >= middle ? second_slot : first_slot;
        }
        dirty_faces_.mark(faces_.add(corners, face));
    };
    if (split.left_face != none) { add_face(split.left_face, split.left_cut, cuts.left); }
    if (split.right_face != none) { add_face(split.right_face, split.right_cut, cuts.right); }
    mark_changed(first_slot);
    mark_changed(second_slot);
}

bool SelectiveRefiner::can_collapse(std::uint32_t node) {
    assert(!mesh_->is_leaf(node));
    const VertexSplit split = mesh_->split_of(node);
    if (!is_active(split.first) || !is_active(split.second)) { return false; }
    const std::uint32_t first_slot = slot(split.first);
    const std::uint32_t second_slot = slot(split.second);
    return satisfies_link_condition(first_slot, second_slot) &&
           !(options_.repair &&
               (flips_faces(first_slot, second_slot, node) || flips_faces(second_slot, first_slot, node)));
}

bool SelectiveRefiner::collapse(std::uint32_t node) {
    if (!can_collapse(node)) {
        ++counts_.blocked;
        return false;
    }
    apply_collapse(node);
    return true;
}

/// ecol: replaces two active siblings by their parent.
void SelectiveRefiner::apply_collapse(std::uint32_t node) {
    const VertexSplit split = mesh_->split_of(node);
    const std::uint32_t first_slot = slot(split.first);
    const std::uint32_t second_slot = slot(split.second);
    for (const std::uint32_t face : {split.left_face, split.right_face}) {
        if (face != none) {
            const std::uint32_t place = faces_.find(first_slot, face);
            dirty_faces_.mark(place);
            faces_.remove(place);
        }
    }
    faces_.move_corners(second_slot, first_slot, [&](std::uint32_t corner) {
        dirty_faces_.mark(corner / 3);
        return true;
    });
    starts_.remove(split.middle);
    --active_count_;
    ++counts_.collapses;
    faces_.remove_vertex(second_slot);
    put(first_slot, node, mesh_->shape(node));
    dirty_vertices_.mark(first_slot);
    mark_changed(first_slot);
}

RefinedVertex SelectiveRefiner::vertex_of(std::uint32_t node) const { return drawn(mesh_->shape(node)); }

void SelectiveRefiner::set_drawn_vertex(std::uint32_t slot, const RefinedVertex& vertex) {
    vertices_[slot] = vertex;
    dirty_vertices_.mark(slot);
}

void SelectiveRefiner::take_dirty_vertices(std::vector<SlotRange>& ranges) {
    dirty_vertices_.take(vertices_.size(), ranges);
}

void SelectiveRefiner::take_dirty_faces(std::vector<SlotRange>& ranges) {
    dirty_faces_.take(faces_.face_slot_count(), ranges);
}

std::size_t SelectiveRefiner::bytes() const {
    const std::size_t numbers = stack_.capacity() + path_.capacity() + changed_.capacity() + recent_splits_.capacity();
    return sizeof(*this) + faces_.bytes() + starts_.bytes() + slots_.bytes() + sizeof(std::uint32_t) * numbers +
           dirty_vertices_.bytes() + dirty_faces_.bytes();
}

// The parts of SelectiveRefiner that check before an operation and mend after it.
//
// - Link condition (T. Dey, H. Edelsbrunner, S. Guha, D. Nekhayev, "Topology Preserving Edge
//   Contraction", 1999): an edge may collapse when the common neighbours of its ends are just the
//   third corners of its faces. Kim and Lee (2001) do not test it, because their collapses undo
//   splits; in a state that no simplification went through, a collapse can pinch the surface.
// - Fold-overs: where fine meets coarse, a face may turn over against its original. repair() splits
//   its coarsest corner until none is left, and a collapse that would turn a face is refused.

namespace {

// Marks on vertices; the first three are set only while satisfies_link_condition runs. `once`: seen in one face of the
// first vertex; `twice`: seen in two; `seen`: met at the second vertex; `changed`: its faces have changed since
// repair() last looked at them.
constexpr std::uint32_t once = 1;
constexpr std::uint32_t twice = 2;
constexpr std::uint32_t seen = 4;
constexpr std::uint32_t changed = 8;
constexpr std::uint32_t link_bits = once | twice | seen;

/// Whether a triangle's normal is more than 90 degrees off another one.
bool is_against(const glm::vec3& a_m, const glm::vec3& b_m, const glm::vec3& c_m, const glm::vec3& normal) {
    const glm::dvec3 a(a_m);
    return glm::dot(glm::cross(glm::dvec3(b_m) - a, glm::dvec3(c_m) - a), glm::dvec3(normal)) < 0.0;
}

} // namespace

/// Whether collapsing the edge between two vertices leaves a manifold of the same topology: they have no common
/// neighbours but the third corners of the one or two faces between them, they are not both on a boundary unless the
/// edge is, and their component is more than a lone tetrahedron or triangle.
bool SelectiveRefiner::satisfies_link_condition(std::uint32_t first_slot, std::uint32_t second_slot) {
    std::size_t first_faces = 0;
    int first_open = 0; // The number of its boundary edges.
    faces_.for_each_corner(first_slot, [&](std::uint32_t corner) {
        ++first_faces;
        for (const std::uint32_t at : {FaceLists::next_in_face(corner), FaceLists::previous_in_face(corner)}) {
            const std::uint32_t other = faces_.vertex(at);
            const bool is_new = (faces_.marks(other) & once) == 0;
            first_open += is_new ? 1 : -1;
            mark(other, is_new ? once : twice);
        }
    });
    std::size_t second_faces = 0;
    std::size_t second_neighbours = 0;
    std::size_t common = 0;
    std::size_t between = 0;
    faces_.for_each_corner(second_slot, [&](std::uint32_t corner) {
        ++second_faces;
        for (const std::uint32_t at : {FaceLists::next_in_face(corner), FaceLists::previous_in_face(corner)}) {
            const std::uint32_t other = faces_.vertex(at);
            between += static_cast<std::size_t>(other == first_slot);
            if ((faces_.marks(other) & seen) == 0) {
                mark(other, seen);
                ++second_neighbours;
                common += static_cast<std::size_t>((faces_.marks(other) & once) != 0);
            }
        }
    });
    clear_link_marks(first_slot);
    clear_link_marks(second_slot);
    const bool both_open = first_open > 0 && second_neighbours > second_faces;
    const bool alone = between == 2 ? first_open == 0 && first_faces == 3 && second_faces == 3 && second_neighbours == 3
                                    : first_faces == 1 && second_faces == 1;
    return common == between && !(both_open && between == 2) && !alone;
}

void SelectiveRefiner::mark(std::uint32_t slot, std::uint32_t bits) {
    faces_.set_marks(slot, faces_.marks(slot) | bits);
}

void SelectiveRefiner::unmark(std::uint32_t slot, std::uint32_t bits) {
    faces_.set_marks(slot, faces_.marks(slot) & ~bits);
}

void SelectiveRefiner::clear_link_marks(std::uint32_t slot) {
    faces_.for_each_corner(slot, [&](std::uint32_t corner) {
        unmark(faces_.vertex(FaceLists::next_in_face(corner)), link_bits);
        unmark(faces_.vertex(FaceLists::previous_in_face(corner)), link_bits);
    });
}

/// The position of the node at a corner (not of its vertex, which may be in motion).
const glm::vec3& SelectiveRefiner::position_at(std::uint32_t corner) const {
    return mesh_->position_m(node_at(faces_.vertex(corner)));
}

/// Whether any face at `slot` that does not touch `other` would turn over against its original when the slot's vertex
/// moved to the position of `node`.
bool SelectiveRefiner::flips_faces(std::uint32_t slot, std::uint32_t other, std::uint32_t node) const {
    bool turns = false;
    faces_.for_each_corner(slot, [&](std::uint32_t corner) {
        const std::uint32_t b = faces_.vertex(FaceLists::next_in_face(corner));
        const std::uint32_t c = faces_.vertex(FaceLists::previous_in_face(corner));
        turns = turns || (b != other && c != other &&
                             is_against(mesh_->position_m(node), mesh_->position_m(node_at(b)),
                                 mesh_->position_m(node_at(c)), mesh_->face_normal(faces_.label(corner / 3))));
    });
    return turns;
}

/// Whether the face at a place of the index list is more than 90 degrees off its original.
bool SelectiveRefiner::is_flipped(std::uint32_t place) const {
    const std::uint32_t face = faces_.label(place);
    return face != none && is_against(position_at(3 * place), position_at(3 * place + 1), position_at(3 * place + 2),
                               mesh_->face_normal(face));
}

std::size_t SelectiveRefiner::flipped_faces() const {
    std::size_t turned = 0;
    for (std::uint32_t place = 0; place < faces_.face_slot_count(); ++place) {
        turned += static_cast<std::size_t>(is_flipped(place));
    }
    return turned;
}

/// The inner node with the largest error at the corners of a face, preferably one that is not protected; `none` when
/// all corners are original vertices.
std::uint32_t SelectiveRefiner::coarsest_corner(
    std::uint32_t place, const std::function<bool(std::uint32_t)>& is_protected) const {
    // The coarsest of all corners, and of those that are not protected.
    std::array<std::uint32_t, 2> coarsest{none, none};
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t node = node_at(faces_.vertex(3 * place + k));
        if (mesh_->is_leaf(node)) { continue; }
        const bool spared = is_protected && is_protected(node);
        for (std::size_t i = 0; i < (spared ? 1U : 2U); ++i) {
            if (coarsest[i] == none || mesh_->error_m(node) > mesh_->error_m(coarsest[i])) { coarsest[i] = node; }
        }
    }
    return coarsest[1] != none ? coarsest[1] : coarsest[0];
}

/// Remembers that the faces at a slot changed, for repair().
void SelectiveRefiner::mark_changed(std::uint32_t slot) {
    if (options_.repair && (faces_.marks(slot) & changed) == 0) {
        mark(slot, changed);
        changed_.push_back(slot);
    }
}

std::size_t SelectiveRefiner::repair(const std::function<bool(std::uint32_t)>& is_protected) {
    const std::size_t before = counts_.splits;
    const std::size_t by_rule = counts_.forced_by_rule;
    while (!changed_.empty()) {
        const std::uint32_t slot = changed_.back();
        changed_.pop_back();
        unmark(slot, changed);
        repair_around(slot, is_protected);
    }
    const std::size_t done = counts_.splits - before;
    counts_.forced_by_rule = by_rule;
    counts_.forced_by_repair += done;
    return done;
}

/// Splits the coarsest corner of one turned face at a slot, if there is one; the slot is then checked again.
void SelectiveRefiner::repair_around(std::uint32_t slot, const std::function<bool(std::uint32_t)>& is_protected) {
    if (node_at(slot) == none) { return; }
    std::uint32_t turned = none;
    faces_.for_each_corner(
        slot, [&](std::uint32_t corner) { turned = turned == none && is_flipped(corner / 3) ? corner / 3 : turned; });
    if (turned == none) { return; }
    const std::uint32_t coarsest = coarsest_corner(turned, is_protected);
    if (coarsest == none) {
        return; // An original face that turned by rounding only; nothing is left to split.
    }
    mark_changed(slot); // The slot is checked again after the split.
    split(coarsest);
}

void SelectiveRefiner::find_forced_splits(std::uint32_t active_node, std::vector<std::uint32_t>& forced) const {
    // In hierarchies that a simplification made, a few nodes are the rule.
    constexpr std::size_t max_splits = 200;
    forced.clear();
    // Each of these waits for the next one to split.
    std::vector<std::uint32_t> waiting{active_node};
    while (!waiting.empty() && forced.size() + waiting.size() <= max_splits) {
        const VertexSplit wanted = mesh_->split_of(waiting.back());
        const bool is_inside = wanted.left_cut != none && wanted.right_cut != none;
        const std::uint32_t left = is_inside ? ancestor_after(wanted.left_cut, forced) : none;
        if (is_inside && left == ancestor_after(wanted.right_cut, forced)) {
            waiting.push_back(left);
            continue;
        }
        forced.push_back(waiting.back());
        waiting.pop_back();
    }
    if (waiting.empty()) {
        forced.pop_back(); // The last one is the active node itself.
    }
}

/// The active ancestor of a leaf as it will be once the nodes in `split` have been split.
std::uint32_t SelectiveRefiner::ancestor_after(std::uint32_t leaf, std::span<const std::uint32_t> split) const {
    std::uint32_t node = active_ancestor(leaf);
    while (std::ranges::find(split, node) != split.end()) {
        const VertexSplit done = mesh_->split_of(node);
        node = leaf < done.middle ? done.first : done.second;
    }
    return node;
}

} // namespace octant::visuals::refine
