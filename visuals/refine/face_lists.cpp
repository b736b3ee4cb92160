#include "visuals/refine/face_lists.h"

#include <cassert>

namespace octant::visuals::refine {

std::uint32_t FaceLists::add(const std::array<std::uint32_t, 3>& vertices, std::uint32_t label) {
    std::uint32_t face = free_;
    if (face != none) {
        free_ = next_corners_[3 * static_cast<std::size_t>(face)];
    } else {
        face = static_cast<std::uint32_t>(labels_.size());
        labels_.push_back(none);
        vertices_.resize(vertices_.size() + 3);
        next_corners_.resize(next_corners_.size() + 3);
    }
    labels_[face] = label;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = 3 * face + k;
        vertices_[corner] = vertices[k];
        next_corners_[corner] = first_corners_[vertices[k]];
        first_corners_[vertices[k]] = corner;
    }
    ++face_count_;
    return face;
}

void FaceLists::unlink(std::uint32_t corner) {
    std::uint32_t* link = &first_corners_[vertices_[corner]];
    while (*link != corner) {
        assert(*link != none);
        link = &next_corners_[*link];
    }
    *link = next_corners_[corner];
}

void FaceLists::remove(std::uint32_t face) {
    assert(labels_[face] != none);
    for (std::uint32_t k = 0; k < 3; ++k) {
        unlink(3 * face + k);
        vertices_[3 * face + k] = 0;
    }
    labels_[face] = none;
    next_corners_[3 * static_cast<std::size_t>(face)] = free_;
    free_ = face;
    --face_count_;
}

std::uint32_t FaceLists::find(std::uint32_t vertex, std::uint32_t label) const {
    for (std::uint32_t c = first_corners_[vertex]; c != none; c = next_corners_[c]) {
        if (labels_[c / 3] == label) {
            return c / 3;
        }
    }
    return none;
}

std::size_t FaceLists::bytes() const {
    return sizeof(std::uint32_t) * (first_corners_.capacity() + vertices_.capacity() +
                                    next_corners_.capacity() + labels_.capacity());
}

} // namespace octant::visuals::refine
