// The parts of SelectiveRefiner that check before an operation and mend after it.
//
// - Link condition (T. Dey, H. Edelsbrunner, S. Guha, D. Nekhayev, "Topology Preserving Edge
//   Contraction", 1999): an edge may collapse when the common neighbours of its ends are just the
//   third corners of its faces. Kim and Lee (2001) do not test it, because their collapses undo
//   splits; in a state that no simplification went through, a collapse can pinch the surface.
// - Fold-overs: where fine meets coarse, a face may turn over against its original. repair() splits
//   its coarsest corner until none is left, and a collapse that would turn a face is refused.
#include "visuals/refine/selective_refiner.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>

namespace octant::visuals::refine {

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

/// The inner node with the largest error at the corners of a face, one that is_protected(node) does not want spared if
/// there is any; `none` when all corners are original vertices.
std::uint32_t SelectiveRefiner::coarsest_corner(
    std::uint32_t place, const std::function<bool(std::uint32_t)>& is_protected) const {
    // the coarsest of all corners, and of those that are not spared
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

/// Splits the coarsest corner of one turned face at a slot, if there is one, and has the slot looked at again after
/// that.
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
    mark_changed(slot); // looked at again behind the split
    split(coarsest);
}

void SelectiveRefiner::find_forced_splits(std::uint32_t active_node, std::vector<std::uint32_t>& forced) const {
    // In hierarchies that a simplification made, a few nodes are the rule.
    constexpr std::size_t most = 200;
    forced.clear();
    // Each of these waits for the next one to split.
    std::vector<std::uint32_t> waiting{active_node};
    while (!waiting.empty() && forced.size() + waiting.size() <= most) {
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
