#include "visuals/terrain/resolution_for_target.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::visuals::terrain {

double resolution_for_target(QuadtreeMesher& mesher, const MeshView& view, const QuadtreeDetail& detail,
    double target_triangles, double max_resolution) {
    double low = mesher.tree().options().min_resolution;
    double high = std::max(max_resolution, low);
    double best = low;
    double best_miss = std::numeric_limits<double>::infinity();
    const auto too_many = [&](double resolution) {
        QuadtreeDetail tried = detail;
        tried.resolution = resolution;
        const double over = mesher.count(view, tried).counters.triangles - target_triangles;
        if (std::abs(over) < best_miss) {
            best_miss = std::abs(over);
            best = resolution;
        }
        return over > 0.0;
    };
    if (too_many(low) || !too_many(high)) { return best; }
    for (int step = 0; step < 22 && best_miss > 0.0; ++step) {
        const double middle = std::sqrt(low * high);
        (too_many(middle) ? high : low) = middle;
    }
    return best;
}

double triangle_count_slope(QuadtreeMesher& mesher, const MeshView& view, const QuadtreeDetail& detail) {
    constexpr double share = 0.02;
    QuadtreeDetail nearby_detail = detail;
    nearby_detail.resolution = detail.resolution * (1.0 + share);
    const int more = mesher.count(view, nearby_detail).counters.triangles;
    nearby_detail.resolution = detail.resolution * (1.0 - share);
    const int fewer = mesher.count(view, nearby_detail).counters.triangles;
    return (more - fewer) / (2.0 * share * detail.resolution);
}

} // namespace octant::visuals::terrain
