// Cuts one polygon of a model along a plane, and cuts polygons that pass through one another. Cuts of polygons that
// occlude one another in a cycle are chosen in view_cell.cpp.
#include "visuals/draworder/split.h"

#include "models/planar/planar_model.h"
#include "sim/base/plane.h"
#include "visuals/draworder/occlusion.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

void insert_cut_pieces(std::vector<std::uint32_t>& list, std::span<const std::uint32_t> cut_from, std::uint32_t first) {
    if (cut_from.empty()) { return; }
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> latest(first + cut_from.size(), none); // that was cut off a piece
    std::vector<std::uint32_t> before(latest.size(), none);           // that was cut off the same one
    for (std::size_t i = 0; i < cut_from.size(); ++i) {
        before[first + i] = std::exchange(latest[cut_from[i]], static_cast<std::uint32_t>(first + i));
    }
    std::vector<std::uint32_t> with_pieces;
    std::vector<std::uint32_t> pending;
    for (const std::uint32_t polygon : list) {
        pending.push_back(polygon);
        while (!pending.empty()) {
            const std::uint32_t at = pending.back();
            pending.pop_back();
            with_pieces.push_back(at);
            for (const std::uint32_t next : {before[at], latest[at]}) {
                if (next != none) { pending.push_back(next); }
            }
        }
    }
    list = std::move(with_pieces);
}

namespace {

using models::polygons::PolygonModel;
using Outline = std::vector<std::uint32_t>;

/// A side of a polygon that a cut passes through.
struct CutSide {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t middle = 0; ///< The new vertex on it.
};

/// The outlines of both pieces of a cut polygon.
struct Halves {
    Outline front;
    Outline back;
    std::vector<CutSide> cut_sides;
};

/// Cuts an outline. Corners within the tolerance belong to both halves; new vertices are added to the model.
Halves halves_of(PolygonModel& model, const Outline& outline, const Plane& plane, double tolerance_m) {
    Halves halves;
    const auto height_m = [&](std::uint32_t vertex) {
        const double at_m = distance_m(plane, model.vertices_m[vertex]);
        return std::abs(at_m) <= tolerance_m ? 0.0 : at_m;
    };
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::uint32_t here = outline[i];
        const std::uint32_t next = outline[(i + 1) % outline.size()];
        const double here_m = height_m(here);
        const double next_m = height_m(next);
        if (here_m >= 0.0) { halves.front.push_back(here); }
        if (here_m <= 0.0) { halves.back.push_back(here); }
        if (here_m * next_m < 0.0) {
            const auto middle = static_cast<std::uint32_t>(model.vertices_m.size());
            const double share = here_m / (here_m - next_m);
            model.vertices_m.push_back(glm::mix(model.vertices_m[here], model.vertices_m[next], share));
            halves.front.push_back(middle);
            halves.back.push_back(middle);
            halves.cut_sides.push_back({here, next, middle});
        }
    }
    return halves;
}

/// An outline with the vertices that cuts have put in the middle of its sides.
Outline with_cut_sides(
    const PolygonModel& model, std::span<const std::uint32_t> outline, const std::vector<CutSide>& sides) {
    const auto& at_m = model.vertices_m;
    Outline out;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        out.push_back(outline[i]);
        const glm::dvec3& here_m = at_m[outline[i]];
        const glm::dvec3& next_m = at_m[outline[(i + 1) % outline.size()]];
        for (const CutSide& side : sides) {
            const bool along = here_m == at_m[side.from] && next_m == at_m[side.to];
            const bool against = here_m == at_m[side.to] && next_m == at_m[side.from];
            if (along || against) { out.push_back(side.middle); }
        }
    }
    return out;
}

} // namespace

double split_tolerance_m(const PolygonModel& model) {
    if (model.vertices_m.empty()) { return 0.0; }
    glm::dvec3 least = model.vertices_m[0];
    glm::dvec3 most = model.vertices_m[0];
    for (const glm::dvec3& vertex : model.vertices_m) {
        least = glm::min(least, vertex);
        most = glm::max(most, vertex);
    }
    return models::planar::planar_tolerance * glm::distance(least, most) / 2.0;
}

std::uint32_t split_polygon(PolygonModel& model, std::size_t polygon, const Plane& plane) {
    const double tolerance_m = split_tolerance_m(model);
    const auto whole = model.corners(polygon);
    [[maybe_unused]] const auto height_m = [&](std::uint32_t corner) {
        return distance_m(plane, model.vertices_m[corner]);
    };
    assert(std::ranges::any_of(whole, [&](auto c) { return height_m(c) > tolerance_m; }));
    assert(std::ranges::any_of(whole, [&](auto c) { return height_m(c) < -tolerance_m; }));
    const Halves halves = halves_of(model, {whole.begin(), whole.end()}, plane, tolerance_m);
    if (model.parents.empty()) {
        model.parents.resize(model.polygons.size());
        std::iota(model.parents.begin(), model.parents.end(), 0U);
    }
    std::vector<std::uint32_t> corner_vertices;
    const auto add = [&](models::polygons::Polygon& to, const Outline& outline) {
        to.first_corner = static_cast<std::uint32_t>(corner_vertices.size());
        to.corner_count = static_cast<std::uint32_t>(outline.size());
        corner_vertices.insert(corner_vertices.end(), outline.begin(), outline.end());
    };
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        add(model.polygons[i], i == polygon ? halves.front : with_cut_sides(model, model.corners(i), halves.cut_sides));
    }
    const auto back = static_cast<std::uint32_t>(model.polygons.size());
    model.polygons.push_back(model.polygons[polygon]);
    model.parents.push_back(model.parents[polygon]);
    add(model.polygons.back(), halves.back);
    model.corner_vertices = std::move(corner_vertices);
    return back;
}

// E. K. Kim, J. A. Park, C. Song, J. H. Kim, "Hidden-Surface Removal in 3D Graphics for Real Time Animation", 1989,
// section IV and fig. 14: polygons that pass through one another are cut before they are ordered. Deviations:
// - The paper cuts by hand, both polygons of a pair and along lines that end inside the polygon:
//   fig. 14 becomes six pieces. Here a cut runs right across a polygon, so that the pieces stay
//   convex, and one polygon of a pair is cut: then both its pieces lie on one side of the other.
//   Fig. 14 becomes three pieces.
// - Which polygon of a pair is cut is not said. Each step takes the cut that leaves the fewest
//   pairs, so that a plane in which several polygons lie, such as the two faces of a thin part,
//   is used for all of them at once. Greedy: the fewest pieces are not promised.

namespace {

using Corners = std::vector<glm::dvec3>;

/// About the work of looking at a pair, and of a cut for each polygon there is (SearchBudget).
constexpr std::uint64_t units_of_split_pair = 5;
constexpr std::uint64_t units_of_cut = 100;

/// With more cuts than 100 + 4 a polygon there are too many pieces for a search.
constexpr std::size_t max_cuts_a_polygon = 4;
constexpr std::size_t cuts_always_allowed = 100;

Corners corners_of(const PolygonModel& model, std::size_t polygon) {
    Corners corners;
    corners.reserve(model.polygons[polygon].corner_count);
    for (const std::uint32_t vertex : model.corners(polygon)) { corners.push_back(model.vertices_m[vertex]); }
    return corners;
}

/// Whether there are corners beyond the tolerance on both sides of a plane.
bool straddles(const Corners& corners, const Plane& plane, double tolerance_m) {
    bool before = false;
    bool behind = false;
    for (const glm::dvec3& corner : corners) {
        const double at_m = distance_m(plane, corner);
        before = before || at_m > tolerance_m;
        behind = behind || at_m < -tolerance_m;
    }
    return before && behind;
}

struct Interval {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
};

/// The interval in which a convex polygon that straddles a plane crosses it, measured along a direction.
Interval crossing(const Corners& corners, const Plane& plane, const glm::dvec3& along) {
    Interval at;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3& next = corners[(i + 1) % corners.size()];
        const double here_m = distance_m(plane, corners[i]);
        const double next_m = distance_m(plane, next);
        if ((here_m > 0.0) != (next_m > 0.0)) {
            const glm::dvec3 point = glm::mix(corners[i], next, here_m / (here_m - next_m));
            at.least = std::min(at.least, glm::dot(point, along));
            at.most = std::max(at.most, glm::dot(point, along));
        }
    }
    return at;
}

/// A polygon or piece of one, with the plane of the whole polygon and a bounding box.
struct PlanarPiece {
    Corners corners;
    Plane plane;
    std::optional<std::uint32_t> pivot;
    glm::dvec3 least{std::numeric_limits<double>::infinity()};
    glm::dvec3 most{-std::numeric_limits<double>::infinity()};
};

PlanarPiece piece_of(Corners corners, const Plane& plane, std::optional<std::uint32_t> pivot) {
    PlanarPiece piece{.corners = std::move(corners), .plane = plane, .pivot = pivot};
    for (const glm::dvec3& corner : piece.corners) {
        piece.least = glm::min(piece.least, corner);
        piece.most = glm::max(piece.most, corner);
    }
    return piece;
}

bool boxes_apart(const PlanarPiece& a, const PlanarPiece& b) {
    return glm::any(glm::lessThan(a.most, b.least)) || glm::any(glm::lessThan(b.most, a.least));
}

/// Whether two polygons pass through one another.
bool penetrate(const PlanarPiece& a, const PlanarPiece& b, double tolerance_m) {
    if (a.pivot != b.pivot || boxes_apart(a, b) || !straddles(a.corners, b.plane, tolerance_m) ||
        !straddles(b.corners, a.plane, tolerance_m)) {
        return false;
    }
    const glm::dvec3 along = glm::cross(a.plane.normal, b.plane.normal);
    const double slope = glm::length(along);
    if (slope < 1e-12) { return false; }
    const Interval in_a = crossing(a.corners, b.plane, along / slope);
    const Interval in_b = crossing(b.corners, a.plane, along / slope);
    return std::min(in_a.most, in_b.most) - std::max(in_a.least, in_b.least) > tolerance_m;
}

/// Cuts penetrating polygons, the most useful cut first.
class Splitter {
public:
    explicit Splitter(PolygonModel& model) : model_(model), tolerance_m_(split_tolerance_m(model)) {
        for (std::size_t i = 0; i < model.polygons.size(); ++i) {
            faces_.push_back(piece_of(
                corners_of(model, i), models::polygons::plane_of(model, i), models::polygons::pivot_of(model, i)));
        }
        partners_.resize(faces_.size());
        cuts_.resize(faces_.size());
        for (std::uint32_t i = 0; i < faces_.size(); ++i) { find_partners_after(i); }
    }

    int split_all(SearchBudget& budget) {
        const std::size_t most = max_cuts_a_polygon * faces_.size() + cuts_always_allowed;
        std::size_t added = 0;
        while (const auto polygon = best_polygon()) {
            if (added == most) {
                throw SearchGivenUp{fmt::format("polygons that pass through one another need {} cuts", most)};
            }
            budget.spend(units_of_cut * faces_.size());
            cut(*polygon, cuts_[*polygon]->along);
            ++added;
        }
        return static_cast<int>(added);
    }

private:
    /// The best cut of a polygon: along the plane of another one, with the number of pairs that it removes.
    struct PolygonCut {
        std::uint32_t along = 0;
        long pairs_fewer = 0;
    };

    /// Finds the polygons with higher numbers that pass through a polygon.
    void find_partners_after(std::uint32_t face) {
        for (std::uint32_t other = face + 1; other < faces_.size(); ++other) {
            if (penetrate(faces_[face], faces_[other], tolerance_m_)) {
                partners_[face].push_back(other);
                partners_[other].push_back(face);
            }
        }
    }

    /// The polygon whose best cut removes the most pairs; nothing when there are none left.
    std::optional<std::uint32_t> best_polygon() {
        std::optional<std::uint32_t> best;
        for (std::uint32_t i = 0; i < faces_.size(); ++i) {
            if (partners_[i].empty()) { continue; }
            if (!cuts_[i]) { cuts_[i] = best_polygon_cut(i); }
            if (!best || cuts_[i]->pairs_fewer > cuts_[*best]->pairs_fewer) { best = i; }
        }
        return best;
    }

    PolygonCut best_polygon_cut(std::uint32_t face) const {
        std::optional<PolygonCut> best;
        for (const std::uint32_t along : partners_[face]) {
            const long fewer = pairs_fewer(face, faces_[along].plane);
            if (!best || fewer > best->pairs_fewer) { best = PolygonCut{along, fewer}; }
        }
        return *best;
    }

    /// By how many the penetrating pairs get fewer when a polygon is cut along a plane.
    long pairs_fewer(std::uint32_t face, const Plane& plane) const {
        const PlanarPiece& whole = faces_[face];
        const PlanarPiece front = piece_of(front_part(whole.corners, plane, 0.0), whole.plane, whole.pivot);
        const PlanarPiece back = piece_of(front_part(whole.corners, turned_over(plane), 0.0), whole.plane, whole.pivot);
        auto fewer = static_cast<long>(partners_[face].size());
        for (const std::uint32_t other : partners_[face]) {
            fewer -= penetrate(front, faces_[other], tolerance_m_) ? 1 : 0;
            fewer -= penetrate(back, faces_[other], tolerance_m_) ? 1 : 0;
        }
        return fewer;
    }

    /// Cuts a polygon and finds the partners of both pieces.
    void cut(std::uint32_t face, std::uint32_t along) {
        const std::vector<std::uint32_t> others = std::exchange(partners_[face], {});
        const std::uint32_t back = split_polygon(model_, face, faces_[along].plane);
        const PlanarPiece whole = std::move(faces_[face]);
        faces_[face] = piece_of(corners_of(model_, face), whole.plane, whole.pivot);
        faces_.push_back(piece_of(corners_of(model_, back), whole.plane, whole.pivot));
        partners_.emplace_back();
        cuts_[face].reset();
        cuts_.emplace_back();
        for (const std::uint32_t other : others) {
            std::erase(partners_[other], face);
            cuts_[other].reset();
            for (const std::uint32_t piece : {face, back}) {
                if (penetrate(faces_[piece], faces_[other], tolerance_m_)) {
                    partners_[piece].push_back(other);
                    partners_[other].push_back(piece);
                    std::ranges::sort(partners_[other]);
                }
            }
        }
    }

    PolygonModel& model_;
    double tolerance_m_;
    std::vector<PlanarPiece> faces_;
    /// For each face those that it passes through, ascending.
    std::vector<std::vector<std::uint32_t>> partners_;
    /// For each face its best cut; nothing where that has to be found anew.
    std::vector<std::optional<PolygonCut>> cuts_;
};

} // namespace

int split_penetrating(PolygonModel& model, SearchBudget& budget) {
    budget.spend(units_of_split_pair * model.polygons.size() * model.polygons.size());
    return Splitter(model).split_all(budget);
}

} // namespace octant::visuals::draworder
