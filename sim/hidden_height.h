#pragma once

namespace octant::sim {

/// The height of an aircraft that is not there, as one whose track has ended or that nobody flies: so far below any
/// ground that no view shows it.
inline constexpr double absent_height_m = -1e5;

/// Whether an aircraft at this height is not there, and nothing of it is to be drawn.
inline bool is_absent_height(double height_m) { return height_m <= absent_height_m; }

} // namespace octant::sim
