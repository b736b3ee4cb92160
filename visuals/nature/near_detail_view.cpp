#include "visuals/nature/near_detail_view.h"

#include "sim/base/units.h"

#include <algorithm>
#include <cmath>

namespace octant::visuals::nature {

namespace {

constexpr double default_edge_rad = 0.08;
constexpr double default_edge_px = 70.0; ///< the same in 720 lines over 45 degrees
constexpr double min_edge_rad = 0.02;
constexpr double default_width_rad = 1.4;
/// Halvings over those that even level ground takes: slopes, edges of the picture.
constexpr double slope_allowance = 1.3;
constexpr double base_splits = 500.0; ///< halvings of large level triangles, wherever the eye is
constexpr double default_scenery_triangles = 4000.0;
constexpr std::size_t unlimited_scenery_triangles = 100'000; ///< more than there can be
constexpr double scenery_max_height_m = 900.0;               ///< of the eye over the ground

} // namespace

/// Of level ground between two distances, triangles whose edges look a long take 2 width / a^2 ln(far / near): each
/// covers a^2 / 2 times the square of its distance.
void apply_detail_budget(const DetailBudget& budget, const NearDetailOptions& detail, NearDetailView& view) {
    const double share = std::clamp(budget.share.value_or(1.0), 0.005, 2.0);
    const double wide = std::clamp(budget.width_rad / default_width_rad, 0.01, 2.0);
    const double edge_rad = budget.share ? default_edge_rad * std::sqrt(wide / share)
                                         : std::max(default_edge_px / budget.focal_px, min_edge_rad);
    view.min_edge_rad = static_cast<float>(edge_rad);
    const double to_m = 1.42 * view.spacing_m / edge_rad;
    const double from_m =
        std::max(budget.height_above_ground_m, static_cast<double>(min_split_edge_ratio) * view.spacing_m / edge_rad);
    const double width_rad = budget.share ? budget.width_rad : 2.0 * pi;
    const double level = 2.0 * width_rad / (edge_rad * edge_rad) * std::log(std::max(to_m / from_m, 1.0));
    const double splits = slope_allowance * level + base_splits * share;
    view.max_splits = detail.has_subdivision ? static_cast<std::size_t>(splits) : 0;
    const double low = std::clamp(1.2 - budget.height_above_ground_m / scenery_max_height_m, 0.0, 1.0);
    const double things = default_scenery_triangles * share * low;
    view.max_scenery_triangles = !detail.scenery ? 0
                                 : budget.share  ? static_cast<std::size_t>(things)
                                                 : unlimited_scenery_triangles;
    view.range_ratio = static_cast<float>(std::sqrt(std::min(share, 1.0)));
}

} // namespace octant::visuals::nature
