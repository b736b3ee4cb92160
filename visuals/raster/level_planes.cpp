#include "visuals/raster/level_planes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace octant::visuals::raster {

namespace {

constexpr double fraction = 65536.0; ///< of Levels::base
constexpr float middle = 128.0F;     ///< level that Levels count from

std::int32_t rounded(double value) {
    return static_cast<std::int32_t>(value + (value < 0.0 ? -0.5 : 0.5));
}

std::int16_t limit(float level) {
    return static_cast<std::int16_t>(rounded(static_cast<double>((level - middle) * 128.0F)));
}

} // namespace

Levels levels_between(
    const std::array<const ScreenVertex*, 3>& corners,
    double doubled_area,
    std::size_t count,
    double most_per_px) {
    const auto& [a, b, c] = corners;
    const double to_px = ScreenVertex::per_px / doubled_area;
    const double b_x = (b->x - a->x) * to_px;
    const double b_y = (b->y - a->y) * to_px;
    const double c_x = (c->x - a->x) * to_px;
    const double c_y = (c->y - a->y) * to_px;
    Levels levels;
    for (std::size_t i = 0; i < count; ++i) {
        const float at_a = a->value[i];
        const float at_b = b->value[i];
        const float at_c = c->value[i];
        levels.least[i] = limit(std::min(std::min(at_a, at_b), at_c));
        levels.most[i] = limit(std::max(std::max(at_a, at_b), at_c));
        const auto to_b = static_cast<double>(at_b - at_a);
        const auto to_c = static_cast<double>(at_c - at_a);
        const double per_x = to_b * c_y - to_c * b_y;
        const double per_y = to_c * b_x - to_b * c_x;
        if (std::abs(per_x) > most_per_px || std::abs(per_y) > most_per_px) {
            const auto mean = static_cast<double>((at_a + at_b + at_c) / 3.0F - middle);
            levels.base[i] = rounded(mean * fraction);
            continue;
        }
        levels.per_x[i] = rounded(per_x * fraction);
        levels.per_y[i] = rounded(per_y * fraction);
        levels.per_column[i] = static_cast<std::int16_t>((levels.per_x[i] + 256) >> 9);
        const std::int64_t from_origin =
            (std::int64_t{levels.per_x[i]} * a->x + std::int64_t{levels.per_y[i]} * a->y) >> 8;
        levels.base[i] = static_cast<std::int32_t>(
            rounded(static_cast<double>(at_a - middle) * fraction) - from_origin); // wraps
    }
    return levels;
}

Levels even_levels(const std::array<float, 3>& rgb) {
    Levels levels;
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        levels.base[i] = rounded(static_cast<double>(rgb[i] - middle) * fraction);
        levels.least[i] = limit(rgb[i]);
        levels.most[i] = levels.least[i];
    }
    return levels;
}

} // namespace octant::visuals::raster
