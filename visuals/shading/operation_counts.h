#pragma once

namespace octant::visuals::shading {

/// Operation counts as the 2008 paper has them in section 4 and table 2: every polygon costs 9 operations for the
/// choice, then 1 when it is flat and 4 when it is smooth. n is the number of polygons, g of smooth ones, f = n - g of
/// flat ones.
struct OperationCounts {
    int selection = 0;  ///< 9 n
    int all_flat = 0;   ///< 9 n + n
    int all_smooth = 0; ///< 9 n + 4 n
    int hybrid = 0;     ///< 9 n + f + 4 g
};

/// The counts for n polygons (at least 0) of which g (0 to n, asserted) are smooth.
OperationCounts operation_counts(int polygons, int smooth);

/// The row that the paper prints for 415 polygons with 9 smooth ones. Its 5408 is 13 x 416, for the torus has 416
/// polygons; 13 x 415 would be 5395.
inline constexpr OperationCounts paper_counts{.selection = 3735, .all_flat = 4150, .all_smooth = 5408, .hybrid = 4177};

} // namespace octant::visuals::shading
