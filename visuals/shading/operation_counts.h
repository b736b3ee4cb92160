#pragma once

namespace octant::visuals::shading {

/// Operations of the 2008 paper, table 2 (section 4): 9 a polygon decide, then 1 for a flat and 4
/// for a smooth one.
struct OperationCounts {
    int selection = 0;  ///< 9 n
    int all_flat = 0;   ///< 9 n + n
    int all_smooth = 0; ///< 9 n + 4 n
    int hybrid = 0;     ///< 9 n + f + 4 g
};

/// For n polygons (at least 0) with g smooth ones, 0 to n.
OperationCounts operation_counts(int polygons, int smooth);

/// As the paper prints them, for 415 polygons with 9 smooth ones. Its 5408 is the 13 n of 416
/// polygons, the torus' true number: 13 x 415 = 5395.
inline constexpr OperationCounts printed_counts{
    .selection = 3735, .all_flat = 4150, .all_smooth = 5408, .hybrid = 4177};

} // namespace octant::visuals::shading
