#include "visuals/overlay/dial_hands.h"

#include "sim/base/units.h"

#include <algorithm>
#include <cmath>

namespace octant::visuals::overlay {

namespace {

constexpr double first_rad = rad_from_deg(-150.0);
constexpr double last_rad = rad_from_deg(150.0);

} // namespace

double scale_hand_rad(double value, const DialScale& scale) {
    const double share = (value - scale.least) / (scale.most - scale.least);
    return first_rad + std::clamp(share, 0.0, 1.0) * (last_rad - first_rad);
}

double altitude_hand_rad(double height_m, double feet_per_turn) {
    const double turns = ft_from_m(height_m) / feet_per_turn;
    return 2.0 * pi * (turns - std::floor(turns));
}

DialScale speed_scale_kt(double max_speed_mps) {
    const double max_kt = kt_from_mps(max_speed_mps);
    const double round_kt = max_kt > 400.0 ? 200.0 : 20.0;
    return {0.0, round_kt * std::max(std::ceil(max_kt / round_kt), 1.0)};
}

DialScale load_scale_g(double min_load_factor, double max_load_factor) {
    return {
        std::min(std::floor(min_load_factor), 0.0) - 1.0,
        std::max(std::ceil(max_load_factor), 1.0) + 1.0};
}

double label_step(const DialScale& scale) {
    const double max_numbers = scale.most >= 100.0 && scale.most < 400.0 ? 5.0 : 9.0;
    const double min_step = (scale.most - scale.least) / (max_numbers - 1.0);
    for (const double step : {1.0, 2.0, 5.0, 10.0, 20.0, 40.0, 100.0, 200.0, 500.0}) {
        if (step >= min_step) {
            return step;
        }
    }
    return 1000.0 * std::ceil(min_step / 1000.0);
}

} // namespace octant::visuals::overlay
