#include "tests/visuals/raster/flat_plan.h"
#include "visuals/raster/tile.h"
#include "visuals/scene/grain_pattern.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::raster {

namespace {

constexpr glm::ivec2 picture_px{256, 192};
constexpr std::uint32_t grey = 0xff808080U;
constexpr std::uint32_t grey_water = 0x00808080U;
constexpr glm::vec2 at_eye{0.3F, 0.8F}; // tiles

/// One over the distance of a slope that falls away from the lower left corner.
double slope_nearness(const glm::dvec2& at_px) {
    return 1.0 / 30.0 - 0.016 * at_px.x / picture_px.x + 0.012 * at_px.y / picture_px.y;
}

/// The slope, cut into triangles of so many pixels.
void paint_slope(FlatPlan& plan, int cell_px, std::uint32_t colour) {
    std::vector<FlatTriangle> triangles;
    const auto add = [&](const std::array<glm::ivec2, 3>& at_px) {
        FlatTriangle triangle;
        triangle.colour.fill(colour);
        for (std::size_t i = 0; i < 3; ++i) {
            triangle.at_px[i] = glm::vec2(at_px[i]);
            triangle.depth_m[i] = static_cast<float>(1.0 / slope_nearness(glm::dvec2(at_px[i])));
        }
        triangles.push_back(triangle);
    };
    for (int y = 0; y < picture_px.y; y += cell_px) {
        for (int x = 0; x < picture_px.x; x += cell_px) {
            const int right = x + cell_px;
            const int below_it = y + cell_px;
            add({glm::ivec2(x, y), {right, y}, {x, below_it}});
            add({glm::ivec2(right, y), {right, below_it}, {x, below_it}});
        }
    }
    plan.paint(triangles);
}

void put_grain(FlatPlan& plan) {
    plan.plan().grain = scene::Grain{at_eye, 1e5F, 2e5F};
}

/// Where a pixel's middle sees the slope, in texels of the finest level.
glm::dvec2 place_of(const glm::dvec2& at_px) {
    const double depth_m = 1.0 / slope_nearness(at_px);
    const glm::dvec2 share = at_px / glm::dvec2(picture_px) * 2.0 - 1.0;
    const glm::dvec3 at_m(share.x * depth_m, -share.y * depth_m, -depth_m);
    using scene::GrainPattern;
    const glm::dvec2 level_m = glm::dvec2(at_m) + glm::dvec2(GrainPattern::lean) * at_m.z;
    return level_m * static_cast<double>(GrainPattern::texels_per_m) +
           glm::dvec2(at_eye) * static_cast<double>(GrainPattern::texels_a_side);
}

/// The pattern between the four texels around a place, -1 to 1.
double pattern_at(const scene::GrainPattern& level, const glm::dvec2& texels) {
    const glm::dvec2 at = texels - 0.5;
    const glm::dvec2 low = glm::floor(at);
    const auto texel = [&](int right, int up) {
        const auto within = [&](double place) {
            const auto whole = static_cast<std::int64_t>(place);
            return static_cast<std::size_t>((whole % level.size + level.size) % level.size);
        };
        const std::size_t row = within(low.y + up);
        return level.texels[row * static_cast<std::size_t>(level.size) + within(low.x + right)];
    };
    const glm::dvec2 part = at - low;
    const double south = texel(0, 0) * (1.0 - part.x) + texel(1, 0) * part.x;
    const double north = texel(0, 1) * (1.0 - part.x) + texel(1, 1) * part.x;
    return (south * (1.0 - part.y) + north * part.y) / 128.0 - 1.0;
}

/// What a pixel shows of grey ground: the pattern at the level of what it sees, up to a level finer
/// and a level coarser.
struct Shown {
    double least = 255.0;
    double most = 0.0;
};

Shown shown_at(const std::vector<scene::GrainPattern>& levels, const glm::dvec2& at_px) {
    const glm::dvec2 here = place_of(at_px);
    const double across = glm::length(place_of(at_px + glm::dvec2(1.0, 0.0)) - here);
    const double down = glm::length(place_of(at_px + glm::dvec2(0.0, 1.0)) - here);
    const double level = std::log2(std::max(std::max(across, down), 1.0));
    const auto first = static_cast<std::size_t>(std::max(level - 1.0, 0.0));
    Shown shown;
    for (std::size_t k = first; k < first + 4 && k < levels.size(); ++k) {
        for (const double beside : {-1.0, 0.0, 1.0}) { // between two pixels it is even
            const glm::dvec2 place = place_of(at_px + glm::dvec2(beside, 0.0));
            const double grain = pattern_at(levels[k], place / std::exp2(static_cast<double>(k)));
            const double value =
                128.0 * (1.0 + static_cast<double>(scene::GrainPattern::most_share) * grain);
            shown.least = std::min(shown.least, value);
            shown.most = std::max(shown.most, value);
        }
    }
    return shown;
}

} // namespace

TEST_CASE("the fine pattern lies on the ground where its place in the world says") {
    std::vector<scene::GrainPattern> levels{scene::grain_pattern()};
    while (levels.back().size > 4) {
        levels.push_back(half_of(levels.back()));
    }
    for (const int cell_px : {8, 48}) {
        FlatPlan plan(picture_px);
        paint_slope(plan, cell_px, grey);
        put_grain(plan);
        for (const int samples : {1, 16}) {
            const scene::Picture picture = drawn(plan.plan(), picture_px, samples);
            int beyond = 0;
            int darkest = 255;
            int brightest = 0;
            for (int y = 0; y < picture_px.y; ++y) {
                for (int x = 0; x < picture_px.x; ++x) {
                    const int level = pixel(picture, x, y).y;
                    const Shown shown = shown_at(levels, glm::dvec2(x, y) + 0.5);
                    beyond += level < shown.least - 2.0 || level > shown.most + 2.0 ? 1 : 0;
                    darkest = std::min(darkest, level);
                    brightest = std::max(brightest, level);
                }
            }
            CAPTURE(cell_px, samples);
            CHECK(beyond < picture_px.x * picture_px.y / 200);
            CHECK(darkest < 110);
            CHECK(brightest > 146);
        }
    }
}

TEST_CASE("ground whose corners have no share of the fine pattern shows none") {
    FlatPlan plan(picture_px);
    paint_slope(plan, 16, grey_water);
    const scene::Picture without = drawn(plan.plan(), picture_px, 16);
    put_grain(plan);
    CHECK((drawn(plan.plan(), picture_px, 16).rgba == without.rgba));
}

TEST_CASE("the fine pattern is the same however finely the ground is cut") {
    FlatPlan small(picture_px);
    FlatPlan large(picture_px);
    paint_slope(small, 8, grey);
    paint_slope(large, 64, grey);
    put_grain(small);
    put_grain(large);
    const scene::Picture a = drawn(small.plan(), picture_px, 16);
    const scene::Picture b = drawn(large.plan(), picture_px, 16);
    int differ = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        differ += std::abs(int{a.rgba[i]} - int{b.rgba[i]}) > 4 ? 1 : 0;
    }
    CHECK(differ < picture_px.x * picture_px.y / 500);
}

TEST_CASE("the fine pattern goes on from tile to tile as within one") {
    FlatPlan plan(picture_px);
    paint_slope(plan, 16, grey);
    put_grain(plan);
    const scene::Picture picture = drawn(plan.plan(), picture_px, 16);
    // From the last column of a tile to the first of the next, and between others like it.
    const auto mean_change = [&](int first_column) {
        int sum = 0;
        int count = 0;
        for (int x = first_column; x + 1 < picture_px.x; x += tile_width) {
            for (int y = 0; y < picture_px.y; ++y) {
                sum += std::abs(pixel(picture, x + 1, y).x - pixel(picture, x, y).x);
                ++count;
            }
        }
        return static_cast<double>(sum) / count;
    };
    const double within = 0.5 * (mean_change(tile_width - 3) + mean_change(tile_width / 2 - 1));
    CHECK(mean_change(tile_width - 1) < 1.3 * within);
    CHECK(mean_change(tile_width - 2) > 0.7 * within);
}

} // namespace octant::visuals::raster
