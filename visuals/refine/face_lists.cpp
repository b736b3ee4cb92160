// Corner lists of a mesh that changes all the time. A vertex split moves some corners of one vertex to a new one and
// adds two faces; an edge collapse does the reverse. Both touch only the corners at these vertices, and that is what
// the lists make cheap.
#include "visuals/refine/face_lists.h"

#include <cassert>

namespace octant::visuals::refine {

FaceLists::FaceLists(std::size_t vertex_capacity, std::size_t face_capacity)
    : vertices_at_max_(vertex_capacity), faces_at_max_(face_capacity) {
    assert(3 * face_capacity < no_corner);
}

void FaceLists::clear() {
    vertices_.clear();
    indices_.clear();
    links_.clear();
    free_ = no_corner;
    free_vertices_ = no_corner;
    face_count_ = 0;
}

std::uint32_t FaceLists::add_vertex() {
    if (free_vertices_ == no_corner) {
        reserve_up_to(vertices_, vertices_.size() + 1, vertices_at_max_);
        vertices_.emplace_back();
        return static_cast<std::uint32_t>(vertices_.size() - 1);
    }
    const std::uint32_t vertex = free_vertices_;
    free_vertices_ = vertices_[vertex].first;
    vertices_[vertex].first = no_corner;
    return vertex;
}

void FaceLists::remove_vertex(std::uint32_t vertex) {
    assert(vertices_[vertex].first == no_corner);
    vertices_[vertex].label = none;
    vertices_[vertex].first = free_vertices_ & no_corner;
    free_vertices_ = vertex;
}

void FaceLists::set_label(std::uint32_t face, std::uint32_t label) {
    Link* links = &links_[3 * std::size_t{face}];
    links[0].label_part = label & 0xffU;
    links[1].label_part = label >> 8U & 0xffU;
    links[2].label_part = label >> 16U & 0xffU;
}

std::uint32_t FaceLists::add(const std::array<std::uint32_t, 3>& vertices, std::uint32_t label) {
    std::uint32_t corner = free_;
    if (corner != no_corner) {
        free_ = links_[corner].next;
    } else {
        corner = static_cast<std::uint32_t>(links_.size());
        reserve_up_to(links_, links_.size() + 3, 3 * faces_at_max_);
        reserve_up_to(indices_, indices_.size() + 3, 3 * faces_at_max_);
        links_.resize(links_.size() + 3);
        indices_.resize(indices_.size() + 3);
    }
    const std::uint32_t face = corner / 3;
    set_label(face, label);
    for (const std::uint32_t vertex : vertices) {
        indices_[corner] = vertex;
        links_[corner].next = vertices_[vertex].first;
        vertices_[vertex].first = corner & no_corner;
        ++corner;
    }
    ++face_count_;
    return face;
}

void FaceLists::unlink(std::uint32_t corner) {
    Vertex& vertex = vertices_[indices_[corner]];
    if (vertex.first == corner) {
        vertex.first = links_[corner].next;
        return;
    }
    std::uint32_t before = vertex.first;
    while (links_[before].next != corner) {
        assert(links_[before].next != no_corner);
        before = links_[before].next;
    }
    links_[before].next = links_[corner].next;
}

void FaceLists::remove(std::uint32_t face) {
    assert(label(face) != none);
    for (std::uint32_t k = 0; k < 3; ++k) {
        unlink(3 * face + k);
        indices_[3 * face + k] = 0;
    }
    set_label(face, none);
    links_[3 * std::size_t{face}].next = free_ & no_corner;
    free_ = 3 * face;
    --face_count_;
}

std::uint32_t FaceLists::find(std::uint32_t vertex, std::uint32_t label) const {
    for (std::uint32_t c = vertices_[vertex].first; c != no_corner; c = links_[c].next) {
        if (this->label(c / 3) == label) { return c / 3; }
    }
    return none;
}

std::size_t FaceLists::bytes() const {
    return sizeof(Vertex) * vertices_.capacity() + sizeof(std::uint32_t) * indices_.capacity() +
           sizeof(Link) * links_.capacity();
}

} // namespace octant::visuals::refine
