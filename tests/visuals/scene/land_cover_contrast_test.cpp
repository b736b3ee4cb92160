#include "visuals/scene/detail_pattern.h"
#include "visuals/scene/land_cover_contrast.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace octant::visuals::scene {

namespace {

constexpr LandCover wood{glm::vec3(0.14F, 0.25F, 0.12F), 0.17F};
constexpr LandCover meadow{glm::vec3(0.37F, 0.47F, 0.22F), 0.08F};
constexpr LandCover rock{glm::vec3(0.47F, 0.44F, 0.41F), 0.15F};
constexpr LandCover snow{glm::vec3(0.93F, 0.94F, 0.96F), 0.03F};

/// How often the pattern has a value within an entry, by the texels themselves.
std::array<double, LandCoverContrast::pattern_step_count> share_of_patterns() {
    std::array<double, LandCoverContrast::pattern_step_count> shares{};
    const auto& texels = detail_mip_levels()[0].texels;
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
    const LandCoverContrast contrast({wood, meadow, rock, snow});
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
    const LandCoverContrast contrast({dark, bright_cover, rock, snow});
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

TEST_CASE("nothing changes where there is no cover, and one alone is mottled by its own share") {
    const LandCoverContrast contrast({wood, meadow, rock, snow});
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
    CHECK(detail_texels_per_m(400.0) == Approx(8.0));
    CHECK(detail_texels_per_m(869.0) == Approx(8.0));
    CHECK(detail_texels_per_m(1.5 * 869.0) == Approx(12.0));
    CHECK(detail_texels_per_m(10.0 * 869.0) == Approx(16.0));
}

TEST_CASE("the axes of the fine pattern are at right angles, and every scale has its own tile") {
    const auto& axes = DetailPattern::axes;
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(glm::dot(axes[i], axes[i]) == Approx(1.0).margin(1e-8));
        CHECK(glm::dot(axes[i], axes[(i + 1) % 3]) == Approx(0.0).margin(1e-8));
    }
    const glm::dvec3 place_m = 64.0 / 8.0 * axes[1];
    CHECK(glm::distance(detail_tile_position(place_m, 0), glm::dvec3(0.0, 1.0, 0.0)) < 1e-8);
    CHECK(glm::distance(detail_tile_position(place_m, 1), glm::dvec3(0.25, 0.0, 0.0)) < 1e-8);
    CHECK(glm::distance(detail_tile_position(place_m, 2), glm::dvec3(0.0, 0.0, 0.0625)) < 1e-8);
}

TEST_CASE("all levels of the fine pattern have one mean and one contrast") {
    for (const DetailPattern& level : detail_mip_levels()) {
        double sum = 0.0;
        double squares = 0.0;
        for (const std::uint8_t texel : level.texels) {
            const double value = texel / 128.0 - 1.0;
            sum += value;
            squares += value * value;
        }
        const auto count = static_cast<double>(level.texels.size());
        CAPTURE(level.size);
        CHECK(std::abs(sum / count) < 0.01);
        CHECK(std::sqrt(squares / count) == Approx(DetailPattern::deviation).margin(0.02));
    }
}

} // namespace octant::visuals::scene
