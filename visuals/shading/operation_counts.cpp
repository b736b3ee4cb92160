// Operations of H. Kim, H. Park, "A Hybrid Rendering Model to support LOD (Level of Detail)", 2008, section 4 and table
// 2. Deviations: the printed 5408 for all smooth is (9 + 4) x 416; its row says (9 + 4) x 415 = 5395.
#include "visuals/shading/operation_counts.h"

#include <cassert>

namespace octant::visuals::shading {

OperationCounts operation_counts(int polygons, int smooth) {
    assert(smooth >= 0 && smooth <= polygons);
    const int selection = 9 * polygons;
    return {.selection = selection,
        .all_flat = selection + polygons,
        .all_smooth = selection + 4 * polygons,
        .hybrid = selection + (polygons - smooth) + 4 * smooth};
}

} // namespace octant::visuals::shading
