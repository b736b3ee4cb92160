#pragma once

#include "models/collapse_sequence.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::refine {

/// Lets a vector grow by a quarter at a time instead of twice, to `most` items and no further.
template <class Item>
void make_room(std::vector<Item>& items, std::size_t count, std::size_t most) {
    if (count > items.capacity()) {
        items.reserve(std::max(count, std::min(count + count / 4, most)));
    }
}

/// Triangles between vertices ("slots") with a list of the corners at each vertex, linked through
/// the corners themselves: adding and taking away needs no memory once there was as much before.
/// Corner 3 f + k is the kth of face f. A face that was taken away is left as a degenerate one
/// (all corners at vertex 0) until its place is used again.
class FaceLists {
public:
    static constexpr std::uint32_t none = models::none;

    /// There will be no more than so many at a time.
    FaceLists(std::size_t most_vertices, std::size_t most_faces)
        : most_vertices_(most_vertices)
        , most_faces_(most_faces) {}

    /// No vertices, no faces; the memory is kept.
    void clear();

    /// Makes room; vertices that are new have no faces.
    void resize_vertices(std::size_t count) {
        make_room(first_corners_, count, most_vertices_);
        first_corners_.resize(count, none);
    }

    /// `label`: of the caller's, kept with the face. Returns its number.
    std::uint32_t add(const std::array<std::uint32_t, 3>& vertices, std::uint32_t label);

    void remove(std::uint32_t face);

    /// Calls use(corner) for each corner at a vertex.
    template <class Use>
    void each_corner(std::uint32_t vertex, const Use& use) const {
        for (std::uint32_t c = first_corners_[vertex]; c != none; c = next(c)) {
            use(c);
        }
    }

    /// Moves those corners of a vertex to another one for which moves(corner) is true. That one's
    /// own corners follow behind. Without branches on what moves: it is as good as chance.
    template <class Moves>
    void move_corners(std::uint32_t from, std::uint32_t to, const Moves& moves) {
        std::array<std::uint32_t, 2> heads{none, first_corners_[to]};
        const std::array<std::uint32_t, 2> vertices{from, to};
        std::uint32_t corner = first_corners_[from];
        while (corner != none) {
            std::uint32_t& link = next(corner);
            const std::uint32_t following = link;
            const auto side = static_cast<std::size_t>(moves(corner));
            link = heads[side];
            heads[side] = corner;
            vertices_[corner] = vertices[side];
            corner = following;
        }
        first_corners_[from] = heads[0];
        first_corners_[to] = heads[1];
    }

    /// Asks for memory that a walk over a vertex's corners reads first; returns the first corner.
    std::uint32_t fetch_first(std::uint32_t vertex) const {
        return vertex < first_corners_.size() ? fetch(first_corners_[vertex]) : none;
    }

    /// The same for what is read after `corner`.
    std::uint32_t fetch_next(std::uint32_t corner) const {
        return corner == none ? none : fetch(next(corner));
    }

    const std::uint32_t* first_corner_address(std::uint32_t vertex) const {
        return first_corners_.data() + vertex;
    }

    /// The face with a label at a vertex; none when there is none.
    std::uint32_t find(std::uint32_t vertex, std::uint32_t label) const;

    std::uint32_t vertex(std::uint32_t corner) const { return vertices_[corner]; }

    /// The other two corners of a corner's face, counter-clockwise.
    static std::uint32_t next_in_face(std::uint32_t corner) {
        return corner % 3 == 2 ? corner - 2 : corner + 1;
    }

    static std::uint32_t before_in_face(std::uint32_t corner) {
        return corner % 3 == 0 ? corner + 2 : corner - 1;
    }

    /// none for a place without a face.
    std::uint32_t label(std::uint32_t face) const { return links_[face].label; }

    /// Places of faces, those without one included.
    std::size_t place_count() const { return links_.size(); }

    std::size_t face_count() const { return face_count_; }

    /// Three a place.
    std::span<const std::uint32_t> indices() const { return vertices_; }

    std::size_t bytes() const;

private:
    struct Links {
        std::array<std::uint32_t, 3> next; ///< corners at the same vertices
        std::uint32_t label;
    };

    std::uint32_t fetch(std::uint32_t corner) const {
        if (corner != none) {
            __builtin_prefetch(&links_[corner / 3], 1);
            __builtin_prefetch(&vertices_[corner], 1);
        }
        return corner;
    }

    std::uint32_t& next(std::uint32_t corner) { return links_[corner / 3].next[corner % 3]; }

    std::uint32_t next(std::uint32_t corner) const { return links_[corner / 3].next[corner % 3]; }

    void unlink(std::uint32_t corner);

    std::vector<std::uint32_t> first_corners_; ///< one a vertex
    std::vector<std::uint32_t> vertices_;      ///< one a corner
    std::vector<Links> links_;                 ///< one a face
    std::uint32_t free_ = none;                ///< list of places, through their first corners
    std::size_t face_count_ = 0;
    std::size_t most_vertices_;
    std::size_t most_faces_;
};

} // namespace octant::visuals::refine
