#include "visuals/raster/even_texture.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace octant::visuals::raster {

namespace {

constexpr double steps_per_px = ScreenVertex::per_px;

/// Thinner triangles have gradients of rounding alone, 1/256 pixel.
constexpr double least_thickness = 16.0;

using Corners = std::array<const ScreenVertex*, 3>;

/// From the first corner to another, 1/256 pixel.
glm::dvec2 way(const Corners& corners, std::size_t to) {
    return {corners[to]->x - corners[0]->x, corners[to]->y - corners[0]->y};
}

double step(const Corners& corners, std::size_t to, std::size_t i) {
    return static_cast<double>(corners[to]->value[i]) - static_cast<double>(corners[0]->value[i]);
}

struct Range {
    float least;
    float most;

    Range(float a, float b, float c)
        : least(std::min(std::min(a, b), c))
        , most(std::max(std::max(a, b), c)) {}

    double size() const { return static_cast<double>(most) - static_cast<double>(least); }
};

double range(const Corners& corners, std::size_t i) {
    return Range(corners[0]->value[i], corners[1]->value[i], corners[2]->value[i]).size();
}

/// How many texels a pixel is wide, squared.
double footprint2(const Corners& corners) {
    const glm::dvec2 b = way(corners, 1);
    const glm::dvec2 c = way(corners, 2);
    const double area = b.x * c.y - b.y * c.x;
    const double reach =
        std::max(std::max(std::abs(b.x), std::abs(c.x)), std::max(std::abs(b.y), std::abs(c.y)));
    if (std::abs(area) < least_thickness * reach) {
        const double steps = std::max(range(corners, 0), range(corners, 1)) * steps_per_px / reach;
        return steps * steps;
    }
    double across2 = 0.0;
    double down2 = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        const double to_b = step(corners, 1, i);
        const double to_c = step(corners, 2, i);
        const double across = to_b * c.y - to_c * b.y;
        const double down = to_c * b.x - to_b * c.x;
        across2 += across * across;
        down2 += down * down;
    }
    const double by_area = steps_per_px / area;
    return std::max(across2, down2) * by_area * by_area;
}

/// How far exact values lie beyond even ones: from the least to the most, at the corners (0) and at
/// the edges' middles, where they differ most.
struct Bend {
    double least = 0.0;
    double most = 0.0;

    void add(double difference) {
        least = std::min(least, difference);
        most = std::max(most, difference);
    }

    double middle() const { return 0.5 * (least + most); }

    double reach() const { return 0.5 * (most - least); }
};

/// How perspective bends each of the four values along a triangle's edges.
std::array<Bend, 4> bends(const Corners& corners) {
    std::array<Bend, 4> result;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const ScreenVertex& from = *corners[k];
        const ScreenVertex& to = *corners[k + 1 < corners.size() ? k + 1 : 0];
        const double share = static_cast<double>(to.inverse_w - from.inverse_w) /
                             (2.0 * static_cast<double>(to.inverse_w + from.inverse_w));
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i].add(static_cast<double>(to.value[i] - from.value[i]) * share);
        }
    }
    return result;
}

} // namespace

std::optional<EvenTexture> even_texture(const Corners& corners, std::size_t level_count) {
    const std::array<Bend, 4> bent = bends(corners);
    if (bent[2].most - bent[2].least > EvenTexture::most_share_wrong ||
        bent[3].most - bent[3].least > EvenTexture::most_share_wrong) {
        return std::nullopt;
    }
    EvenTexture result;
    result.levels = levels_of(footprint2(corners), level_count);
    const double scale = 1.0 / static_cast<double>(std::uint64_t{1} << result.levels.fine);
    if (std::max(bent[0].reach(), bent[1].reach()) * scale > EvenTexture::most_texels_wrong) {
        return std::nullopt;
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
        ScreenVertex& corner = result.corners[k];
        corner = *corners[k];
        for (std::size_t i = 0; i < 2; ++i) {
            const double place = static_cast<double>(corner.value[i]) + bent[i].middle();
            corner.value[i] = static_cast<float>((place + 0.5) * scale - 0.5);
            corner.value[2 + i] *= EvenTexture::whole_share;
        }
    }
    return result;
}

} // namespace octant::visuals::raster
