// Triangles that agree make pieces; pieces whose joints disagree are put together, the one turned against the other. A
// patch that lies the wrong way round meets its surface along a good part of its rim. Bodies that only touch, as a door
// does at its hinge, meet along few edges; each of them looks the way the file has it.

#include "models/repair/consistent_orientation.h"

#include "models/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <utility>

namespace octant::models::repair {

namespace {

/// Pieces of triangles, put together one by one; each is turned or not against the one that names its group (union-find
/// with parities).
class TurnedPieces {
public:
    struct Place {
        std::uint32_t group = 0;
        std::uint8_t turned = 0;
    };

    explicit TurnedPieces(std::vector<std::size_t> sizes) : sizes_(std::move(sizes)), parents_(sizes_.size()) {
        for (std::uint32_t piece = 0; piece < parents_.size(); ++piece) { parents_[piece].group = piece; }
    }

    Place place_of(std::uint32_t piece) {
        std::uint8_t turned = 0;
        while (parents_[piece].group != piece) {
            Place& parent = parents_[piece];
            const Place next = parents_[parent.group];
            parent = {next.group, static_cast<std::uint8_t>(parent.turned ^ next.turned)};
            turned ^= parent.turned;
            piece = parent.group;
        }
        return {piece, turned};
    }

    /// Triangles of the group that `group` names.
    std::size_t size_of(std::uint32_t group) const { return sizes_[group]; }

    /// Two groups, by their names; the second one turned against the first or not.
    void join(std::uint32_t first, std::uint32_t second, std::uint8_t turned) {
        const auto [least, most] = std::minmax(first, second);
        parents_[most] = {least, turned};
        sizes_[least] += sizes_[most];
    }

private:
    std::vector<std::size_t> sizes_;
    std::vector<Place> parents_;
};

/// An edge between two triangles.
struct Joint {
    std::uint32_t one = 0;
    std::uint32_t other = 0;
    bool agree = true;
};

/// Whether so many edges make one surface of two pieces, by the size of the smaller: a patch of n triangles has a rim
/// of about the root of n at the least.
bool is_one_surface(std::size_t edges, std::size_t triangles) {
    constexpr std::size_t min_share = 2; // half of that root
    return min_share * edges * min_share * edges >= triangles;
}

class Turning {
public:
    Turning(std::size_t triangles, std::span<const TriangleEdge> sides, std::span<const Triangle> named)
        : piece_of_(triangles, invalid_index) {
        turns_.turned.assign(triangles, 0);
        for_each_joint(sides, named, [&](std::span<const TriangleEdge> edge) {
            turns_.non_manifold_edges += static_cast<std::size_t>(edge.size() > 2);
            if (edge.size() == 2) {
                joints_.push_back({edge[0].triangle, edge[1].triangle, edge[0].rises != edge[1].rises});
            }
        });
    }

    ConsistentOrientation turns() {
        TurnedPieces pieces(agreeing_pieces());
        while (put_together(pieces)) {}
        turn_fewer(pieces);
        return std::move(turns_);
    }

private:
    /// Numbers the pieces in the order of their first triangles; their sizes.
    std::vector<std::size_t> agreeing_pieces() {
        DisjointSets groups(piece_of_.size());
        for (const Joint& joint : joints_) {
            if (joint.agree) { groups.join(joint.one, joint.other); }
        }
        std::vector<std::size_t> sizes;
        for (std::uint32_t t = 0; t < piece_of_.size(); ++t) {
            const std::uint32_t first = groups.group_of(t); // not behind t
            if (first == t) { sizes.push_back(0); }
            piece_of_[t] = first == t ? static_cast<std::uint32_t>(sizes.size() - 1) : piece_of_[first];
            ++sizes[piece_of_[t]];
        }
        std::erase_if(joints_, [](const Joint& joint) { return joint.agree; });
        return sizes;
    }

    /// Joins groups that have enough edges in common; false if there are none any more.
    bool put_together(TurnedPieces& pieces) {
        std::vector<std::array<std::uint32_t, 3>> links; // two groups; turned against each other
        for (const Joint& joint : joints_) {
            const auto one = pieces.place_of(piece_of_[joint.one]);
            const auto other = pieces.place_of(piece_of_[joint.other]);
            if (one.group != other.group) {
                const auto [least, most] = std::minmax(one.group, other.group);
                const std::uint32_t turned = 1U ^ one.turned ^ other.turned;
                links.push_back({least, most, turned});
            }
        }
        std::ranges::sort(links);
        bool any = false;
        for (std::size_t first = 0, last = 0; first < links.size(); first = last) {
            last = first;
            while (last < links.size() && links[last] == links[first]) { ++last; }
            const auto [least, most, turned] = links[first];
            const auto one = pieces.place_of(least);
            const auto other = pieces.place_of(most);
            const std::size_t smaller = std::min(pieces.size_of(one.group), pieces.size_of(other.group));
            if (one.group != other.group && is_one_surface(last - first, smaller)) {
                pieces.join(one.group, other.group, static_cast<std::uint8_t>(turned ^ one.turned ^ other.turned));
                any = true;
            }
        }
        return any;
    }

    void turn_fewer(TurnedPieces& pieces) {
        std::vector<std::size_t> to_turn(piece_of_.size(), 0); // by the names of groups
        for (const std::uint32_t piece : piece_of_) {
            const auto place = pieces.place_of(piece);
            to_turn[place.group] += place.turned;
        }
        for (std::size_t t = 0; t < piece_of_.size(); ++t) {
            const auto place = pieces.place_of(piece_of_[t]);
            const bool others = 2 * to_turn[place.group] > pieces.size_of(place.group);
            turns_.turned[t] = static_cast<std::uint8_t>((place.turned != 0) != others);
            turns_.count += turns_.turned[t];
        }
    }

    ConsistentOrientation turns_;
    std::vector<Joint> joints_; ///< once pieces are found, those that disagree
    std::vector<std::uint32_t> piece_of_;
};

} // namespace

ConsistentOrientation consistent_orientation(
    std::span<const Triangle> triangles, std::span<const TriangleEdge> sides, std::span<const Triangle> named) {
    return Turning(triangles.size(), sides, named).turns();
}

} // namespace octant::models::repair
