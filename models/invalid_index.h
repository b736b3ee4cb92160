#pragma once

#include <cstdint>
#include <limits>

namespace octant::models {

/// Stands for no normal, no material or no vertex.
inline constexpr std::uint32_t invalid_index = std::numeric_limits<std::uint32_t>::max();

} // namespace octant::models
