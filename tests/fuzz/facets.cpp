// What a ray meets, worked out from a polygon's corners alone, in long double. Shares nothing with the builder of
// orders, so that an error of one is not an error of both.
#include "tests/fuzz/facets.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace octant::tests::fuzz {

namespace {

using models::polygons::PolygonModel;

/// Half a unit in the last place of numbers between 1 and 2.
constexpr long double half_ulp = 0x1p-53L;
/// Planes and places of polygons narrower than this (sizes) are not known: they are not hit.
constexpr long double min_width_sizes = 1e-12L;
/// Of polygons with more corners not all triples are looked at.
constexpr std::size_t max_corners_leaning = 64;

void measure(Facets& facets, const PolygonModel& model) {
    glm::dvec3 least = model.vertices_m[model.corner_vertices[0]];
    glm::dvec3 most = least;
    for (const std::uint32_t vertex : model.corner_vertices) {
        for (int axis = 0; axis < 3; ++axis) {
            least[axis] = std::min(least[axis], model.vertices_m[vertex][axis]);
            most[axis] = std::max(most[axis], model.vertices_m[vertex][axis]);
        }
    }
    facets.middle_m = (Vec(least) + Vec(most)) / 2.0L;
    facets.size_m = glm::length(Vec(most) - Vec(least));
    for (int axis = 0; axis < 3; ++axis) {
        const double farthest = std::max(std::abs(least[axis]), std::abs(most[axis]));
        facets.noise_m = std::max(facets.noise_m, half_ulp * 2.0L * farthest);
    }
}

Vec double_area(const std::vector<Vec>& corners) {
    Vec sum(0.0L);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return sum;
}

Facet facet_of(std::vector<Vec> corners, long double min_width_m) {
    Facet facet;
    facet.corners = std::move(corners);
    long double round_m = 0.0L;
    const std::size_t count = facet.corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        facet.middle += facet.corners[i] / static_cast<long double>(count);
        round_m += glm::distance(facet.corners[i], facet.corners[(i + 1) % count]);
    }
    for (const Vec& corner : facet.corners) {
        facet.radius_m = std::max(facet.radius_m, glm::distance(corner, facet.middle));
    }
    const Vec area = double_area(facet.corners);
    const long double width_m = round_m > 0.0L ? glm::length(area) / round_m : 0.0L;
    if (width_m <= min_width_m) { return facet; }
    facet.normal = glm::normalize(area);
    facet.tilt = 1.0L / width_m;
    for (const Vec& corner : facet.corners) {
        facet.bend_m = std::max(facet.bend_m, std::abs(glm::dot(corner - facet.middle, facet.normal)));
    }
    return facet;
}

/// The largest angle, radians, between a bent polygon's plane and that of three of its corners: pieces of it may lean
/// so far. Three that are narrower than the slack lean as they like; what they show is within the slack of a side.
long double lean_of(const Facet& facet) {
    long double lean = 0.0L;
    const auto& at = facet.corners;
    for (std::size_t i = 0; i < at.size(); ++i) {
        for (std::size_t j = i + 1; j < at.size(); ++j) {
            for (std::size_t k = j + 1; k < at.size(); ++k) {
                const Vec area = glm::cross(at[j] - at[i], at[k] - at[i]);
                const long double round_m =
                    glm::distance(at[i], at[j]) + glm::distance(at[j], at[k]) + glm::distance(at[k], at[i]);
                const long double length = glm::length(area);
                if (length > facet.slack_m * round_m) {
                    const long double cosine = glm::dot(area, facet.normal) / length;
                    lean = std::max(lean, std::acos(std::clamp(cosine, -1.0L, 1.0L)));
                }
            }
        }
    }
    return lean;
}

/// How far a point of a facet's plane lies inside its outline; negative outside. Measured to the sides themselves: the
/// line of a side as short as rounding has any direction, and goes anywhere.
long double inside_of(const Facet& facet, const Vec& place) {
    const Vec steep = glm::abs(facet.normal);
    const int across = steep.x > steep.y && steep.x > steep.z ? 0 : (steep.y > steep.z ? 1 : 2);
    const int u = (across + 1) % 3;
    const int v = (across + 2) % 3;
    bool inside = false;
    long double nearest_m2 = std::numeric_limits<long double>::infinity();
    const std::size_t count = facet.corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Vec from = facet.corners[i] - place;
        const Vec to = facet.corners[(i + 1) % count] - place;
        const Vec along = to - from;
        if ((from[v] > 0.0L) != (to[v] > 0.0L)) { inside = inside != (from[u] - along[u] * from[v] / along[v] > 0.0L); }
        const long double length2 = glm::dot(along, along);
        const long double share = length2 > 0.0L ? std::clamp(-glm::dot(from, along) / length2, 0.0L, 1.0L) : 0.0L;
        const Vec nearest = from + along * share;
        nearest_m2 = std::min(nearest_m2, glm::dot(nearest, nearest));
    }
    return std::sqrt(nearest_m2) * (inside ? 1.0L : -1.0L);
}

/// Adds to the slack of each facet the largest bend of the facets that meet it at a corner.
void spread_bends(Facets& facets) {
    std::map<std::array<long double, 3>, long double> at;
    const auto place = [](const Vec& corner) { return std::array{corner.x, corner.y, corner.z}; };
    for (const Facet& facet : facets.all) {
        for (const Vec& corner : facet.corners) {
            long double& bend_m = at[place(corner)];
            bend_m = std::max(bend_m, facet.bend_m);
        }
    }
    for (Facet& facet : facets.all) {
        long double bend_m = facet.bend_m;
        for (const Vec& corner : facet.corners) { bend_m = std::max(bend_m, at[place(corner)]); }
        facet.slack_m += bend_m;
    }
}

} // namespace

Facets facets_of(const PolygonModel& model, long double slack_sizes, bool bends_spread) {
    Facets facets;
    measure(facets, model);
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        std::vector<Vec> corners;
        for (const std::uint32_t vertex : model.corners(i)) {
            corners.push_back(Vec(model.vertices_m[vertex]) - facets.middle_m);
        }
        facets.all.push_back(facet_of(std::move(corners), min_width_sizes * facets.size_m));
        Facet& facet = facets.all.back();
        facet.slack_m = facet.bend_m + 2.0L * facets.noise_m + slack_sizes * facets.size_m;
    }
    if (bends_spread) { spread_bends(facets); }
    for (Facet& facet : facets.all) {
        facet.tilt *= facet.slack_m;
        if (bends_spread && facet.bend_m > 2.0L * facets.noise_m && facet.corners.size() <= max_corners_leaning) {
            facet.tilt = std::max(facet.tilt, lean_of(facet));
        }
    }
    return facets;
}

Hit meet(const Facet& facet, const Vec& eye, const Vec& ray) {
    const Vec to_middle = facet.middle - eye;
    const long double along_m = glm::dot(to_middle, ray);
    const long double aside_m2 = glm::dot(to_middle, to_middle) - along_m * along_m;
    const long double reach_m = facet.radius_m + 4.0L * facet.slack_m;
    if (facet.normal == Vec(0.0L) || aside_m2 > reach_m * reach_m * 1.001L || along_m < -reach_m) { return {}; }
    const long double height_m = -glm::dot(to_middle, facet.normal);
    const long double doubt_m = facet.slack_m + facet.tilt * glm::length(to_middle);
    const long double slope = -glm::dot(ray, facet.normal);
    if (height_m < -doubt_m || slope < -2.0L * facet.tilt) { return {}; }
    if (height_m <= doubt_m || slope <= 2.0L * facet.tilt) {
        return {Meeting::Doubtful, std::max(along_m - reach_m, 0.0L), 2.0L * reach_m};
    }
    const long double depth_m = height_m / slope;
    const long double slant_m = facet.slack_m / slope;
    const long double inside_m = inside_of(facet, eye + ray * depth_m);
    if (inside_m < -slant_m) { return {}; }
    return {inside_m > slant_m ? Meeting::Hit : Meeting::Doubtful, depth_m, slant_m};
}

bool passes_side(const Facet& facet, const Vec& eye, const Vec& ray) {
    const auto beside = [&](const Vec& point) {
        const Vec to = point - eye;
        return to - ray * glm::dot(to, ray);
    };
    for (std::size_t i = 0; i < facet.corners.size(); ++i) {
        const Vec from = beside(facet.corners[i]);
        const Vec along = beside(facet.corners[(i + 1) % facet.corners.size()]) - from;
        const long double length2 = glm::dot(along, along);
        const long double share = length2 > 0.0L ? std::clamp(-glm::dot(from, along) / length2, 0.0L, 1.0L) : 0.0L;
        if (glm::length(from + along * share) <= facet.slack_m) { return true; }
    }
    return false;
}

bool same_plane(const Facet& a, const Facet& b, long double within_m) {
    if (glm::dot(a.normal, b.normal) <= 0.0L) { return false; }
    const auto in_plane = [&](const Facet& plane, const Facet& other) {
        return std::ranges::all_of(other.corners,
            [&](const Vec& corner) { return std::abs(glm::dot(corner - plane.middle, plane.normal)) <= within_m; });
    };
    return in_plane(a, b) && in_plane(b, a);
}

} // namespace octant::tests::fuzz
