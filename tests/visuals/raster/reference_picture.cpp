#include "tests/visuals/raster/reference_picture.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace octant::visuals::raster {

namespace {

constexpr std::int64_t per_px = 8192;

struct Place {
    std::int64_t x = 0;
    std::int64_t y = 0;
};

/// Of a corner, from the middle of the upper left pixel.
Place place_of(const glm::vec2& at_px) {
    const auto rounded = [](float px) {
        return std::llround((static_cast<double>(px) - 0.5) * 256.0) * (per_px / 256);
    };
    return {rounded(at_px.x), rounded(at_px.y)};
}

Place sample_of(int samples, int number) {
    constexpr std::array<int, 4> four_x{-4, 12, -12, 4};
    constexpr std::array<int, 4> four_y{-12, -4, 4, 12};
    const auto place = [](int x, int y) { return Place{x * per_px / 32, y * per_px / 32}; };
    const auto i = static_cast<std::size_t>(number);
    switch (samples) {
    case 1:
        return place(0, 0);
    case 4:
        return place(four_x[i], four_y[i]);
    default:
        break;
    }
    constexpr std::array<int, 16> columns{12, 4, 7, 1, 15, 8, 3, 10, 13, 5, 0, 9, 14, 6, 2, 11};
    return place(2 * columns[i] - 15, 2 * number - 15);
}

/// Whether a place lies right of an edge, or on it.
bool is_right_of(const Place& at, Place top, Place bottom) {
    if (top.y > bottom.y) { std::swap(top, bottom); }
    return (at.x - top.x) * (bottom.y - top.y) >= (bottom.x - top.x) * (at.y - top.y);
}

/// Counts the edges left of the place: inside when one is and the other is not.
bool covers(const std::array<Place, 3>& corners, const Place& at) {
    int left = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Place& from = corners[i];
        const Place& to = corners[(i + 1) % 3];
        if ((from.y <= at.y) != (to.y <= at.y)) { left += is_right_of(at, from, to) ? 1 : 0; }
    }
    return left == 1;
}

} // namespace

std::vector<std::uint32_t> covered_by(
    const std::vector<FlatTriangle>& triangles, const glm::ivec2& size_px, int samples) {
    std::vector<std::uint32_t> seen;
    for (int y = 0; y < size_px.y; ++y) {
        for (int x = 0; x < size_px.x; ++x) {
            for (int sample = 0; sample < samples; ++sample) {
                const Place offset = sample_of(samples, sample);
                const Place at{x * per_px + offset.x, y * per_px + offset.y};
                std::uint32_t last = 0;
                for (std::uint32_t i = 0; i < triangles.size(); ++i) {
                    const auto& px = triangles[i].at_px;
                    if (covers({place_of(px[0]), place_of(px[1]), place_of(px[2])}, at)) { last = i + 1; }
                }
                seen.push_back(last);
            }
        }
    }
    return seen;
}

} // namespace octant::visuals::raster
