#include "visuals/terrain/loop_gain.h"

namespace octant::visuals::terrain {

double triangles_gained(Mesher& mesher, const MeshView& view, const Detail& detail) {
    constexpr double share = 0.02;
    Detail beside = detail;
    beside.resolution = detail.resolution * (1.0 + share);
    const int more = mesher.mesh(view, beside).counters.triangles;
    beside.resolution = detail.resolution * (1.0 - share);
    const int fewer = mesher.mesh(view, beside).counters.triangles;
    return (more - fewer) / (2.0 * share * detail.resolution);
}

} // namespace octant::visuals::terrain
