#include "visuals/refine/face_lists.h"

#include <cassert>

namespace octant::visuals::refine {

void FaceLists::clear() {
    first_corners_.clear();
    vertices_.clear();
    links_.clear();
    free_ = none;
    face_count_ = 0;
}

std::uint32_t FaceLists::add(const std::array<std::uint32_t, 3>& vertices, std::uint32_t label) {
    std::uint32_t face = free_;
    if (face != none) {
        free_ = links_[face].next[0];
    } else {
        face = static_cast<std::uint32_t>(links_.size());
        make_room(links_, links_.size() + 1, most_faces_);
        make_room(vertices_, vertices_.size() + 3, 3 * most_faces_);
        links_.emplace_back();
        vertices_.resize(vertices_.size() + 3);
    }
    links_[face].label = label;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = 3 * face + k;
        vertices_[corner] = vertices[k];
        links_[face].next[k] = first_corners_[vertices[k]];
        first_corners_[vertices[k]] = corner;
    }
    ++face_count_;
    return face;
}

void FaceLists::unlink(std::uint32_t corner) {
    std::uint32_t* link = &first_corners_[vertices_[corner]];
    while (*link != corner) {
        assert(*link != none);
        link = &next(*link);
    }
    *link = next(corner);
}

void FaceLists::remove(std::uint32_t face) {
    assert(links_[face].label != none);
    for (std::uint32_t k = 0; k < 3; ++k) {
        unlink(3 * face + k);
        vertices_[3 * face + k] = 0;
    }
    links_[face].label = none;
    links_[face].next[0] = free_;
    free_ = face;
    --face_count_;
}

std::uint32_t FaceLists::find(std::uint32_t vertex, std::uint32_t label) const {
    for (std::uint32_t c = first_corners_[vertex]; c != none; c = next(c)) {
        if (links_[c / 3].label == label) {
            return c / 3;
        }
    }
    return none;
}

std::size_t FaceLists::bytes() const {
    return sizeof(std::uint32_t) * (first_corners_.capacity() + vertices_.capacity()) +
           sizeof(Links) * links_.capacity();
}

} // namespace octant::visuals::refine
