#include "visuals/scene/model_display.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace octant::visuals::scene {

std::uint32_t level_colour(double error_m, double radius_m) {
    // Neighbours differ much; the tenth halving looks as the first, a thousand times as wrong.
    constexpr std::array<std::uint32_t, 9> colours{0xff4040e0U, 0xff30a0f8U, 0xff40e0f0U, 0xff50c850U, 0xffc8c030U,
        0xfff09040U, 0xffe050a0U, 0xffa0a0a0U, 0xff6070a8U};
    if (!(error_m > 0.0) || !(radius_m > 0.0)) { return 0xffffffffU; }
    const double halvings = std::floor(-std::log2(error_m / radius_m));
    const double turns = std::floor(halvings / colours.size());
    return colours[static_cast<std::size_t>(halvings - turns * colours.size())];
}

} // namespace octant::visuals::scene
