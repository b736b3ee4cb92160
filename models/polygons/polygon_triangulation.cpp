#include "models/polygons/polygon_triangulation.h"

#include "models/polygons/projected_outline.h"

#include <glm/geometric.hpp>

#include <cassert>
#include <cmath>

namespace octant::models::polygons {

namespace {

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

} // namespace octant::models::polygons
