// What hides what for eyes anywhere, and which pieces have an order that is right for all of them.
#include "visuals/bsp/occlusion_components.h"

#include "models/polygons/separating_edge.h"
#include "visuals/bsp/bit_matrix.h"
#include "visuals/bsp/piece_table.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <utility>

namespace octant::visuals::bsp {

namespace {

/// Whether a line along an edge of `a` parts it from `b`; both lie in the plane of `a`.
bool has_separating_edge(const PolygonPieces& pieces, const PolygonPiece& a, const PolygonPiece& b) {
    const auto place = [&](std::uint32_t corner) -> const glm::dvec3& { return pieces.at(corner); };
    return models::polygons::has_separating_edge(a.corners, a.plane->normal, b.corners, tolerance, place);
}

/// Whether the first one is a decal on the second one.
bool is_decal_on(const PolygonPieces& pieces, std::uint32_t upper, std::uint32_t lower) {
    const PolygonPiece& a = pieces[upper];
    const PolygonPiece& b = pieces[lower];
    return a.source > b.source && glm::dot(a.plane->normal, b.plane->normal) > 0.0 &&
           !has_separating_edge(pieces, a, b) && !has_separating_edge(pieces, b, a);
}

/// Finds what hides what in a set: row a of the result holds what hides part of a (occludes()).
class OccluderRow {
public:
    OccluderRow(const PolygonPieces& pieces, std::span<const std::uint32_t> items)
        : pieces_(pieces)
        , items_(items)
        , hides_(items.size())
        , reaches_behind_(items.size())
        , still_(hides_.words(), 0) {
        for (std::size_t i = 0; i < items.size(); ++i) {
            const PolygonPiece& piece = pieces[items[i]];
            still_[i / 64] |= std::uint64_t{piece.plane && !piece.pivot} << (i % 64);
        }
    }

    BitMatrix matrix() {
        const PieceTable table(pieces_, items_);
        for (std::size_t a = 0; a < items_.size(); ++a) {
            if (is_still(a)) {
                look_from(table, a);
            }
        }
        reaches_behind_.transpose(); // now row a holds behind whose planes a reaches
        for (std::size_t a = 0; a < items_.size(); ++a) {
            for (std::size_t i = 0; i < hides_.words() && is_still(a); ++i) {
                hides_.word(a, i) &= reaches_behind_.word(a, i) & still_[i];
            }
            add_others(a);
            hides_.remove(a, a);
        }
        for (const auto& [upper, lower] : decals_) {
            hides_.add(lower, upper);
        }
        return std::move(hides_);
    }

private:
    /// Whether a piece has a plane that stands still.
    bool is_still(std::size_t i) const { return ((still_[i / 64] >> (i % 64)) & 1U) != 0; }

    /// Looks at the pairs of which one has no plane that stands still.
    void add_others(std::size_t a) {
        for (std::size_t i = 0; i < still_.size(); ++i) {
            const std::size_t end = std::min((i + 1) * 64, items_.size());
            const bool all_still = std::popcount(still_[i]) == static_cast<int>(end - i * 64);
            for (std::size_t b = i * 64; b < end && !(is_still(a) && all_still); ++b) {
                if (!(is_still(a) && is_still(b)) && occludes(pieces_, items_[b], items_[a])) {
                    hides_.add(a, b);
                }
            }
        }
    }

    /// Finds out where the others reach to the plane of a piece.
    void look_from(const PieceTable& table, std::size_t a) {
        for (std::size_t i = 0; i < table.blocks(); ++i) {
            const PlaneSideBits sides_reached = table.sides_reached(i, *pieces_[items_[a]].plane);
            hides_.word(a, i) = sides_reached.before;
            reaches_behind_.word(a, i) = sides_reached.behind;
            for (std::uint64_t left = still_[i] & ~(sides_reached.before | sides_reached.behind); left != 0;
                 left &= left - 1) {
                const std::size_t b = i * 64 + static_cast<std::size_t>(std::countr_zero(left));
                if (b != a && is_decal_on(pieces_, items_[b], items_[a])) {
                    decals_.emplace_back(b, a);
                }
            }
        }
    }

    const PolygonPieces& pieces_;
    std::span<const std::uint32_t> items_;
    BitMatrix hides_;          ///< At first what reaches before the plane of the row's piece.
    BitMatrix reaches_behind_; ///< What reaches behind it.
    std::vector<std::uint64_t> still_;
    std::vector<std::pair<std::size_t, std::size_t>> decals_; ///< In one plane: upper, lower.
};

/// Tarjan's search over a matrix of bits.
class Search {
public:
    Search(const PolygonPieces& pieces, std::span<const std::uint32_t> items)
        : items_(items)
        , hiding_(OccluderRow(pieces, items).matrix())
        , number_(items.size(), 0)
        , lowlink_(items.size(), 0)
        , closed_(items.size(), false) {}

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
        number_[item] = lowlink_[item] = ++next_number_;
        open_.push_back(item);
        visits_.push_back({item, 0, hiding_.word(item, 0)});
    }

    void search_from(std::size_t root) {
        enter(root);
        while (!visits_.empty()) {
            Visit& visit = visits_.back();
            while (visit.left == 0 && ++visit.word < hiding_.words()) {
                visit.left = hiding_.word(visit.item, visit.word);
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
                lowlink_[visit.item] = std::min(lowlink_[visit.item], number_[next]);
            }
        }
    }

    void leave() {
        const std::size_t item = visits_.back().item;
        visits_.pop_back();
        if (!visits_.empty()) {
            const std::size_t parent = visits_.back().item;
            lowlink_[parent] = std::min(lowlink_[parent], lowlink_[item]);
        }
        if (lowlink_[item] != number_[item]) {
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
    BitMatrix hiding_;
    std::vector<std::uint32_t> number_;
    std::vector<std::uint32_t> lowlink_;
    std::vector<bool> closed_;
    std::vector<std::size_t> open_;
    std::vector<Visit> visits_;
    std::uint32_t next_number_ = 0;
    std::vector<std::vector<std::uint32_t>> found_;
};

} // namespace

bool occludes(const PolygonPieces& pieces, std::uint32_t occluder, std::uint32_t far_one) {
    const PolygonPiece& b = pieces[occluder];
    const PolygonPiece& a = pieces[far_one];
    if (a.pivot && a.pivot == b.pivot) {
        return pieces.is_rigid(occluder, far_one);
    }
    if (!a.plane && !b.plane) {
        return true;
    }
    const PlaneSideFlags of_b = a.plane ? pieces.sides_reached(occluder, *a.plane) : PlaneSideFlags{true, true};
    if (a.plane && b.plane && !of_b.before && !of_b.behind) {
        return is_decal_on(pieces, occluder, far_one);
    }
    return of_b.before && (!b.plane || pieces.sides_reached(far_one, *b.plane).behind);
}

std::vector<std::vector<std::uint32_t>>
occlusion_components(const PolygonPieces& pieces, std::span<const std::uint32_t> items) {
    return Search(pieces, items).components();
}

} // namespace octant::visuals::bsp
