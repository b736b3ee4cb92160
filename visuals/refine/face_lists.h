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
///
/// 24 bytes a face, half of them the index list, and 8 a vertex: corners and the labels of faces
/// have 24 bits.
class FaceLists {
public:
    static constexpr std::uint32_t none = models::none;

    /// There will be no more than so many at a time. Corners and labels of faces are below 2^24
    /// - 1.
    FaceLists(std::size_t vertices_at_most, std::size_t faces_at_most);

    /// No vertices, no faces; the memory is kept.
    void clear();

    /// A vertex without faces, with `none` for a label. Returns its number: that of the one taken
    /// away last, whose marks it keeps, else one more.
    std::uint32_t add_vertex();

    /// Takes one without faces away.
    void remove_vertex(std::uint32_t vertex);

    /// Those taken away included.
    std::size_t vertex_count() const { return vertices_.size(); }

    /// Of the caller's, kept with the vertex.
    std::uint32_t vertex_label(std::uint32_t vertex) const { return vertices_[vertex].label; }

    void set_vertex_label(std::uint32_t vertex, std::uint32_t label) {
        vertices_[vertex].label = label;
    }

    /// Eight bits of the caller's.
    std::uint32_t marks(std::uint32_t vertex) const { return vertices_[vertex].marks; }

    void set_marks(std::uint32_t vertex, std::uint32_t marks) {
        vertices_[vertex].marks = marks & 0xffU;
    }

    /// `label`: of the caller's, kept with the face. Returns its number.
    std::uint32_t add(const std::array<std::uint32_t, 3>& vertices, std::uint32_t label);

    void remove(std::uint32_t face);

    /// Calls use(corner) for each corner at a vertex.
    template <class Use>
    void each_corner(std::uint32_t vertex, const Use& use) const {
        for (std::uint32_t c = vertices_[vertex].first; c != no_corner; c = links_[c].next) {
            use(c);
        }
    }

    /// Moves those corners of a vertex to another one for which moves(corner) is true. That one's
    /// own corners follow behind. Without branches on what moves: it is as good as chance.
    template <class Moves>
    void move_corners(std::uint32_t from, std::uint32_t to, const Moves& moves) {
        std::array<std::uint32_t, 2> heads{no_corner, vertices_[to].first};
        const std::array<std::uint32_t, 2> vertices{from, to};
        std::uint32_t corner = vertices_[from].first;
        while (corner != no_corner) {
            const std::uint32_t following = links_[corner].next;
            const auto side = static_cast<std::size_t>(moves(corner));
            links_[corner].next = heads[side] & no_corner;
            heads[side] = corner;
            indices_[corner] = vertices[side];
            corner = following;
        }
        vertices_[from].first = heads[0] & no_corner;
        vertices_[to].first = heads[1] & no_corner;
    }

    /// The face with a label at a vertex; none when there is none.
    std::uint32_t find(std::uint32_t vertex, std::uint32_t label) const;

    std::uint32_t vertex(std::uint32_t corner) const { return indices_[corner]; }

    /// The other two corners of a corner's face, counter-clockwise.
    static std::uint32_t next_in_face(std::uint32_t corner) {
        return corner % 3 == 2 ? corner - 2 : corner + 1;
    }

    static std::uint32_t before_in_face(std::uint32_t corner) {
        return corner % 3 == 0 ? corner + 2 : corner - 1;
    }

    /// none for a place without a face.
    std::uint32_t label(std::uint32_t face) const {
        const Link* links = &links_[3 * std::size_t{face}];
        const std::uint32_t label =
            links[0].label_part | links[1].label_part << 8U | links[2].label_part << 16U;
        return label == no_corner ? none : label;
    }

    /// Places of faces, those without one included.
    std::size_t place_count() const { return links_.size() / 3; }

    std::size_t face_count() const { return face_count_; }

    /// Three a place.
    std::span<const std::uint32_t> indices() const { return indices_; }

    std::size_t bytes() const;

private:
    static constexpr std::uint32_t no_corner = 0xffffffU;

    struct Vertex {
        std::uint32_t first : 24 = no_corner; ///< of its corners
        std::uint32_t marks : 8 = 0;
        std::uint32_t label = none;
    };

    /// Of a corner. The three of a face hold its label together.
    struct Link {
        std::uint32_t next : 24; ///< corner at the same vertex
        std::uint32_t label_part : 8;
    };

    void set_label(std::uint32_t face, std::uint32_t label);
    void unlink(std::uint32_t corner);

    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> indices_;      ///< vertices, one a corner
    std::vector<Link> links_;                 ///< one a corner
    std::uint32_t free_ = no_corner;          ///< list of places, through their first corners
    std::uint32_t free_vertices_ = no_corner; ///< list of them, through Vertex::first
    std::size_t face_count_ = 0;
    std::size_t vertices_at_most_;
    std::size_t faces_at_most_;
};

} // namespace octant::visuals::refine
