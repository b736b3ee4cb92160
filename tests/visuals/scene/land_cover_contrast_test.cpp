#include "visuals/scene/detail_pattern.h"
#include "visuals/scene/land_cover_contrast.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

namespace {

constexpr LandCover wood{glm::vec3(0.14F, 0.25F, 0.12F), 0.17F};
constexpr LandCover meadow{glm::vec3(0.37F, 0.47F, 0.22F), 0.08F};
constexpr LandCover rock{glm::vec3(0.47F, 0.44F, 0.41F), 0.15F};
constexpr LandCover snow{glm::vec3(0.93F, 0.94F, 0.96F), 0.03F};

const DetailPattern& pattern() { return detail_pattern(2.0); }

/// All texels of a level.
std::vector<std::uint8_t> texels_of(const DetailPattern& from, DetailPattern::Kind kind, int level) {
    const int size = DetailPattern::side_texels >> level;
    std::vector<std::uint8_t> texels;
    for (int z = 0; z < size; ++z) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) { texels.push_back(from.texel(kind, level, {x, y, z})); }
        }
    }
    return texels;
}

constexpr std::array both_kinds = {DetailPattern::Kind::Open, DetailPattern::Kind::Crowns};

/// How often the pattern has a value within an entry, by the texels themselves.
std::array<double, LandCoverContrast::pattern_step_count> share_of_patterns() {
    std::array<double, LandCoverContrast::pattern_step_count> shares{};
    const auto texels = texels_of(pattern(), DetailPattern::Kind::Crowns, 0);
    for (const std::uint8_t texel : texels) { shares[texel / 4U] += 1.0 / static_cast<double>(texels.size()); }
    return shares;
}

/// Red, green and blue.
glm::vec3 shares_at(const LandCoverContrast& contrast, int kind, int pattern) {
    const std::uint32_t entry =
        contrast.table()[static_cast<std::size_t>(kind * LandCoverContrast::pattern_step_count + pattern)];
    const auto part = [&](unsigned up) {
        return static_cast<float>(static_cast<std::int32_t>(entry << up) >> 22) / 512.0F;
    };
    return {part(0), part(10), part(20)};
}

} // namespace

TEST_CASE("over the fine pattern colours change by nothing, of whatever covers they are mixed") {
    const LandCoverContrast contrast({wood, meadow, rock, snow}, pattern());
    const auto shares = share_of_patterns();
    for (int kind = 0; kind < LandCoverContrast::mixture_count; ++kind) {
        glm::dvec3 mean(0.0);
        for (int i = 0; i < LandCoverContrast::pattern_step_count; ++i) {
            mean += shares[static_cast<std::size_t>(i)] * glm::dvec3(shares_at(contrast, kind, i));
        }
        CAPTURE(kind);
        for (glm::length_t part = 0; part < 3; ++part) { CHECK(std::abs(mean[part]) < 0.02); }
    }
}

TEST_CASE("where two covers are mixed, each has the larger part of a pixel on its share of the ground") {
    const LandCover dark{wood.colour, 0.0F};
    const LandCover bright_cover{meadow.colour, 0.0F};
    const LandCoverContrast contrast({dark, bright_cover, rock, snow}, pattern());
    const auto shares = share_of_patterns();
    for (const double meadows : {0.25, 0.5, 0.75}) {
        const int kind = 32 + static_cast<int>(32 * meadows);
        double bright = 0.0;
        for (int i = 0; i < LandCoverContrast::pattern_step_count; ++i) {
            const float middle = 0.5F * (shares_at(contrast, kind, 0).y +
                                            shares_at(contrast, kind, LandCoverContrast::pattern_step_count - 1).y);
            const bool is_bright = shares_at(contrast, kind, i).y > middle;
            bright += is_bright ? shares[static_cast<std::size_t>(i)] : 0.0;
        }
        CAPTURE(meadows);
        CHECK(bright == Approx(meadows).margin(0.06));
    }
}

TEST_CASE("colours go on from each mixture to the next, so that none has an edge") {
    const LandCoverContrast contrast({wood, meadow, rock, snow}, pattern());
    constexpr int last_step = LandCoverContrast::pattern_step_count - 1;
    const auto shares = share_of_patterns();
    for (int kind = 1; kind < LandCoverContrast::mixture_count; ++kind) {
        const bool is_inverted = kind == LandCoverContrast::first_open_mixture; // and so is the pattern there
        double squares = 0.0;
        for (int i = 0; i <= last_step; ++i) {
            const float before = shares_at(contrast, kind - 1, is_inverted ? last_step - i : i).y;
            const double step = static_cast<double>(shares_at(contrast, kind, i).y - before);
            squares += shares[static_cast<std::size_t>(i)] * step * step;
        }
        CAPTURE(kind);
        CHECK(std::sqrt(squares) < 0.09);
    }
}

TEST_CASE("nothing changes where there is no cover, and one alone is mottled by its own share") {
    const LandCoverContrast contrast({wood, meadow, rock, snow}, pattern());
    for (int i = 0; i < LandCoverContrast::pattern_step_count; ++i) {
        CHECK(shares_at(contrast, 0, i) == glm::vec3(0.0F));
    }
    const auto shares = share_of_patterns();
    double squares = 0.0;
    for (int i = 0; i < LandCoverContrast::pattern_step_count; ++i) {
        const auto share = static_cast<double>(shares_at(contrast, 32, i).y);
        squares += shares[static_cast<std::size_t>(i)] * share * share;
    }
    CHECK(std::sqrt(squares) == Approx(0.17).margin(0.02));
}

TEST_CASE("larger pictures show the pattern of 720 lines over 45 degrees, at most twice as many pixels wide") {
    CHECK(detail_texels_per_m(400.0) == Approx(16.0));
    CHECK(detail_texels_per_m(869.0) == Approx(16.0));
    CHECK(detail_texels_per_m(1.5 * 869.0) == Approx(24.0));
    CHECK(detail_texels_per_m(10.0 * 869.0) == Approx(32.0));
}

TEST_CASE("the axes of the fine pattern are at right angles, and every scale has its own tile") {
    const auto& axes = DetailPattern::axes;
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(glm::dot(axes[i], axes[i]) == Approx(1.0).margin(1e-8));
        CHECK(glm::dot(axes[i], axes[(i + 1) % 3]) == Approx(0.0).margin(1e-8));
    }
    const glm::dvec3 place_m = 64.0 / 16.0 * axes[1];
    CHECK(glm::distance(detail_tile_position(place_m, 0), glm::dvec3(0.0, 1.0, 0.0)) < 1e-8);
    CHECK(glm::distance(detail_tile_position(place_m, 1), glm::dvec3(0.0, 0.25, 0.0)) < 1e-8);
    CHECK(glm::distance(detail_tile_position(place_m, 2), glm::dvec3(0.0, 0.0625, 0.0)) < 1e-8);
}

TEST_CASE("all levels of the detail patterns have a normal distribution of one mean and one contrast") {
    for (const DetailPattern::Kind kind : both_kinds) {
        for (int level = 0; level < DetailPattern::levels; ++level) {
            const auto texels = texels_of(pattern(), kind, level);
            const auto count = static_cast<double>(texels.size());
            double sum = 0.0;
            double squares = 0.0;
            double within_deviation = 0.0;
            for (const std::uint8_t texel : texels) {
                const double value = texel / 128.0 - 1.0;
                sum += value;
                squares += value * value;
                within_deviation += std::abs(value) < DetailPattern::deviation ? 1.0 : 0.0;
            }
            CAPTURE(static_cast<int>(kind), level);
            CHECK(std::abs(sum / count) < 0.01);
            CHECK(std::sqrt(squares / count) == Approx(DetailPattern::deviation).margin(0.02));
            CHECK(within_deviation / count == Approx(0.683).margin(0.02));
        }
    }
}

TEST_CASE("the detail patterns are brighter where they fall towards the sun") {
    // Against the same relief in light from the other side, the mean of which is that of the relief alone.
    constexpr double azimuth_rad = 0.785398163;
    const glm::dvec3 to_sun(std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0);
    const DetailPattern& lit = detail_pattern(azimuth_rad);
    const DetailPattern& lit_from_behind = detail_pattern(azimuth_rad + 3.141592654);
    const int last = DetailPattern::side_texels - 1;
    for (const DetailPattern::Kind kind : both_kinds) {
        double products = 0.0;
        for (int i = 0; i < 64 * 64 * 64; ++i) {
            const glm::ivec3 at(i & last, i >> 6 & last, i >> 12);
            const auto height = [&](const glm::ivec3& off) {
                const glm::ivec3 place((at.x + off.x) & last, (at.y + off.y) & last, (at.z + off.z) & last);
                return lit.texel(kind, 0, place) + lit_from_behind.texel(kind, 0, place);
            };
            double fall = 0.0;
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                glm::ivec3 off(0);
                off[axis] = 2;
                fall += glm::dot(DetailPattern::axes[static_cast<std::size_t>(axis)], to_sun) *
                        (height(-off) - height(off));
            }
            products += fall * (lit.texel(kind, 0, at) - lit_from_behind.texel(kind, 0, at));
        }
        CAPTURE(static_cast<int>(kind));
        CHECK(products / (64.0 * 64.0 * 64.0) > 100.0);
    }
}

TEST_CASE("suns at about one azimuth share a pattern") {
    CHECK(&detail_pattern(0.1) == &detail_pattern(-0.1));
    CHECK(&detail_pattern(0.1) == &detail_pattern(0.1 + 6.283185307));
    CHECK(&detail_pattern(0.1) != &detail_pattern(1.0));
}

} // namespace octant::visuals::scene
