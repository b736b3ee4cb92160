#pragma once

#include "tests/ui/library/rays/truth_check.h"

#include <cstddef>
#include <functional>
#include <octant/octant.h>
#include <string>
#include <vector>

namespace octant::tests {

/// A world of which views are checked, with two aircraft and a refined mesh.
struct TriedWorld {
    std::string name;
    WorldSettings settings;
};

/// Hills, canyon, water, a GeoTIFF of its own, near detail with roads, houses and trees, clouds. Writes files into
/// `folder`, which exists.
std::vector<TriedWorld> tried_worlds(const std::string& folder);

/// Places of a world, east and north, where most houses, roads and runways are seen from above.
std::vector<Vec3> busy_places(const World& world);

/// View `index` of a world: near the aircraft, far from them, low over the ground, inside an aircraft's box, and from
/// high above, in turn. Every other one is at one of `busy`. The same for the same arguments.
View tried_view(const World& world, const TriedWorld& of, const std::vector<Vec3>& busy, std::size_t index);

} // namespace octant::tests
