// What hides what for eyes anywhere, and which pieces have an order that is right for all of them.
#include "visuals/parting/clusters.h"

#include "models/polygons/edge_parts.h"
#include "visuals/parting/piece_table.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace octant::visuals::parting {

namespace {

/// Whether a line along an edge of `a` parts it from `b`; both lie in the plane of `a`.
bool edge_parts(const Pieces& pieces, const Piece& a, const Piece& b) {
    const auto place = [&](std::uint32_t corner) -> const glm::dvec3& { return pieces.at(corner); };
    return models::polygons::edge_parts(a.corners, a.plane->normal, b.corners, tolerance, place);
}

/// Whether the first one is a decal on the second one.
bool is_decal_on(const Pieces& pieces, std::uint32_t upper, std::uint32_t lower) {
    const Piece& a = pieces[upper];
    const Piece& b = pieces[lower];
    return a.source > b.source && glm::dot(a.plane->normal, b.plane->normal) > 0.0 &&
           !edge_parts(pieces, a, b) && !edge_parts(pieces, b, a);
}

/// Where the pieces of a set reach to one another's planes, each pair looked at once.
class Reaches {
public:
    Reaches(const Pieces& pieces, std::span<const std::uint32_t> items)
        : pieces_(pieces)
        , items_(items)
        , still_(items.size())
        , reach_(items.size() * items.size()) {
        const PieceTable table(pieces, items);
        for (std::size_t a = 0; a < items.size(); ++a) {
            const Piece& piece = pieces[items[a]];
            still_[a] = piece.plane && !piece.pivot;
            for (std::size_t b = 0; b < items.size() && still_[a]; ++b) {
                reach_[a * items.size() + b] = table.reach(b, *piece.plane);
            }
        }
    }

    /// What parting::hides() says, by places in the set.
    bool hides(std::size_t b, std::size_t a) const {
        if (!still_[a] || !still_[b]) {
            return parting::hides(pieces_, items_[b], items_[a]);
        }
        const Reach& of_b = reach_[a * items_.size() + b];
        if (!of_b.before && !of_b.behind) {
            return is_decal_on(pieces_, items_[b], items_[a]);
        }
        return of_b.before && reach_[b * items_.size() + a].behind;
    }

private:
    const Pieces& pieces_;
    std::span<const std::uint32_t> items_;
    std::vector<bool> still_;  ///< Has a plane that stands still.
    std::vector<Reach> reach_; ///< Of each to the plane of each: row after row, a plane a row.
};

/// Tarjan's search over a matrix of bits.
class Search {
public:
    Search(const Pieces& pieces, std::span<const std::uint32_t> items)
        : items_(items)
        , words_((items.size() + 63) / 64)
        , bits_(items.size() * words_, 0)
        , number_(items.size(), 0)
        , low_(items.size(), 0)
        , closed_(items.size(), false) {
        const Reaches reaches(pieces, items);
        for (std::size_t a = 0; a < items.size(); ++a) {
            for (std::size_t b = 0; b < items.size(); ++b) {
                if (a != b && reaches.hides(b, a)) {
                    bits_[a * words_ + b / 64] |= std::uint64_t{1} << (b % 64);
                }
            }
        }
    }

    std::vector<std::vector<std::uint32_t>> components() {
        for (std::size_t i = items_.size(); i-- > 0;) {
            if (number_[i] == 0) {
                search_from(i);
            }
        }
        std::ranges::reverse(found_); // components are closed in the reverse of painting order
        return std::move(found_);
    }

private:
    struct Visit {
        std::size_t item = 0;
        std::size_t word = 0;
        std::uint64_t left = 0;
    };

    void enter(std::size_t item) {
        number_[item] = low_[item] = ++next_number_;
        open_.push_back(item);
        visits_.push_back({item, 0, words_ > 0 ? bits_[item * words_] : 0});
    }

    void search_from(std::size_t root) {
        enter(root);
        while (!visits_.empty()) {
            Visit& visit = visits_.back();
            while (visit.left == 0 && ++visit.word < words_) {
                visit.left = bits_[visit.item * words_ + visit.word];
            }
            if (visit.left == 0) {
                leave();
                continue;
            }
            const auto next =
                visit.word * 64 + static_cast<std::size_t>(std::countr_zero(visit.left));
            visit.left &= visit.left - 1;
            if (number_[next] == 0) {
                enter(next);
            } else if (!closed_[next]) {
                low_[visit.item] = std::min(low_[visit.item], number_[next]);
            }
        }
    }

    void leave() {
        const std::size_t item = visits_.back().item;
        visits_.pop_back();
        if (!visits_.empty()) {
            const std::size_t parent = visits_.back().item;
            low_[parent] = std::min(low_[parent], low_[item]);
        }
        if (low_[item] != number_[item]) {
            return;
        }
        std::vector<std::uint32_t>& component = found_.emplace_back();
        std::size_t member = 0;
        do {
            member = open_.back();
            open_.pop_back();
            closed_[member] = true;
            component.push_back(items_[member]);
        } while (member != item);
        std::ranges::sort(component);
    }

    std::span<const std::uint32_t> items_;
    std::size_t words_;
    std::vector<std::uint64_t> bits_; ///< Row a holds what hides part of a.
    std::vector<std::uint32_t> number_;
    std::vector<std::uint32_t> low_;
    std::vector<bool> closed_;
    std::vector<std::size_t> open_;
    std::vector<Visit> visits_;
    std::uint32_t next_number_ = 0;
    std::vector<std::vector<std::uint32_t>> found_;
};

} // namespace

bool hides(const Pieces& pieces, std::uint32_t near_one, std::uint32_t far_one) {
    const Piece& b = pieces[near_one];
    const Piece& a = pieces[far_one];
    if (a.pivot && a.pivot == b.pivot) {
        return pieces.is_rigid(near_one, far_one);
    }
    if (!a.plane && !b.plane) {
        return true;
    }
    const Reach of_b = a.plane ? pieces.reach(near_one, *a.plane) : Reach{true, true};
    if (a.plane && b.plane && !of_b.before && !of_b.behind) {
        return is_decal_on(pieces, near_one, far_one);
    }
    return of_b.before && (!b.plane || pieces.reach(far_one, *b.plane).behind);
}

std::vector<std::vector<std::uint32_t>>
clusters(const Pieces& pieces, std::span<const std::uint32_t> items) {
    return Search(pieces, items).components();
}

} // namespace octant::visuals::parting
