#pragma once

#include "models/collapse_sequence.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::refine {

/// Reserves capacity for `count` items. The vector grows by a quarter at a time instead of doubling, and never beyond
/// `max` items, to keep memory small.
template <class Item>
void reserve_up_to(std::vector<Item>& items, std::size_t count, std::size_t max) {
    if (count > items.capacity()) { items.reserve(std::max(count, std::min(count + count / 4, max))); }
}

/// Triangles between numbered vertices, with a linked list of the corners at each vertex. The links are stored with the
/// corners, so that adding and removing allocates only when there are more than ever before. Corner 3 f + k is the k-th
/// corner of face f. A removed face leaves a degenerate one behind (all corners at vertex 0), which draws nothing,
/// until its place is used again.
///
/// Memory: 24 bytes a face, half of them the index list that the renderer uses, and 8 bytes a vertex. For that, corner
/// numbers and face labels have 24 bits.
class FaceLists {
public:
    static constexpr std::uint32_t none = models::none;

    /// `vertex_capacity` and `face_capacity` limit how many there may be at a time. Corner numbers and face labels must
    /// stay below 2^24 - 1 (asserted).
    FaceLists(std::size_t vertex_capacity, std::size_t face_capacity);

    /// Removes all vertices and faces but keeps the memory.
    void clear();

    /// Adds a vertex without faces whose label is `none`, and returns its number. The number of the vertex that was
    /// removed last is used again (and keeps its marks); otherwise it is the next one.
    std::uint32_t add_vertex();

    /// Removes a vertex that has no faces (asserted).
    void remove_vertex(std::uint32_t vertex);

    /// How many vertex numbers are in use, those of removed vertices included.
    std::size_t vertex_count() const { return vertices_.size(); }

    /// A number that the caller keeps with a vertex.
    std::uint32_t vertex_label(std::uint32_t vertex) const { return vertices_[vertex].label; }

    void set_vertex_label(std::uint32_t vertex, std::uint32_t label) { vertices_[vertex].label = label; }

    /// Eight bits that the caller keeps with a vertex.
    std::uint32_t marks(std::uint32_t vertex) const { return vertices_[vertex].marks; }

    void set_marks(std::uint32_t vertex, std::uint32_t marks) { vertices_[vertex].marks = marks & 0xffU; }

    /// Adds a face and returns its number. `label` is a number that the caller keeps with the face.
    std::uint32_t add(const std::array<std::uint32_t, 3>& vertices, std::uint32_t label);

    void remove(std::uint32_t face);

    /// Calls use(corner) for each corner at a vertex.
    template <class Use>
    void for_each_corner(std::uint32_t vertex, const Use& use) const {
        for (std::uint32_t c = vertices_[vertex].first; c != no_corner; c = links_[c].next) { use(c); }
    }

    /// Moves those corners of vertex `from` for which moves(corner) is true to vertex `to`, in front of that vertex's
    /// own corners. The loop has no branch on what moves, because the outcome is as good as random and would be
    /// mispredicted half of the time.
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

    /// The number of the face with a given label at a vertex; `none` when there is none.
    std::uint32_t find(std::uint32_t vertex, std::uint32_t label) const;

    std::uint32_t vertex(std::uint32_t corner) const { return indices_[corner]; }

    /// The next corner of the same face, counter-clockwise.
    static std::uint32_t next_in_face(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

    /// The previous corner of the same face, counter-clockwise.
    static std::uint32_t previous_in_face(std::uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

    /// The label of a face; `none` for a place without a face.
    std::uint32_t label(std::uint32_t face) const {
        const Link* links = &links_[3 * std::size_t{face}];
        const std::uint32_t label = std::uint32_t{links[0].label_part} | std::uint32_t{links[1].label_part} << 8U |
                                    std::uint32_t{links[2].label_part} << 16U;
        return label == no_corner ? none : label;
    }

    /// How many face numbers are in use, those of removed faces included.
    std::size_t face_slot_count() const { return links_.size() / 3; }

    std::size_t face_count() const { return face_count_; }

    /// The index list: three vertices for each place.
    std::span<const std::uint32_t> indices() const { return indices_; }

    std::size_t bytes() const;

private:
    static constexpr std::uint32_t no_corner = 0xffffffU;

    struct Vertex {
        std::uint32_t first : 24 = no_corner; ///< The head of the list of corners at this vertex.
        std::uint32_t marks : 8 = 0;
        std::uint32_t label = none;
    };

    /// What is kept with a corner. The three corners of a face hold its 24-bit label together, 8 bits each.
    struct Link {
        std::uint32_t next : 24; ///< The next corner at the same vertex.
        std::uint32_t label_part : 8;
    };

    void set_label(std::uint32_t face, std::uint32_t label);
    void unlink(std::uint32_t corner);

    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> indices_; ///< For each corner its vertex.
    std::vector<Link> links_;            ///< One for each corner.
    /// The head of the list of free places, linked through their first corners.
    std::uint32_t free_ = no_corner;
    /// The head of the list of free vertices, linked through Vertex::first.
    std::uint32_t free_vertices_ = no_corner;
    std::size_t face_count_ = 0;
    std::size_t vertices_at_max_;
    std::size_t faces_at_max_;
};

} // namespace octant::visuals::refine
