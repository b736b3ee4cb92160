#include "visuals/scene/detail_pattern.h"
#include "visuals/scene/land_cover_contrast.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>

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

TEST_CASE("where two covers are mixed, each is seen on its share of the ground") {
    const LandCoverContrast contrast({wood, meadow, rock, snow});
    const auto shares = share_of_patterns();
    for (const double meadows : {0.25, 0.5, 0.75}) {
        const int kind = 32 + static_cast<int>(32 * meadows);
        double bright = 0.0;
        for (int i = 0; i < LandCoverContrast::pattern_step_count; ++i) {
            const bool is_bright = shares_at(contrast, kind, i).y > 0.0F;
            bright += is_bright ? shares[static_cast<std::size_t>(i)] : 0.0;
        }
        CAPTURE(meadows);
        CHECK(bright == Approx(meadows).margin(0.12));
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
