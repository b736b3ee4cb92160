#include "models/polygons/distinct_polygons.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>

namespace octant::models::polygons {

namespace {

/// What two polygons have in common where one repeats the other: the part that turns them, and the places of their
/// corners from the least one on.
struct Key {
    std::uint32_t turns_with = 0; ///< 0: nothing
    std::vector<std::array<double, 3>> places;

    auto operator<=>(const Key&) const = default;
};

Key key_of(const PolygonModel& model, std::size_t polygon) {
    Key key;
    const auto pivot = pivot_of(model, polygon);
    key.turns_with = pivot ? *pivot + 1 : 0;
    for (const std::uint32_t vertex : model.corners(polygon)) {
        const glm::dvec3& at = model.vertices_m[vertex];
        key.places.push_back({at.x + 0.0, at.y + 0.0, at.z + 0.0}); // no negative zeros
    }
    std::rotate(key.places.begin(), std::ranges::min_element(key.places), key.places.end());
    return key;
}

} // namespace

std::vector<std::uint32_t> distinct_polygons(const PolygonModel& model) {
    std::map<Key, std::uint32_t> last;
    for (std::uint32_t polygon = 0; polygon < model.polygons.size(); ++polygon) {
        last.insert_or_assign(key_of(model, polygon), polygon);
    }
    std::vector<std::uint32_t> kept;
    for (const auto& [key, polygon] : last) { kept.push_back(polygon); }
    std::ranges::sort(kept);
    return kept;
}

} // namespace octant::models::polygons
