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

double altitude_hand_rad(double height_m, double feet_a_turn) {
    const double turns = ft_from_m(height_m) / feet_a_turn;
    return 2.0 * pi * (turns - std::floor(turns));
}

DialScale speed_scale_kt(double most_speed_mps) {
    const double most_kt = kt_from_mps(most_speed_mps);
    const double round_kt = most_kt > 400.0 ? 200.0 : 20.0;
    return {0.0, round_kt * std::max(std::ceil(most_kt / round_kt), 1.0)};
}

DialScale load_scale_g(double least_load_factor, double most_load_factor) {
    return {
        std::min(std::floor(least_load_factor), 0.0) - 1.0,
        std::max(std::ceil(most_load_factor), 1.0) + 1.0};
}

double number_step(const DialScale& scale) {
    const double most_numbers = scale.most >= 100.0 && scale.most < 400.0 ? 5.0 : 9.0;
    const double least_step = (scale.most - scale.least) / (most_numbers - 1.0);
    for (const double step : {1.0, 2.0, 5.0, 10.0, 20.0, 40.0, 100.0, 200.0, 500.0}) {
        if (step >= least_step) {
            return step;
        }
    }
    return 1000.0 * std::ceil(least_step / 1000.0);
}

} // namespace octant::visuals::overlay
