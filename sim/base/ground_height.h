#pragma once

#include <functional>
#include <optional>

namespace octant {

/// The height of the ground at world x (east), y (north), metres; nothing outside the map.
using GroundHeight = std::function<std::optional<double>(double x_m, double y_m)>;

} // namespace octant
