#include "visuals/nature/fine_view.h"

#include "sim/base/units.h"

#include <algorithm>
#include <cmath>

namespace octant::visuals::nature {

namespace {

constexpr double usual_edge_rad = 0.08;
constexpr double usual_edge_px = 70.0; ///< the same in 720 lines over 45 degrees
constexpr double min_edge_rad = 0.02;
constexpr double usual_width_rad = 1.4;
/// Halvings over those that even level ground takes: slopes, edges of the picture.
constexpr double more_than_level = 1.3;
constexpr double always = 500.0; ///< halvings of large level triangles, wherever the eye is
constexpr double usual_things = 4000.0;
constexpr std::size_t any_things = 100'000; ///< more than there can be
constexpr double things_below_m = 900.0;    ///< of the eye over the ground

} // namespace

/// Of level ground between two distances, triangles whose edges look a long take
/// 2 width / a^2 ln(far / near): each covers a^2 / 2 times the square of its distance.
void share_out_detail(const DetailRoom& room, const NearDetail& detail, FineView& view) {
    const double share = std::clamp(room.share.value_or(1.0), 0.005, 2.0);
    const double wide = std::clamp(room.width_rad / usual_width_rad, 0.01, 2.0);
    const double edge_rad = room.share ? usual_edge_rad * std::sqrt(wide / share)
                                       : std::max(usual_edge_px / room.focal_px, min_edge_rad);
    view.long_rad = static_cast<float>(edge_rad);
    const double to_m = 1.42 * view.spacing_m / edge_rad;
    const double from_m =
        std::max(room.over_m, static_cast<double>(min_fine_edge) * view.spacing_m / edge_rad);
    const double width_rad = room.share ? room.width_rad : 2.0 * pi;
    const double level =
        2.0 * width_rad / (edge_rad * edge_rad) * std::log(std::max(to_m / from_m, 1.0));
    const double splits = more_than_level * level + always * share;
    view.max_splits = detail.fine_ground ? static_cast<std::size_t>(splits) : 0;
    const double low = std::clamp(1.2 - room.over_m / things_below_m, 0.0, 1.0);
    const double things = usual_things * share * low;
    view.max_things = !detail.scenery ? 0
                       : room.share    ? static_cast<std::size_t>(things)
                                       : any_things;
    view.reach_share = static_cast<float>(std::sqrt(std::min(share, 1.0)));
}

} // namespace octant::visuals::nature
