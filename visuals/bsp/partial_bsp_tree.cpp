// Binary space partition: H. Fuchs, Z. M. Kedem, B. F. Naylor, "On Visible Surface Generation by A Priori Tree
// Structures", SIGGRAPH 1980.
//
// Deviations:
// - Only pieces that hide one another in a cycle, for eyes anywhere, are divided; a convex shell becomes one list
//   without any cut.
// - Planes need not be those of polygons.
// - Polygons that lie in a node's plane stay in the node, in file order, in one list for each facing.
#include "visuals/bsp/partial_bsp_tree.h"

#include "models/polygons/polygon_outlines.h"
#include "sim/base/bit_set.h"
#include "visuals/bsp/component_search.h"
#include "visuals/bsp/piece_batch.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::bsp {

namespace {

/// PlaneSideFlags of up to 64 pieces, a bit for each.
struct PlaneSideBits {
    std::uint64_t before = 0;
    std::uint64_t behind = 0;
};

constexpr std::size_t lanes_a_block = 64 / PieceBatch::pieces;

PieceBatch empty_lanes() {
    PieceBatch lanes;
    const auto clear = [](PieceBatch::Lane& lane) { lane.fill(std::numeric_limits<double>::quiet_NaN()); };
    const auto clear_all = [&](PieceBatch::Points& points) {
        clear(points.x);
        clear(points.y);
        clear(points.z);
    };
    clear_all(lanes.centres);
    clear(lanes.radii);
    std::ranges::for_each(lanes.first_corners, clear_all);
    return lanes;
}

void put(PieceBatch::Points& points, std::size_t place, const glm::dvec3& point) {
    points.x[place] = point.x;
    points.y[place] = point.y;
    points.z[place] = point.z;
}

/// Some pieces with their bounding spheres and corners side by side in memory, to test all of them against a plane.
class PieceTable {
public:
    static constexpr std::size_t pieces_per_block = 64;

    /// Every `step`th of `items`, from the first one.
    PieceTable(const PolygonPieces& pieces, std::span<const std::uint32_t> items, std::size_t step = 1) {
        const std::size_t count = (items.size() + step - 1) / step;
        lanes_.assign((count + PieceBatch::pieces - 1) / PieceBatch::pieces, empty_lanes());
        has_extra_corners_.assign((count + pieces_per_block - 1) / pieces_per_block, 0);
        extra_corners_.reserve(count);
        for (std::size_t i = 0; i < items.size(); i += step) { add(pieces, pieces[items[i]]); }
    }

    std::size_t count() const { return count_; }

    /// How many blocks of 64 pieces there are; the last one may have fewer.
    std::size_t blocks() const { return (count() + pieces_per_block - 1) / pieces_per_block; }

    /// How many pieces a block has.
    std::size_t count_in(std::size_t block) const {
        return std::min(count_ - block * pieces_per_block, pieces_per_block);
    }

    /// PolygonPieces::sides_reached() of the pieces of a block; the other bits are 0.
    PlaneSideBits sides_reached(std::size_t block, const Plane& plane) const {
        const auto lanes = std::span(lanes_).subspan(block * lanes_a_block);
        const PieceSideBits sides = sides_of(lanes.first(std::min(lanes.size(), lanes_a_block)), plane, tolerance);
        const std::uint64_t open = ~(sides.sphere_in_front | sides.sphere_behind);
        PlaneSideBits sides_reached{sides.sphere_in_front | (sides.corner_in_front & open),
            sides.sphere_behind | (sides.corner_behind_plane & open)};
        std::uint64_t left = open & has_extra_corners_[block] & ~(sides_reached.before & sides_reached.behind);
        for (; left != 0; left &= left - 1) {
            const auto place = static_cast<std::size_t>(std::countr_zero(left));
            const ExtraCorners& more = extra_corners_[block * pieces_per_block + place];
            for (std::size_t k = more.first; k < more.end; ++k) {
                const double height = distance_m(plane, corners_[k]);
                sides_reached.before |= std::uint64_t{height > tolerance} << place;
                sides_reached.behind |= std::uint64_t{height < -tolerance} << place;
            }
        }
        return sides_reached;
    }

private:
    /// The corners beyond PieceBatch::corners.
    struct ExtraCorners {
        std::size_t first = 0;
        std::size_t end = 0;
    };

    void add(const PolygonPieces& pieces, const PolygonPiece& piece) {
        PieceBatch& lanes = lanes_[count_ / PieceBatch::pieces];
        const std::size_t place = count_ % PieceBatch::pieces;
        put(lanes.centres, place, piece.middle);
        lanes.radii[place] = piece.radius + tolerance;
        const std::size_t corners = piece.corners.size();
        for (std::size_t i = 0; i < PieceBatch::corners; ++i) {
            const std::uint32_t corner = piece.corners[std::min(i, corners - 1)];
            put(lanes.first_corners[i], place, pieces.at(corner));
        }
        const std::size_t first_more = corners_.size();
        for (std::size_t i = PieceBatch::corners; i < corners; ++i) { corners_.push_back(pieces.at(piece.corners[i])); }
        extra_corners_.push_back({first_more, corners_.size()});
        has_extra_corners_[count_ / pieces_per_block] |= std::uint64_t{corners > PieceBatch::corners}
                                                         << (count_ % pieces_per_block);
        ++count_;
    }

    std::size_t count_ = 0;
    std::vector<PieceBatch> lanes_;
    std::vector<std::uint64_t> has_extra_corners_; ///< A bit a piece: it has more than PieceBatch::corners.
    std::vector<ExtraCorners> extra_corners_;      ///< One a piece.
    std::vector<glm::dvec3> corners_;
};

// Where to divide polygons. As in a BSP tree by polygons' own planes; across the axes, where models have gaps between
// their parts, the number of cuts is known for all planes at once by a sweep.

/// How a plane parts pieces.
struct SplitCounts {
    std::size_t before = 0;   ///< Wholly before the plane.
    std::size_t behind = 0;   ///< Wholly behind it.
    std::size_t coplanar = 0; ///< In it.
    std::size_t cut = 0;      ///< On both sides of it.
    bool cuts_swept = false;  ///< What a turning polygon sweeps is on both sides: it cannot be cut.
};

/// At most so many planes of pieces are tried.
constexpr std::size_t max_own_planes = 64;
/// Sums over more pieces than this are estimated by some of them.
constexpr std::size_t max_looked_at = 1'000;

/// A cut costs as much as halves that differ by so many pieces. Of 2, 8, 30 and 200 this one makes the fewest pieces of
/// parts of real aircraft and of made models.
constexpr double polygons_a_cut = 8.0;

/// A plane with its cost; less is better.
struct Costed {
    Plane plane;
    double cost = std::numeric_limits<double>::infinity();
};

/// The cost of a plane: its cuts, and how uneven the halves are.
double cost_of(const SplitCounts& counts) {
    const std::size_t count = counts.before + counts.behind + counts.coplanar + counts.cut;
    const bool useless = counts.coplanar == 0 && (counts.before == 0 || counts.behind == 0);
    if (counts.cuts_swept || (useless && counts.cut == 0) ||
        (counts.coplanar == 0 && counts.cut + counts.before >= count && counts.behind == 0) ||
        (counts.coplanar == 0 && counts.cut + counts.behind >= count && counts.before == 0)) {
        return std::numeric_limits<double>::infinity();
    }
    const double uneven = std::abs(static_cast<double>(counts.before) - static_cast<double>(counts.behind));
    return static_cast<double>(counts.cut) * polygons_a_cut + uneven;
}

/// Some of many pieces.
class Sample {
public:
    Sample(const PolygonPieces& pieces, std::span<const std::uint32_t> items)
        : step_(items.size() / max_looked_at + 1), table_(pieces, items, step_), swept_(table_.blocks(), 0) {
        for (std::size_t i = 0; i < table_.count(); ++i) {
            const bool is_swept = pieces[items[i * step_]].pivot.has_value();
            swept_[i / PieceTable::pieces_per_block] |= std::uint64_t{is_swept} << (i % PieceTable::pieces_per_block);
        }
    }

    /// How a plane parts all pieces, by these. Ends early where that costs more than `limit`.
    SplitCounts split_counts(const Plane& plane, double limit) const {
        SplitCounts counts;
        const auto max_cuts =
            static_cast<std::size_t>(std::min(limit / (polygons_a_cut * static_cast<double>(step_)), 1e9));
        for (std::size_t i = 0; i < table_.blocks() && counts.cut <= max_cuts; ++i) {
            const PlaneSideBits sides_reached = table_.sides_reached(i, plane);
            const std::uint64_t cut = sides_reached.before & sides_reached.behind;
            const std::size_t known = count_of(sides_reached.before | sides_reached.behind);
            counts.cut += count_of(cut);
            counts.before += count_of(sides_reached.before & ~cut);
            counts.behind += count_of(sides_reached.behind & ~cut);
            counts.coplanar += table_.count_in(i) - known;
            counts.cuts_swept = counts.cuts_swept || (cut & swept_[i]) != 0;
        }
        counts.before *= step_;
        counts.behind *= step_;
        counts.cut *= step_;
        return counts;
    }

private:
    static std::size_t count_of(std::uint64_t bits) { return static_cast<std::size_t>(std::popcount(bits)); }

    std::size_t step_;
    PieceTable table_;
    std::vector<std::uint64_t> swept_; ///< A bit a piece: by something that turns.
};

/// Whether a plane cuts a piece that turns, of all pieces: samples may have left it out.
bool cuts_turning(const PolygonPieces& pieces, std::span<const std::uint32_t> items, const Plane& plane) {
    return std::ranges::any_of(items, [&](std::uint32_t item) {
        if (!pieces[item].pivot) { return false; }
        const PlaneSideFlags sides_reached = pieces.sides_reached(item, plane);
        return sides_reached.before && sides_reached.behind;
    });
}

/// The best plane of a piece.
Costed best_own(const PolygonPieces& pieces, std::span<const std::uint32_t> items) {
    const Sample sample(pieces, items);
    Costed best;
    const std::size_t tried = std::min(items.size(), max_own_planes);
    for (std::size_t i = 0; i < tried; ++i) {
        const auto& plane = pieces[items[i * items.size() / tried]].plane;
        if (!plane) { continue; }
        const double cost = cost_of(sample.split_counts(*plane, best.cost));
        if (cost < best.cost && !cuts_turning(pieces, items, *plane)) { best = {*plane, cost}; }
    }
    return best;
}

/// Where pieces begin and end along an axis, ascending; those of turning parts once more.
struct Ends {
    std::vector<double> low;
    std::vector<double> high;
    std::vector<double> swept_low;
    std::vector<double> swept_high;
};

Ends ends_along(const PolygonPieces& pieces, std::span<const std::uint32_t> items, int axis) {
    Ends ends;
    for (const std::uint32_t item : items) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const std::uint32_t vertex : pieces[item].corners) {
            low = std::min(low, pieces.at(vertex)[axis]);
            high = std::max(high, pieces.at(vertex)[axis]);
        }
        ends.low.push_back(low);
        ends.high.push_back(high);
        if (pieces[item].pivot) {
            ends.swept_low.push_back(low);
            ends.swept_high.push_back(high);
        }
    }
    for (auto* values : {&ends.low, &ends.high, &ends.swept_low, &ends.swept_high}) { std::ranges::sort(*values); }
    return ends;
}

/// How a plane across the axis divides all pieces.
SplitCounts split_counts(const Ends& ends, double at) {
    const auto below = [](const std::vector<double>& sorted, double limit) {
        return static_cast<std::size_t>(std::ranges::lower_bound(sorted, limit) - sorted.begin());
    };
    const std::size_t count = ends.low.size();
    SplitCounts counts;
    counts.before = count - below(ends.low, at - tolerance);
    counts.behind = below(ends.high, at + tolerance);
    // Pieces within the tolerance of the plane are in both counts.
    const std::size_t known = counts.before + counts.behind;
    counts.coplanar = known > count ? known - count : 0;
    counts.before -= std::min(counts.before, counts.coplanar);
    counts.behind -= std::min(counts.behind, counts.coplanar);
    const std::size_t settled = counts.before + counts.behind + counts.coplanar;
    counts.cut = count - std::min(count, settled);
    counts.cuts_swept = below(ends.swept_low, at - tolerance) != below(ends.swept_high, at + tolerance);
    return counts;
}

/// The best plane across an axis.
Costed best_across(const PolygonPieces& pieces, std::span<const std::uint32_t> items, int axis) {
    const Ends ends = ends_along(pieces, items, axis);
    Costed best;
    for (std::size_t i = 0; i < items.size(); ++i) {
        for (const double at : {ends.low[i], ends.high[i]}) {
            const SplitCounts counts = split_counts(ends, at);
            const double cost = counts.before == 0 || counts.behind == 0 ? best.cost : cost_of(counts);
            if (cost < best.cost) {
                best = {{glm::dvec3(0.0), -at}, cost};
                best.plane.normal[axis] = 1.0;
            }
        }
    }
    return best;
}

/// A plane that divides pieces in two, or takes at least one of them out because it lies in it: the one with few cuts
/// and even halves among planes of pieces, at most 64 spread over them, and planes across the axes at the ends of
/// pieces. Returns nothing when every plane cuts what turns or leaves all pieces together.
std::optional<Plane> splitting_plane(const PolygonPieces& pieces, std::span<const std::uint32_t> items) {
    Costed best = best_own(pieces, items);
    for (int axis = 0; axis < 3; ++axis) {
        const Costed across = best_across(pieces, items, axis);
        if (across.cost < best.cost && !cuts_turning(pieces, items, across.plane)) { best = across; }
    }
    return std::isfinite(best.cost) ? std::optional(best.plane) : std::nullopt;
}

// What hides what for eyes anywhere, and which pieces have an order that is right for all of them.

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

/// occludes() of all pairs of a set, 64 pieces at once: row a of matrix() holds what hides part of a.
class OcclusionMatrix {
public:
    OcclusionMatrix(const PolygonPieces& pieces, std::span<const std::uint32_t> items)
        : pieces_(pieces), items_(items), hides_(items.size(), items.size()),
          reaches_behind_(items.size(), items.size()), still_(items.size()) {
        for (std::size_t i = 0; i < items.size(); ++i) {
            const PolygonPiece& piece = pieces[items[i]];
            if (piece.plane && !piece.pivot) { still_.add(i); }
        }
    }

    BitMatrix matrix() {
        const PieceTable table(pieces_, items_);
        for (std::size_t a = 0; a < items_.size(); ++a) {
            if (is_still(a)) { test_sides(table, a); }
        }
        for (std::size_t a = 0; a < items_.size(); ++a) {
            for (std::size_t i = 0; i < hides_.row_words() && is_still(a); ++i) {
                hides_.row(a)[i] &= reaches_behind_.row(a)[i] & still_.words()[i];
            }
            add_others(a);
            hides_.remove(a, a);
        }
        for (const auto& [upper, lower] : decals_) { hides_.add(lower, upper); }
        return std::move(hides_);
    }

private:
    /// Whether a piece has a plane that stands still.
    bool is_still(std::size_t i) const { return still_.has(i); }

    /// Tests the pairs of which one has no plane that stands still.
    void add_others(std::size_t a) {
        for (std::size_t i = 0; i < still_.words().size(); ++i) {
            const std::size_t end = std::min((i + 1) * 64, items_.size());
            const bool all_still = std::popcount(still_.words()[i]) == static_cast<int>(end - i * 64);
            for (std::size_t b = i * 64; b < end && !(is_still(a) && all_still); ++b) {
                if (!(is_still(a) && is_still(b)) && occludes(pieces_, items_[b], items_[a])) { hides_.add(a, b); }
            }
        }
    }

    /// Finds which pieces reach before the plane of a piece, and which behind it.
    void test_sides(const PieceTable& table, std::size_t a) {
        for (std::size_t i = 0; i < table.blocks(); ++i) {
            const PlaneSideBits sides_reached = table.sides_reached(i, *pieces_[items_[a]].plane);
            hides_.row(a)[i] = sides_reached.before;
            for (std::uint64_t left = sides_reached.behind; left != 0; left &= left - 1) {
                reaches_behind_.add(i * 64 + static_cast<std::size_t>(std::countr_zero(left)), a);
            }
            for (std::uint64_t left = still_.words()[i] & ~(sides_reached.before | sides_reached.behind); left != 0;
                 left &= left - 1) {
                const std::size_t b = i * 64 + static_cast<std::size_t>(std::countr_zero(left));
                if (b != a && is_decal_on(pieces_, items_[b], items_[a])) { decals_.emplace_back(b, a); }
            }
        }
    }

    const PolygonPieces& pieces_;
    std::span<const std::uint32_t> items_;
    BitMatrix hides_;          ///< At first the pieces that reach before the plane of the row's piece.
    BitMatrix reaches_behind_; ///< The pieces behind whose planes the row's piece reaches.
    BitSet still_;
    std::vector<std::pair<std::size_t, std::size_t>> decals_; ///< In one plane: upper, lower.
};

} // namespace

bool occludes(const PolygonPieces& pieces, std::uint32_t occluder, std::uint32_t occluded) {
    const PolygonPiece& b = pieces[occluder];
    const PolygonPiece& a = pieces[occluded];
    if (a.pivot && a.pivot == b.pivot) { return pieces.is_rigid(occluder, occluded); }
    if (!a.plane && !b.plane) { return true; }
    const PlaneSideFlags of_b = a.plane ? pieces.sides_reached(occluder, *a.plane) : PlaneSideFlags{true, true};
    if (a.plane && b.plane && !of_b.before && !of_b.behind) { return is_decal_on(pieces, occluder, occluded); }
    return of_b.before && (!b.plane || pieces.sides_reached(occluded, *b.plane).behind);
}

std::vector<std::vector<std::uint32_t>> occlusion_components(
    const PolygonPieces& pieces, std::span<const std::uint32_t> items) {
    BitMatrix hides = OcclusionMatrix(pieces, items).matrix();
    std::vector<std::uint32_t> last_first(items.size());
    std::iota(last_first.rbegin(), last_first.rend(), 0U);
    std::vector<std::vector<std::uint32_t>> components;
    ComponentSearch().search(
        items.size(), last_first, [&](std::uint32_t a, std::size_t word) { return hides.row(a)[word]; },
        [&](std::span<const std::uint32_t> found) {
            std::vector<std::uint32_t>& component = components.emplace_back();
            for (const std::uint32_t i : found) { component.push_back(items[i]); }
            std::ranges::sort(component);
        });
    std::ranges::reverse(components); // what hides part of a component is found before it and painted after it
    return components;
}

namespace {

/// Larger sets are divided before their graph is looked at, because its time is quadratic.
constexpr std::size_t max_samples_at_once = 1'500;
/// Sets of more pieces that came out of a cycle are looked at only once they are a quarter of it.
constexpr std::size_t always_looked_at = 150;

using Items = std::vector<std::uint32_t>;

/// Builds one tree. Work that is left is kept in a stack of its own, because chains of partings may be as long as there
/// are polygons.
class PartialBspBuilder {
public:
    explicit PartialBspBuilder(PolygonPieces& pieces) : pieces_(pieces) {}

    PartialBspTree build(Items items) {
        to_do_.push_back({std::move(items), -1, nullptr, 1, false});
        while (!to_do_.empty()) {
            Task task = std::move(to_do_.back());
            to_do_.pop_back();
            tree_.depth = std::max(tree_.depth, task.depth);
            const int child = child_of(task);
            if (task.parent < 0) {
                tree_.root = child;
            } else {
                tree_.nodes[static_cast<std::size_t>(task.parent)].*task.place = child;
            }
        }
        return std::move(tree_);
    }

private:
    using Node = PartialBspTree::Node;

    /// Pieces whose order has to be found, and the child of a node that it becomes.
    struct Task {
        Items items;
        int parent = -1;
        int Node::*place = nullptr;
        int depth = 1;
        bool is_cycle = false; ///< One component, which must be divided.
        /// How many pieces the last set had whose graph was looked at and out of which this came.
        std::size_t looked_at = std::numeric_limits<std::size_t>::max();
    };

    int child_of(Task& task) {
        if (task.items.empty()) { return PartialBspTree::no_child; }
        if (task.items.size() == 1) { return list_of(std::move(task.items)); }
        const std::size_t count = task.items.size();
        const bool looks = !task.is_cycle && count <= max_samples_at_once &&
                           (count <= always_looked_at || count <= task.looked_at / 4);
        if (!looks) { return choose_split(task); }
        task.looked_at = count;
        auto components = occlusion_components(pieces_, task.items);
        if (components.size() == 1 && components.front().size() > 1) { return choose_split(task); }
        return sequence_of(components, 0, components.size(), task.depth);
    }

    int list_of(Items items) {
        if (items.empty()) { return PartialBspTree::no_child; }
        tree_.lists.push_back(std::move(items));
        return ~static_cast<int>(tree_.lists.size() - 1);
    }

    int new_node(Node node) {
        tree_.nodes.push_back(std::move(node));
        return static_cast<int>(tree_.nodes.size() - 1);
    }

    /// Components from `first` to `end` painted one after the other. Depth grows with the logarithm of their number.
    int sequence_of(const std::vector<Items>& components, std::size_t first, std::size_t end, int depth) {
        const auto is_cycle = [&](std::size_t i) { return components[i].size() > 1; };
        std::size_t cycle = first;
        while (cycle < end && !is_cycle(cycle)) { ++cycle; }
        if (cycle == end) {
            Items list;
            for (std::size_t i = first; i < end; ++i) { list.push_back(components[i].front()); }
            return list_of(std::move(list));
        }
        const int node = new_node({});
        if (end - first == 1) { // a cycle alone: nothing is painted before it
            to_do_.push_back({components[first], node, &Node::back, depth + 1, true, components[first].size()});
            return node;
        }
        const std::size_t middle = divide_at(components, first, end);
        const int front = sequence_of(components, first, middle, depth + 1);
        const int back = sequence_of(components, middle, end, depth + 1);
        tree_.nodes[static_cast<std::size_t>(node)].front = front;
        tree_.nodes[static_cast<std::size_t>(node)].back = back;
        return node;
    }

    /// Where a sequence is divided: at an end of a run of single pieces near its middle.
    static std::size_t divide_at(const std::vector<Items>& components, std::size_t first, std::size_t end) {
        std::size_t middle = (first + end) / 2;
        const auto single = [&](std::size_t i) { return components[i].size() == 1; };
        while (middle > first + 1 && single(middle) && single(middle - 1)) { --middle; }
        if (middle == first + 1 && single(first) && single(middle)) {
            while (middle < end - 1 && single(middle)) { ++middle; }
        }
        return middle;
    }

    /// Divides pieces by a plane.
    int choose_split(Task& task) {
        const auto plane = splitting_plane(pieces_, task.items);
        if (!plane) { return unsplit_cycles(task); }
        Node node;
        node.plane = plane;
        Items front;
        Items back;
        Items coplanar_front;
        Items coplanar_back;
        for (const std::uint32_t item : task.items) {
            const PlaneSideFlags sides_reached = pieces_.sides_reached(item, *plane);
            if (sides_reached.before && sides_reached.behind) { back.push_back(pieces_.cut(item, *plane)); }
            if (sides_reached.before) {
                front.push_back(item);
            } else if (sides_reached.behind) {
                back.push_back(item);
            } else {
                const auto& own = pieces_[item].plane; // a flat body is seen from both sides
                const double facing = own ? glm::dot(own->normal, plane->normal) : 0.0;
                if (facing >= 0.0) { coplanar_front.push_back(item); }
                if (facing <= 0.0) { coplanar_back.push_back(item); }
            }
        }
        node.coplanar_front = list_in_file_order(std::move(coplanar_front));
        node.coplanar_back = list_in_file_order(std::move(coplanar_back));
        const int made = new_node(node);
        to_do_.push_back({std::move(front), made, &Node::front, task.depth + 1, false, task.looked_at});
        to_do_.push_back({std::move(back), made, &Node::back, task.depth + 1, false, task.looked_at});
        return made;
    }

    /// The last resort: fixed pieces are divided, and turning pieces are painted over them.
    int unsplit_cycles(Task& task) {
        std::ranges::sort(task.items);
        tree_.unsplit_cycles.push_back(task.items);
        Items turning;
        Items fixed_pieces;
        for (const std::uint32_t item : task.items) { (pieces_[item].pivot ? turning : fixed_pieces).push_back(item); }
        if (fixed_pieces.empty() || turning.empty()) { return list_of(std::move(task.items)); }
        const int node = new_node({});
        tree_.nodes.back().back = list_of(std::move(turning));
        to_do_.push_back({std::move(fixed_pieces), node, &Node::front, task.depth + 1, false});
        return node;
    }

    int list_in_file_order(Items items) {
        std::ranges::sort(items, {}, [&](std::uint32_t item) { return std::pair(pieces_[item].source, item); });
        return list_of(std::move(items));
    }

    PolygonPieces& pieces_;
    std::vector<Task> to_do_;
    PartialBspTree tree_;
};

} // namespace

PartialBspTree partial_bsp_tree(PolygonPieces& pieces, std::vector<std::uint32_t> items) {
    return PartialBspBuilder(pieces).build(std::move(items));
}

} // namespace octant::visuals::bsp
