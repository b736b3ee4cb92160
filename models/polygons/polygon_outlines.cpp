// Ear clipping: G. H. Meisters, "Polygons have ears", 1975. Merging of triangles into convex pieces: S. Hertel, K.
// Mehlhorn, "Fast triangulation of simple polygons", 1983. Deviations:
// - Both leave the order of ears and diagonals open. Here ears in one plane with a neighbouring side come first, among
//   them the highest, and long diagonals are removed first: bent polygons fold at the right place, and thin triangles
//   are avoided.
// - A second triangulation prefers ears next to reflex corners, so that cuts end there. The triangulation with fewer
//   pieces is used.
// - A diagonal is removed only if the resulting piece passes corners_fault.
// - Ears and diagonals that differ only by rounding are taken in the order of the corners, so that the position and
//   attitude of a model do not change its cuts.
#include "models/polygons/polygon_outlines.h"

#include "models/polygons/polygon_model.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace octant::models::polygons {

bool is_inside(std::span<const glm::dvec3> corners, const glm::dvec3& normal, const glm::dvec3& point) {
    const glm::dvec3 steep = glm::abs(normal);
    const int most = steep.y > steep.x ? 1 : 0;
    const int across = steep.z > steep[most] ? 2 : most;
    const int u = (across + 1) % 3;
    const int v = (across + 2) % 3;
    bool inside = false;
    const glm::dvec3* from = &corners.back();
    for (const glm::dvec3& to : corners) {
        if (((*from)[v] > point[v]) != (to[v] > point[v])) {
            const double share = (point[v] - (*from)[v]) / (to[v] - (*from)[v]);
            inside = inside != ((*from)[u] + (to[u] - (*from)[u]) * share > point[u]);
        }
        from = &to;
    }
    return inside;
}

double distance_to_sides(std::span<const glm::dvec3> corners, const glm::dvec3& point) {
    double nearest2 = std::numeric_limits<double>::infinity();
    glm::dvec3 from = corners.back() - point;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 to = corner - point;
        const glm::dvec3 along = to - from;
        const double length2 = glm::dot(along, along);
        const double share = length2 > 0.0 ? std::clamp(-glm::dot(from, along) / length2, 0.0, 1.0) : 0.0;
        const glm::dvec3 nearest = from + along * share;
        nearest2 = std::min(nearest2, glm::dot(nearest, nearest));
        from = to;
    }
    return std::sqrt(nearest2);
}

namespace {

/// Twice an area over the product of two lengths below which three points are on one line.
constexpr double on_line = 1e-12;

/// Positive when the path a -> b -> c turns left: twice the area of the triangle.
double turn_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const glm::dvec2 first = b - a;
    const glm::dvec2 second = c - a;
    return first.x * second.y - first.y * second.x;
}

/// -1, 0 or 1: on which side of the line a -> b a point lies.
int side_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& point) {
    const double turn = turn_of(a, b, point);
    const double limit = on_line * glm::distance(a, b) * std::max(glm::distance(a, point), glm::distance(b, point));
    return std::abs(turn) <= limit ? 0 : (turn > 0.0 ? 1 : -1);
}

/// Whether a point on the line through a and b lies between them.
bool within(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& point) {
    return glm::dot(point - a, point - b) <= 0.0;
}

bool meet(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    const int c_side = side_of(a, b, c);
    const int d_side = side_of(a, b, d);
    const int a_side = side_of(c, d, a);
    const int b_side = side_of(c, d, b);
    if (c_side * d_side < 0 && a_side * b_side < 0) { return true; }
    return (c_side == 0 && within(a, b, c)) || (d_side == 0 && within(a, b, d)) || (a_side == 0 && within(c, d, a)) ||
           (b_side == 0 && within(c, d, b));
}

/// Projects the corners of a polygon along its mean normal (Newell's method), metres from the first corner. The result
/// runs counter-clockwise. The polygon must have an area.
std::vector<glm::dvec2> projected_outline(std::span<const glm::dvec3> corners_m) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners_m.size(); ++i) {
        sum += glm::cross(corners_m[i] - corners_m[0], corners_m[i + 1] - corners_m[0]);
    }
    const glm::dvec3 normal = glm::normalize(sum);
    const glm::dvec3 aside = std::abs(normal.x) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, normal));
    const glm::dvec3 up = glm::cross(normal, right);
    std::vector<glm::dvec2> outline;
    for (const glm::dvec3& corner_m : corners_m) {
        const glm::dvec3 from_first_m = corner_m - corners_m[0];
        outline.emplace_back(glm::dot(from_first_m, right), glm::dot(from_first_m, up));
    }
    return outline;
}

/// Finds the first two sides of an outline that meet other than at a common corner, by the indices of their first
/// corners. Neighbours that fold back onto each other count too. Time grows with the square of the number of corners.
std::optional<std::pair<std::size_t, std::size_t>> intersecting_sides(std::span<const glm::dvec2> outline) {
    const std::size_t count = outline.size();
    const auto corner = [&](std::size_t place) { return outline[place % count]; };
    for (std::size_t i = 0; i < count; ++i) {
        const bool folds = side_of(corner(i), corner(i + 1), corner(i + 2)) == 0 &&
                           glm::dot(corner(i + 1) - corner(i), corner(i + 2) - corner(i + 1)) < 0.0;
        if (folds) { return std::pair(i, (i + 1) % count); }
        for (std::size_t j = i + 2; j < count; ++j) {
            const bool neighbours = (j + 1) % count == i;
            if (!neighbours && meet(corner(i), corner(i + 1), corner(j), corner(j + 1))) { return std::pair(i, j); }
        }
    }
    return std::nullopt;
}

using Triangle = std::array<std::size_t, 3>;

/// Corners without the coordinate along which the polygon is seen best, counter-clockwise.
std::vector<glm::dvec2> seen_outline(std::span<const glm::dvec3> corners_m) {
    glm::dvec3 sum(0.0);
    const glm::dvec3& first_m = corners_m.front();
    for (std::size_t i = 1; i + 1 < corners_m.size(); ++i) {
        sum += glm::cross(corners_m[i] - first_m, corners_m[i + 1] - first_m);
    }
    const glm::dvec3 size = glm::abs(sum);
    const int along = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const int u = (along + 1) % 3;
    const int v = (along + 2) % 3;
    const double side = sum[along] < 0.0 ? -1.0 : 1.0;
    std::vector<glm::dvec2> outline;
    outline.reserve(corners_m.size());
    for (const glm::dvec3& corner_m : corners_m) {
        const glm::dvec3 from_first_m = corner_m - first_m;
        outline.emplace_back(from_first_m[u], side * from_first_m[v]);
    }
    return outline;
}

bool is_strictly_convex(std::span<const glm::dvec2> outline) {
    const std::size_t count = outline.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (turn_of(outline[i], outline[(i + 1) % count], outline[(i + 2) % count]) <= 0.0 ||
            turn_of(outline[0], outline[i], outline[(i + 1) % count]) < 0.0) {
            return false;
        }
    }
    return true;
}

/// The corners that are left are a ring; whether one is an ear changes only with its neighbours.
class EarCutting {
public:
    explicit EarCutting(std::span<const glm::dvec2> outline)
        : outline_(outline), before_(outline.size()), after_(outline.size()), dented_(outline.size()),
          ear_(outline.size()) {
        const std::size_t count = outline.size();
        for (std::size_t i = 0; i < count; ++i) {
            before_[i] = (i + count - 1) % count;
            after_[i] = (i + 1) % count;
        }
        for (std::size_t i = 0; i < count; ++i) { dented_[i] = turn_at(i) <= 0.0; }
        for (std::size_t i = 0; i < count; ++i) { ear_[i] = is_ear(i); }
    }

    std::vector<Triangle> cut() {
        std::vector<Triangle> pieces;
        std::size_t at = 0;
        for (std::size_t left = outline_.size(); left > 3; --left) {
            at = next_ear(at, left);
            pieces.push_back({before_[at], at, after_[at]});
            at = take_out(at);
        }
        pieces.push_back({before_[at], at, after_[at]});
        return pieces;
    }

private:
    double turn_at(std::size_t i) const { return turn_of(outline_[before_[i]], outline_[i], outline_[after_[i]]); }

    bool is_ear(std::size_t i) const {
        if (dented_[i]) { return false; }
        const glm::dvec2& a = outline_[before_[i]];
        const glm::dvec2& b = outline_[i];
        const glm::dvec2& c = outline_[after_[i]];
        for (std::size_t k = after_[after_[i]]; k != before_[i]; k = after_[k]) {
            const glm::dvec2& p = outline_[k];
            if (dented_[k] && p != a && p != b && p != c && turn_of(a, b, p) >= 0.0 && turn_of(b, c, p) >= 0.0 &&
                turn_of(c, a, p) >= 0.0) {
                return false;
            }
        }
        return true;
    }

    /// An outline that crosses itself may have none: then its next bulging corner, else any.
    std::size_t next_ear(std::size_t from, std::size_t left) const {
        std::size_t bulge = from;
        for (std::size_t tried = 0; tried < left; ++tried, from = after_[from]) {
            if (ear_[from]) { return from; }
            bulge = dented_[bulge] ? from : bulge;
        }
        return bulge;
    }

    /// Gives the place to go on from: two further, so that the pieces do not all meet in a corner.
    std::size_t take_out(std::size_t i) {
        const std::size_t a = before_[i];
        const std::size_t c = after_[i];
        after_[a] = c;
        before_[c] = a;
        dented_[a] = turn_at(a) <= 0.0;
        dented_[c] = turn_at(c) <= 0.0;
        ear_[a] = is_ear(a);
        ear_[c] = is_ear(c);
        return after_[c];
    }

    std::span<const glm::dvec2> outline_;
    std::vector<std::size_t> before_;
    std::vector<std::size_t> after_;
    std::vector<bool> dented_;
    std::vector<bool> ear_;
};

} // namespace

std::vector<Triangle> triangulate_polygon(std::span<const glm::dvec3> corners_m) {
    assert(corners_m.size() >= 3);
    const std::vector<glm::dvec2> outline = seen_outline(corners_m);
    if (!is_strictly_convex(outline)) { return EarCutting(outline).cut(); }
    std::vector<Triangle> pieces;
    for (std::size_t i = 1; i + 1 < corners_m.size(); ++i) { pieces.push_back({0, i, i + 1}); }
    return pieces;
}

namespace {

using Corners = std::span<const glm::dvec3>;
using Outline = std::vector<glm::dvec2>;
using Piece = std::vector<std::size_t>;

/// What makes one ear better than another.
enum class Prefer { High, BesideDents };

/// Heights and lengths whose relative difference is smaller are equal; the difference may be rounding.
constexpr double equal_share = 1e-7;

/// How good an ear is.
struct Ear {
    bool in_a_plane = false;
    int dents_beside = 0;
    double height_m = 0.0;

    /// Whether this one is to be clipped before another one.
    bool is_better_than(const Ear& other) const {
        const auto kind = std::tuple(in_a_plane, dents_beside);
        const auto other_kind = std::tuple(other.in_a_plane, other.dents_beside);
        return kind != other_kind ? kind > other_kind : height_m > other.height_m * (1.0 + equal_share);
    }
};

/// Nothing where a corner is no ear.
using Rank = std::optional<Ear>;

class EarClipper {
public:
    EarClipper(Corners corners_m, const Outline& outline, double tolerance_m, Prefer prefer)
        : corners_m_(corners_m), outline_(outline), tolerance_m_(tolerance_m), prefer_(prefer) {
        for (std::size_t i = 0; i < outline.size(); ++i) { ring_.push_back(i); }
    }

    /// Clips ears until a triangle is left; nothing where no ear is found.
    std::optional<std::vector<Piece>> triangles() {
        std::vector<Piece> out;
        rank_all(tolerance_m_);
        while (ring_.size() > 3) {
            std::optional<std::size_t> ear = best();
            for (const double clearance_m : {tolerance_m_, 0.0}) {
                if (!ear) {
                    rank_all(clearance_m);
                    ear = best();
                }
            }
            if (!ear) { return std::nullopt; }
            out.push_back({at(*ear, -1), at(*ear, 0), at(*ear, 1)});
            clip(*ear);
        }
        out.push_back(ring_);
        return out;
    }

private:
    /// Place in the polygon of the corner `step` behind place `i` of the ring.
    std::size_t at(std::size_t i, int step) const {
        const auto count = static_cast<std::ptrdiff_t>(ring_.size());
        const std::ptrdiff_t place = (static_cast<std::ptrdiff_t>(i) + step + count) % count;
        return ring_[static_cast<std::size_t>(place)];
    }

    const glm::dvec2& flat(std::size_t i, int step) const { return outline_[at(i, step)]; }

    void rank_all(double clearance_m) {
        clearance_m_ = clearance_m;
        ranks_.resize(ring_.size());
        for (std::size_t i = 0; i < ring_.size(); ++i) { ranks_[i] = rank_of(i); }
    }

    std::optional<std::size_t> best() const {
        std::optional<std::size_t> found;
        for (std::size_t i = 0; i < ranks_.size(); ++i) {
            if (ranks_[i] && (!found || ranks_[i]->is_better_than(*ranks_[*found]))) { found = i; }
        }
        return found;
    }

    void clip(std::size_t ear) {
        ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(ear));
        ranks_.erase(ranks_.begin() + static_cast<std::ptrdiff_t>(ear));
        // Two corners on either side: planes and dents reach that far.
        const std::size_t count = ring_.size();
        for (std::size_t step = 0; step < 4; ++step) {
            const std::size_t i = (ear + count + step - 2) % count;
            ranks_[i] = rank_of(i);
        }
    }

    Rank rank_of(std::size_t i) const {
        const std::array<glm::dvec2, 3> ear{flat(i, -1), flat(i, 0), flat(i, 1)};
        const double longest_m =
            std::max({glm::distance(ear[0], ear[1]), glm::distance(ear[1], ear[2]), glm::distance(ear[2], ear[0])});
        const double height_m = turn_of(ear[0], ear[1], ear[2]) / longest_m;
        if (height_m <= std::max(clearance_m_, 1e-9 * longest_m) || !is_free(i, ear)) { return std::nullopt; }
        const bool beside = prefer_ == Prefer::BesideDents;
        return Ear{in_a_plane(i), beside ? dents_beside(i) : 0, height_m};
    }

    /// True when no other corner lies in the ear or nearer to it than the clearance.
    bool is_free(std::size_t i, const std::array<glm::dvec2, 3>& ear) const {
        for (const std::size_t other : ring_) {
            if (other == at(i, -1) || other == at(i, 0) || other == at(i, 1)) { continue; }
            bool inside = true;
            for (std::size_t side = 0; side < 3 && inside; ++side) {
                const glm::dvec2& from = ear[side];
                const glm::dvec2& to = ear[(side + 1) % 3];
                const double length_m = glm::distance(from, to);
                inside = turn_of(from, to, outline_[other]) >= -clearance_m_ * length_m;
            }
            if (inside) { return false; }
        }
        return true;
    }

    /// True when the corner before or behind the ear lies in its plane.
    bool in_a_plane(std::size_t i) const {
        const glm::dvec3& origin_m = corners_m_[at(i, 0)];
        const glm::dvec3 normal =
            glm::normalize(glm::cross(corners_m_[at(i, 1)] - origin_m, corners_m_[at(i, -1)] - origin_m));
        const auto near = [&](int step) {
            const glm::dvec3 offset_m = corners_m_[at(i, step)] - origin_m;
            return std::abs(glm::dot(offset_m, normal)) <= tolerance_m_;
        };
        return near(-2) || near(2);
    }

    /// How many of the ear's neighbours are dents.
    int dents_beside(std::size_t i) const {
        const auto dent = [&](int step) {
            return turn_of(flat(i, step - 1), flat(i, step), flat(i, step + 1)) < 0.0 ? 1 : 0;
        };
        return dent(-1) + dent(1);
    }

    Corners corners_m_;
    const Outline& outline_;
    double tolerance_m_;
    Prefer prefer_;
    double clearance_m_ = 0.0;
    std::vector<std::size_t> ring_; ///< places of the corners not yet clipped
    std::vector<Rank> ranks_;       ///< of each corner of the ring
};

std::vector<glm::dvec3> corners_of(Corners corners_m, const Piece& piece) {
    std::vector<glm::dvec3> out;
    for (const std::size_t place : piece) { out.push_back(corners_m[place]); }
    return out;
}

/// The two pieces as one without the side that they share; `side` is where it begins in the first.
Piece joined(const Piece& first, std::size_t side, const Piece& second) {
    const std::size_t to = first[(side + 1) % first.size()];
    const auto begin = std::ranges::find(second, to) - second.begin();
    Piece out;
    for (std::size_t i = 1; i <= first.size(); ++i) { out.push_back(first[(side + i) % first.size()]); }
    // `second` runs to -> from and on; what lies behind `from` comes between from and to.
    for (std::size_t i = 2; i < second.size(); ++i) {
        out.push_back(second[(static_cast<std::size_t>(begin) + i) % second.size()]);
    }
    return out;
}

/// A side that two pieces share.
struct Diagonal {
    std::size_t from = 0;
    std::size_t to = 0;
    double length_m = 0.0;

    /// The length in steps so small that those of equal ones are equal.
    double steps(double longest_m) const { return std::round(length_m / longest_m / equal_share); }
};

/// Diagonals of a triangulation, longest first.
std::vector<Diagonal> diagonals_of(Corners corners_m, const std::vector<Piece>& triangles) {
    std::vector<Diagonal> out;
    for (const Piece& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t from = triangle[i];
            const std::size_t to = triangle[(i + 1) % 3];
            if (from < to && to - from > 1 && to - from + 1 < corners_m.size()) {
                out.push_back({from, to, glm::distance(corners_m[from], corners_m[to])});
            }
        }
    }
    double longest_m = 0.0;
    for (const Diagonal& diagonal : out) { longest_m = std::max(longest_m, diagonal.length_m); }
    std::ranges::stable_sort(
        out, std::ranges::greater(), [&](const Diagonal& diagonal) { return diagonal.steps(longest_m); });
    return out;
}

/// Where a side begins in a piece.
std::optional<std::size_t> side_in(const Piece& piece, std::size_t from, std::size_t to) {
    for (std::size_t i = 0; i < piece.size(); ++i) {
        if (piece[i] == from && piece[(i + 1) % piece.size()] == to) { return i; }
    }
    return std::nullopt;
}

std::vector<Piece> merged(Corners corners_m, std::vector<Piece> pieces, double tolerance_m) {
    for (const Diagonal& diagonal : diagonals_of(corners_m, pieces)) {
        const auto has = [](std::size_t from, std::size_t to) {
            return [=](const Piece& piece) { return side_in(piece, from, to).has_value(); };
        };
        const auto first = std::ranges::find_if(pieces, has(diagonal.from, diagonal.to));
        const auto second = std::ranges::find_if(pieces, has(diagonal.to, diagonal.from));
        const Piece both = joined(*first, *side_in(*first, diagonal.from, diagonal.to), *second);
        if (!corners_fault(corners_of(corners_m, both), tolerance_m)) {
            *first = both;
            pieces.erase(second);
        }
    }
    return pieces;
}

/// Each piece from its lowest place on, the pieces by that place.
void put_in_order(std::vector<Piece>& pieces) {
    for (Piece& piece : pieces) { std::rotate(piece.begin(), std::ranges::min_element(piece), piece.end()); }
    std::ranges::sort(pieces);
}

} // namespace

ConvexPieces convex_pieces(std::span<const glm::dvec3> corners_m, double tolerance_m) {
    if (const auto fault = outline_fault(corners_m)) { return {{}, *fault}; }
    const Outline outline = projected_outline(corners_m);
    const std::size_t count = corners_m.size();
    if (const auto sides = intersecting_sides(outline)) {
        return {{},
            fmt::format("expected a polygon whose sides do not meet, got the sides from corner {} to {} "
                        "and {} to {} meeting",
                sides->first + 1, (sides->first + 1) % count + 1, sides->second + 1, (sides->second + 1) % count + 1)};
    }
    ConvexPieces best;
    for (const Prefer prefer : {Prefer::High, Prefer::BesideDents}) {
        auto triangles = EarClipper(corners_m, outline, tolerance_m, prefer).triangles();
        if (!triangles) { continue; }
        std::vector<Piece> pieces = merged(corners_m, std::move(*triangles), tolerance_m);
        const bool good = std::ranges::none_of(pieces,
            [&](const Piece& piece) { return corners_fault(corners_of(corners_m, piece), tolerance_m).has_value(); });
        if (good && (best.pieces.empty() || pieces.size() < best.pieces.size())) { best.pieces = std::move(pieces); }
    }
    put_in_order(best.pieces);
    if (best.pieces.empty()) { best.fault = "expected a polygon that can be cut into convex ones, got needles only"; }
    return best;
}

} // namespace octant::models::polygons
