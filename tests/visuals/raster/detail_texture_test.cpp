#include "tests/visuals/raster/flat_plan.h"
#include "visuals/raster/tile.h"
#include "visuals/scene/detail_pattern.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

namespace octant::visuals::raster {

namespace {

constexpr glm::ivec2 picture_px{256, 192};
constexpr std::uint32_t half_and_half = 0x60808080U; ///< between the first two covers
constexpr std::uint32_t second_cover = 0x80808080U;
constexpr std::uint32_t woods_and_meadows = 0x60505050U; ///< as bright as they are under the usual sun
constexpr std::uint32_t water = 0x00808080U;
const glm::dvec3 eye_m(1234.5, -567.8, 910.1); ///< of the world, where the pattern begins at its origin

/// A place along the pattern's axes at a scale, in texels of its finest level.
glm::dvec3 texels_of(const glm::dvec3& place_m, int scale) {
    const double texels_per_m = 16.0 / std::pow(4.0, scale);
    glm::dvec3 along(0.0);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3& axis = scene::DetailPattern::axes[static_cast<std::size_t>(i)];
        along[i] = texels_per_m * (axis.x * place_m.x + axis.y * place_m.y + axis.z * place_m.z);
    }
    return along;
}

/// The eye's place in the pattern at each scale, in cubes.
std::array<glm::vec3, scene::DetailPattern::scales> places_at_eye() {
    std::array<glm::vec3, scene::DetailPattern::scales> places{};
    for (int scale = 0; scale < scene::DetailPattern::scales; ++scale) {
        places[static_cast<std::size_t>(scale)] = glm::vec3(glm::fract(texels_of(eye_m, scale) / 64.0));
    }
    return places;
}

const std::array at_eye = places_at_eye();

/// As of temperate ground.
std::shared_ptr<const scene::LandCoverContrast> woods_beside_meadows() {
    const scene::LandCover woods{glm::vec3(0.14F, 0.25F, 0.12F), 0.17F};
    const scene::LandCover meadows{glm::vec3(0.37F, 0.47F, 0.22F), 0.08F};
    return std::make_shared<const scene::LandCoverContrast>(
        std::array{woods, meadows, woods, meadows}, scene::detail_pattern(2.0));
}

std::shared_ptr<const scene::LandCoverContrast> dark_and_bright() {
    const scene::LandCover dark{glm::vec3(0.2F), 0.05F};
    const scene::LandCover bright{glm::vec3(0.6F), 0.05F};
    return std::make_shared<const scene::LandCoverContrast>(
        std::array{dark, bright, dark, bright}, scene::detail_pattern(2.0));
}

/// A slope: one over its distance in the picture's upper left corner, its changes to the others.
struct Slope {
    double at_corner;
    double across;
    double down;
    int columns = picture_px.x; ///< of the picture that are judged
    int drawn_columns = picture_px.x;

    double inverse_depth(const glm::dvec2& at_px) const {
        return at_corner + across * at_px.x / picture_px.x + down * at_px.y / picture_px.y;
    }
};

/// Falls away from the lower left corner, seen from above.
constexpr Slope gentle{1.0 / 30.0, -0.016, 0.012};
/// Its normal leans towards the west by two and a half times as much as it reaches up.
constexpr Slope steep{0.07, -0.1, 0.0, picture_px.x / 2, picture_px.x / 2 + 32};

/// The slope, cut into triangles of so many pixels.
void paint_slope(FlatPlan& plan, int cell_px, std::uint32_t colour, const Slope& slope = gentle) {
    plan.paint(sheet(
        {slope.drawn_columns, picture_px.y}, glm::ivec2(cell_px),
        [&](const glm::dvec2& at_px) { return slope.inverse_depth(at_px); }, colour));
}

void set_detail_texture(FlatPlan& plan) {
    plan.plan().detail_texture = scene::DetailTexture{at_eye, dark_and_bright()};
}

/// Where a pixel's middle sees the slope, metres from the eye.
glm::dvec3 seen_from_eye_m(const glm::dvec2& at_px, const Slope& slope) {
    const double depth_m = 1.0 / slope.inverse_depth(at_px);
    const glm::dvec2 share = at_px / glm::dvec2(picture_px) * 2.0 - 1.0;
    return {share.x * depth_m, -share.y * depth_m, -depth_m};
}

/// Where that lies in the pattern at a scale, in texels of its finest level.
glm::dvec3 texels_at(const glm::dvec3& from_eye_m, int scale) {
    return texels_of(from_eye_m, scale) + glm::dvec3(at_eye[static_cast<std::size_t>(scale)]) * 64.0;
}

/// The crowns' pattern in a level between eight texels around a place in texels of the finest one, -1 to 1.
double pattern_at(double in_level, const glm::dvec3& texels) {
    const int level = static_cast<int>(in_level);
    const int size = scene::DetailPattern::side_texels >> level;
    const glm::dvec3 at = texels / std::exp2(in_level) - 0.5;
    const glm::dvec3 low = glm::floor(at);
    const glm::dvec3 part = at - low;
    const auto within = [&](double place) {
        const auto whole = static_cast<std::int64_t>(place);
        return static_cast<int>((whole % size + size) % size);
    };
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 far(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 shares = glm::mix(1.0 - part, part, far);
        const glm::dvec3 texel = low + far;
        sum += shares.x * shares.y * shares.z *
               scene::detail_pattern(2.0).texel(
                   scene::DetailPattern::Kind::Crowns, level, {within(texel.x), within(texel.y), within(texel.z)});
    }
    return sum / 128.0 - 1.0;
}

/// Between which values the pattern at a pixel lies, up to a quarter of a level finer and coarser than the area that it
/// sees asks for.
struct Range {
    double min = 1.0;
    double max = -1.0;
};

Range pattern_around(const glm::dvec2& at_px, const Slope& slope) {
    const auto seen_from = [&](double columns, double rows) {
        return seen_from_eye_m(at_px + glm::dvec2(columns, rows), slope);
    };
    const glm::dvec3 here = seen_from(0.0, 0.0);
    const double wide_m = std::sqrt(glm::length(glm::cross(seen_from(1.0, 0.0) - here, seen_from(0.0, 1.0) - here)));
    Range range;
    for (const double off : {-0.25, 0.0, 0.25}) {
        const double level = std::clamp(std::log2(16.0 * wide_m) + off, 0.45, 13.99);
        const int scale = static_cast<int>(level / 2.0);
        const double through = level / 2.0 - scale;
        for (const double beside : {-1.0, 0.0, 1.0}) { // between two pixels it is even
            const glm::dvec3 seen = seen_from(beside, 0.0);
            const glm::dvec3 fine = texels_at(seen, scale);
            const double coarse = pattern_at(0.0, texels_at(seen, scale + 1));
            for (const double rounded : {std::floor(2.0 * through), std::ceil(2.0 * through)}) {
                const double value = pattern_at(rounded, fine) * (1.0 - through * through) +
                                     coarse * (1.0 - (1.0 - through) * (1.0 - through));
                range = {std::min(range.min, value), std::max(range.max, value)};
            }
        }
    }
    return range;
}

/// How many pixels of a slope must be dark or bright, and how many of them are not.
struct Chosen {
    int dark = 0;
    int bright = 0;
    int wrong = 0;
};

Chosen chosen_in(const scene::Picture& picture, const Slope& slope) {
    const double border = 0.35 * scene::DetailPattern::deviation;
    Chosen chosen;
    for (int y = 0; y < picture_px.y; ++y) {
        for (int x = 0; x < slope.columns; ++x) {
            const int level = pixel(picture, x, y).y;
            const Range range = pattern_around(glm::dvec2(x, y) + 0.5, slope);
            const bool is_dark = range.min > border; // the first cover, woods on real ground, are the crowns
            const bool is_bright = range.max < -border;
            chosen.bright += is_bright ? 1 : 0;
            chosen.dark += is_dark ? 1 : 0;
            chosen.wrong += (is_bright && level < 140) || (is_dark && level > 116) ? 1 : 0;
        }
    }
    return chosen;
}

/// Ground in two triangles, before it thin black blades of no cover.
void paint_blades(FlatPlan& plan, std::uint32_t ground, bool has_blades) {
    plan.paint(sheet(
        picture_px, picture_px, [](const glm::dvec2&) { return 0.1; }, ground));
    std::vector<FlatTriangle> blades;
    for (int i = 0; i < 9 && has_blades; ++i) {
        FlatTriangle blade;
        const auto y = static_cast<float>(15 + 20 * i);
        blade.at_px = {glm::vec2(10.0F, y), glm::vec2(240.0F, y + static_cast<float>(i)),
            glm::vec2(240.0F, y + 2.5F + static_cast<float>(i))};
        blade.colour.fill(0U);
        blades.push_back(blade);
    }
    plan.paint(blades);
}

scene::Picture blades_drawn(std::uint32_t ground, bool has_blades, bool has_detail_texture) {
    FlatPlan plan(picture_px);
    paint_blades(plan, ground, has_blades);
    if (has_detail_texture) { plan.plan().detail_texture = strong_detail(); }
    return drawn(plan.plan(), picture_px, 16);
}

/// Mean of the red bytes.
double mean_level(const scene::Picture& picture) {
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) { sum += picture.rgba[i]; }
    return 4.0 * sum / static_cast<double>(picture.rgba.size());
}

} // namespace

TEST_CASE("each pixel has the cover that the detail texture chooses at its place in the world") {
    for (const Slope& slope : {gentle, steep}) {
        for (const int cell_px : {8, 32}) {
            FlatPlan plan(picture_px);
            paint_slope(plan, cell_px, half_and_half, slope);
            set_detail_texture(plan);
            for (const int samples : {1, 16}) {
                const Chosen chosen = chosen_in(drawn(plan.plan(), picture_px, samples), slope);
                const int pixels = slope.columns * picture_px.y;
                CAPTURE(slope.across, cell_px, samples);
                CHECK(chosen.wrong < pixels / 500);
                CHECK(chosen.dark > pixels / 10);
                CHECK(chosen.bright > pixels / 10);
            }
        }
    }
}

TEST_CASE("the detail texture leaves the mean colour as it is, whatever the ground is mixed of") {
    constexpr int places = 64; // a picture is too small to show every feature of the pattern
    for (const std::uint32_t covers : {0x48U, 0x60U, 0x78U, 0xa0U, 0xc0U, 0xe0U}) {
        FlatPlan plan(picture_px);
        paint_slope(plan, 16, covers << 24U | 0x808080U);
        set_detail_texture(plan);
        double mean = 0.0;
        for (int place = 0; place < places; ++place) {
            for (glm::vec3& eye : plan.plan().detail_texture->at_eye) {
                eye = glm::fract(eye + glm::vec3(0.37F, 0.21F, 0.43F));
            }
            mean += mean_level(drawn(plan.plan(), picture_px, 16)) / places;
        }
        CAPTURE(covers);
        CHECK(mean == Approx(128.0).margin(3.0));
    }
}

TEST_CASE("in dense haze the detail texture is gone") {
    FlatPlan plan(picture_px);
    paint_slope(plan, 16, half_and_half);
    set_detail_texture(plan);
    plan.plan().haze = {.colour = glm::vec3(0.5F), .visibility_m = 2.0F};
    const scene::Picture picture = drawn(plan.plan(), picture_px, 16);
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) { REQUIRE(std::abs(int{picture.rgba[i]} - 128) <= 2); }
}

TEST_CASE("along a level horizon, where pixels are half sky, their half of ground shows the detail texture") {
    const auto ground_from = [&](float top, bool has_detail_texture) {
        FlatPlan plan(picture_px);
        FlatTriangle ground;
        ground.at_px = {glm::vec2(-40.0F, top), glm::vec2(300.0F, top), glm::vec2(120.0F, 500.0F)};
        ground.colour.fill(half_and_half);
        plan.paint({ground});
        if (has_detail_texture) { set_detail_texture(plan); }
        return drawn(plan.plan(), picture_px, 16);
    };
    const scene::Picture without = ground_from(40.5F, false);
    const scene::Picture half = ground_from(40.5F, true);
    const scene::Picture whole = ground_from(40.0F, true);
    int changed = 0;
    for (int x = 0; x < picture_px.x; ++x) {
        REQUIRE(pixel(without, x, 40).x == 64);
        const double change = pixel(whole, x, 40).x / 128.0 - 1.0; // of which the pixel shows its share of ground
        CHECK(pixel(half, x, 40).x == Approx(64.0 * (1.0 + 0.5 * change)).margin(1.5));
        changed += std::abs(pixel(half, x, 40).x - 64) > 4 ? 1 : 0;
    }
    CHECK(changed > picture_px.x / 2);
}

TEST_CASE(
    "a pixel shows the detail texture of the ground near its middle, whatever little of farther ground it shows") {
    const auto ridge = [&](std::uint32_t far_cover) {
        FlatPlan plan(picture_px);
        FlatTriangle far_ground;
        far_ground.at_px = {glm::vec2(-400.0F, -10.0F), glm::vec2(700.0F, -10.0F), glm::vec2(128.0F, 900.0F)};
        far_ground.depth_m.fill(80.0F);
        far_ground.colour.fill(far_cover);
        FlatTriangle near_ground = far_ground;
        near_ground.at_px = {glm::vec2(-400.0F, 40.25F), glm::vec2(700.0F, 40.25F), glm::vec2(128.0F, 900.0F)};
        near_ground.depth_m.fill(40.0F);
        near_ground.colour.fill(half_and_half);
        plan.paint({far_ground, near_ground});
        set_detail_texture(plan);
        return drawn(plan.plan(), picture_px, 16);
    };
    const scene::Picture one = ridge(half_and_half);
    const scene::Picture other = ridge(second_cover);
    int farther = 0;
    for (int x = 0; x < picture_px.x; ++x) {
        CHECK(pixel(one, x, 40) == pixel(other, x, 40));
        farther += std::abs(pixel(one, x, 38).x - pixel(other, x, 38).x) > 8 ? 1 : 0;
    }
    CHECK(farther > picture_px.x / 2);
}

TEST_CASE("the detail texture moves with the ground and does not shimmer") {
    // A wall before the eye, which moves aside by a quarter of a pixel from picture to picture.
    const float px_m = 2.0F * 40.0F / picture_px.x;
    const auto moved = [&](float px) {
        FlatPlan plan(picture_px);
        FlatTriangle wall;
        wall.at_px = {glm::vec2(-400.0F, -10.0F), glm::vec2(700.0F, -10.0F), glm::vec2(128.0F, 900.0F)};
        wall.depth_m.fill(40.0F);
        wall.colour.fill(woods_and_meadows);
        plan.paint({wall});
        set_detail_texture(plan);
        plan.plan().detail_texture->contrast = woods_beside_meadows();
        for (std::size_t scale = 0; scale < at_eye.size(); ++scale) {
            const glm::dvec3 east_m(static_cast<double>(px * px_m), 0.0, 0.0);
            const glm::dvec3 here = texels_at(glm::dvec3(0.0), static_cast<int>(scale));
            const glm::dvec3 moved_by = texels_at(east_m, static_cast<int>(scale)) - here;
            plan.plan().detail_texture->at_eye[scale] += glm::vec3(moved_by / 64.0);
        }
        return drawn(plan.plan(), picture_px, 16);
    };
    const scene::Picture first = moved(0.0F);
    const scene::Picture half = moved(0.5F);
    const scene::Picture whole = moved(1.0F);
    double by_half = 0.0;
    double by_neighbour = 0.0;
    int crawling = 0;
    for (int y = 0; y < picture_px.y; ++y) {
        for (int x = 0; x + 1 < picture_px.x; ++x) {
            const int changed = std::abs(pixel(half, x, y).x - pixel(first, x, y).x);
            by_half += changed;
            crawling += changed > 16 ? 1 : 0;
            by_neighbour += std::abs(pixel(first, x + 1, y).x - pixel(first, x, y).x);
        }
    }
    CHECK(by_neighbour > 2.0 * picture_px.x * picture_px.y);
    CHECK(by_half < 0.8 * by_neighbour);
    CHECK(crawling < picture_px.x * picture_px.y / 300);
    // Two pixels on, what was looked up at every second pixel is the same again.
    const scene::Picture twice = moved(2.0F);
    double off = 0.0;
    for (int y = 0; y < picture_px.y; ++y) {
        for (int x = 0; x + 2 < picture_px.x; ++x) { off += std::abs(pixel(twice, x, y).x - pixel(first, x + 2, y).x); }
    }
    CHECK(off < 0.05 * by_neighbour);
    CHECK((whole.rgba != first.rgba));
}

TEST_CASE("water shows none of the detail texture") {
    FlatPlan plan(picture_px);
    paint_slope(plan, 16, water);
    const scene::Picture without = drawn(plan.plan(), picture_px, 16);
    set_detail_texture(plan);
    CHECK((drawn(plan.plan(), picture_px, 16).rgba == without.rgba));
}

TEST_CASE("the detail texture is the same however finely the ground is cut") {
    FlatPlan small(picture_px);
    FlatPlan large(picture_px);
    paint_slope(small, 8, second_cover);
    paint_slope(large, 64, second_cover);
    set_detail_texture(small);
    set_detail_texture(large);
    const scene::Picture a = drawn(small.plan(), picture_px, 16);
    const scene::Picture b = drawn(large.plan(), picture_px, 16);
    int differ = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        differ += std::abs(int{a.rgba[i]} - int{b.rgba[i]}) > 4 ? 1 : 0;
    }
    CHECK(differ < picture_px.x * picture_px.y / 500);
}

TEST_CASE("the detail texture goes on from tile to tile as within one") {
    FlatPlan plan(picture_px);
    paint_slope(plan, 16, second_cover);
    set_detail_texture(plan);
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

TEST_CASE("where something covers a part of a pixel its ground keeps the colour of its cover") {
    constexpr std::uint32_t covered = 0x60808080U;
    const scene::Picture ground = blades_drawn(covered, false, true);
    const scene::Picture blades = blades_drawn(covered, true, true);
    const scene::Picture left = blades_drawn(0x00ffffffU, true, false);
    int edges = 0;
    int wrong = 0;
    for (int y = 0; y < picture_px.y; ++y) {
        for (int x = 0; x < picture_px.x; ++x) {
            const double share = pixel(left, x, y).x / 255.0;
            const double own = pixel(ground, x, y).x;
            edges += share > 0.0 && share < 1.0 ? 1 : 0;
            const double seen = pixel(blades, x, y).x;
            // The sum of ground and blade changes by the ground's share of what the ground alone would.
            const double changed = std::abs(seen - share * (128.0 + share * (own - 128.0)));
            wrong += changed > 0.1 * own + 3.0 ? 1 : 0;
        }
    }
    CHECK(edges > 1000);
    CHECK(wrong < 60);
}

} // namespace octant::visuals::raster
