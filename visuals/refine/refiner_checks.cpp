// The parts of SelectiveRefiner that look before an operation and mend behind it: link condition
// (T. Dey et al., "Topology Preserving Edge Contraction", 1999) and faces that turn over.
#include "visuals/refine/selective_refiner.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>

namespace octant::visuals::refine {

namespace {

constexpr std::uint8_t once = 1;  // seen in one face of the first vertex
constexpr std::uint8_t twice = 2; // in two
constexpr std::uint8_t seen = 4;  // met at the second vertex
constexpr std::uint8_t changed = 8;
constexpr std::uint8_t link_bits = once | twice | seen;

/// Whether a triangle's normal is more than 90 degrees off another one.
bool is_against(
    const glm::vec3& a_m, const glm::vec3& b_m, const glm::vec3& c_m, const glm::vec3& normal) {
    const glm::dvec3 a(a_m);
    return glm::dot(glm::cross(glm::dvec3(b_m) - a, glm::dvec3(c_m) - a), glm::dvec3(normal)) < 0.0;
}

} // namespace

/// Whether the collapse of the edge between two vertices leaves a manifold of the same topology:
/// both have no common neighbours but those of the one or two faces between them, only one of them
/// is on a boundary unless the edge is, and what they belong to is more than a lone tetrahedron or
/// triangle.
bool SelectiveRefiner::links_allow(std::uint32_t first_slot, std::uint32_t second_slot) {
    std::size_t first_faces = 0;
    int first_open = 0; // neighbours along boundary edges
    faces_.each_corner(first_slot, [&](std::uint32_t corner) {
        ++first_faces;
        for (const std::uint32_t at :
             {FaceLists::next_in_face(corner), FaceLists::before_in_face(corner)}) {
            std::uint8_t& mark = marks_[faces_.vertex(at)];
            first_open += (mark & once) == 0 ? 1 : -1;
            mark |= (mark & once) == 0 ? once : twice;
        }
    });
    std::size_t second_faces = 0;
    std::size_t second_neighbours = 0;
    std::size_t common = 0;
    std::size_t between = 0;
    faces_.each_corner(second_slot, [&](std::uint32_t corner) {
        ++second_faces;
        for (const std::uint32_t at :
             {FaceLists::next_in_face(corner), FaceLists::before_in_face(corner)}) {
            const std::uint32_t other = faces_.vertex(at);
            std::uint8_t& mark = marks_[other];
            between += static_cast<std::size_t>(other == first_slot);
            if ((mark & seen) == 0) {
                mark |= seen;
                ++second_neighbours;
                common += static_cast<std::size_t>((mark & once) != 0);
            }
        }
    });
    clear_link_marks(first_slot);
    clear_link_marks(second_slot);
    const bool both_open = first_open > 0 && second_neighbours > second_faces;
    const bool alone = between == 2 ? first_open == 0 && first_faces == 3 && second_faces == 3 &&
                                          second_neighbours == 3
                                    : first_faces == 1 && second_faces == 1;
    return common == between && !(both_open && between == 2) && !alone;
}

void SelectiveRefiner::clear_link_marks(std::uint32_t slot) {
    constexpr auto kept = static_cast<std::uint8_t>(~link_bits);
    faces_.each_corner(slot, [&](std::uint32_t corner) {
        marks_[faces_.vertex(FaceLists::next_in_face(corner))] &= kept;
        marks_[faces_.vertex(FaceLists::before_in_face(corner))] &= kept;
    });
}

/// Whether a face at a slot, but not at `other`, is turned over when the slot's vertex lies where
/// `node` does.
bool SelectiveRefiner::turns_faces(
    std::uint32_t slot, std::uint32_t other, std::uint32_t node) const {
    bool turns = false;
    faces_.each_corner(slot, [&](std::uint32_t corner) {
        const std::uint32_t b = faces_.vertex(FaceLists::next_in_face(corner));
        const std::uint32_t c = faces_.vertex(FaceLists::before_in_face(corner));
        turns = turns || (b != other && c != other &&
                          is_against(
                              mesh_->position_m(node),
                              mesh_->position_m(nodes_[b]),
                              mesh_->position_m(nodes_[c]),
                              mesh_->face_normal(faces_.label(corner / 3))));
    });
    return turns;
}

bool SelectiveRefiner::is_turned(std::uint32_t place) const {
    const std::uint32_t face = faces_.label(place);
    return face != none && is_against(
                               mesh_->position_m(nodes_[faces_.vertex(3 * place)]),
                               mesh_->position_m(nodes_[faces_.vertex(3 * place + 1)]),
                               mesh_->position_m(nodes_[faces_.vertex(3 * place + 2)]),
                               mesh_->face_normal(face));
}

std::size_t SelectiveRefiner::turned_faces() const {
    std::size_t turned = 0;
    for (std::uint32_t place = 0; place < faces_.place_count(); ++place) {
        turned += static_cast<std::size_t>(is_turned(place));
    }
    return turned;
}

/// Of a face that is not an original one as it was.
std::uint32_t SelectiveRefiner::coarsest_corner(std::uint32_t place) const {
    std::uint32_t coarsest = none;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t node = nodes_[faces_.vertex(3 * place + k)];
        if (!mesh_->is_leaf(node) &&
            (coarsest == none || mesh_->error_m(node) > mesh_->error_m(coarsest))) {
            coarsest = node;
        }
    }
    return coarsest;
}

void SelectiveRefiner::note_change(std::uint32_t slot) {
    if (options_.repair && (marks_[slot] & changed) == 0) {
        marks_[slot] |= changed;
        changed_.push_back(slot);
    }
}

std::size_t SelectiveRefiner::repair() {
    const std::size_t before = counts_.splits;
    const std::size_t by_rule = counts_.forced_by_rule;
    while (!changed_.empty()) {
        const std::uint32_t slot = changed_.back();
        changed_.pop_back();
        marks_[slot] &= static_cast<std::uint8_t>(~changed);
        repair_around(slot);
    }
    const std::size_t done = counts_.splits - before;
    counts_.forced_by_rule = by_rule;
    counts_.forced_by_repair += done;
    return done;
}

void SelectiveRefiner::repair_around(std::uint32_t slot) {
    if (nodes_[slot] == none) {
        return;
    }
    std::uint32_t turned = none;
    faces_.each_corner(slot, [&](std::uint32_t corner) {
        turned = turned == none && is_turned(corner / 3) ? corner / 3 : turned;
    });
    if (turned == none) {
        return;
    }
    const std::uint32_t coarsest = coarsest_corner(turned);
    if (coarsest == none) {
        return; // an original face that rounding turned
    }
    note_change(slot); // looked at again behind the split
    split(coarsest);
}

} // namespace octant::visuals::refine
