#include "visuals/scene/land_cover_contrast.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace octant::visuals::scene {

namespace {

/// Standard deviations of the pattern over which one cover gives way to the other: about four pixels, so that a turn by
/// half a pixel changes little.
constexpr double border_width = 2.35;
/// Snow thins out over a wider border than one cover meets another, and with less contrast: patches as sharp and as
/// dark as those look like camouflage.
constexpr double snow_border_width = 5.0;
constexpr double snow_contrast = 0.4;
/// Of the brightness of closed woods: lone crowns, with their shade on the ground.
constexpr float lone_crown_brightness = 0.685F;
/// Of the mottling of ground between crowns: it is brightest where it is farthest from them, where the pattern is low.
constexpr float mottling_between_crowns = -0.5F;
/// Of the difference in hue: means are seldom of the very colours that covers are said to have.
constexpr double hue_share = 0.45;
constexpr double min_mean = 1e-3;
constexpr double max_share = 511.0 / 512.0;

/// The pattern in the middle of an entry, in its standard deviations.
double deviations_at(int pattern) {
    return ((pattern + 0.5) * 2.0 / LandCoverContrast::pattern_step_count - 1.0) / DetailPattern::deviation;
}

/// The share of a normal distribution below a place, in its standard deviations.
double share_below(double deviations) { return 0.5 * std::erfc(-deviations * std::sqrt(0.5)); }

/// The place below which so much of a normal distribution lies, found by halving.
double place_of_share(double share) {
    double low = -4.0;
    double high = 4.0;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (share_below(middle) < share ? low : high) = middle;
    }
    return low;
}

/// Two covers. The second one is seen where the pattern is high, but the crowns of woods, the first one, are there.
struct Mixture {
    LandCover first;
    LandCover second;
    double border; ///< beyond it the second cover is seen, in standard deviations of the pattern
    bool has_crowns;
    bool is_snow; ///< the second cover

    /// The share of the second cover at a value of the pattern, in standard deviations.
    double share_of_second(double deviations) const {
        const double width = is_snow ? snow_border_width : border_width;
        const double above = (has_crowns ? -deviations : deviations) - border;
        return glm::clamp(above / width + 0.5, 0.0, 1.0);
    }
};

Mixture mixture_of(int kind, const std::array<LandCover, LandCoverContrast::covers>& covers) {
    const int last = LandCoverContrast::mixture_count - 1;
    const double place = kind == last ? LandCoverContrast::covers : kind * 4.0 / LandCoverContrast::mixture_count;
    const int below = std::min(static_cast<int>(place), LandCoverContrast::covers - 1);
    Mixture mixture{
        {}, covers[static_cast<std::size_t>(below)], place_of_share(1.0 - (place - below)), below == 1, below == 3};
    mixture.first = below == 0 ? LandCover{mixture.second.colour, 0.0F} : covers[static_cast<std::size_t>(below - 1)];
    if (mixture.has_crowns) {
        mixture.first.colour *= lone_crown_brightness;
        mixture.second.mottling *= mottling_between_crowns;
    }
    return mixture;
}

/// Of a normal distribution, by standard deviations.
double density_at(double deviations) { return std::exp(-0.5 * deviations * deviations); }

/// What a pixel shows of a mixture. `means`: means_of_covers().
glm::dvec3 shown_of(const Mixture& mixture, const glm::dvec2& means, double deviations) {
    const auto shown = [&](const LandCover& cover, double mean) {
        const double change = static_cast<double>(cover.mottling) * (deviations - mean);
        return glm::dvec3(cover.colour) * std::max(1.0 + change, 0.0);
    };
    return glm::mix(shown(mixture.first, means.x), shown(mixture.second, means.y), mixture.share_of_second(deviations));
}

/// The mean of the pattern where each cover of a mixture is seen, in standard deviations: covers are mottled around
/// their own colours however little of them is seen.
glm::dvec2 means_of_covers(const Mixture& mixture) {
    glm::dvec2 sums(0.0);
    glm::dvec2 weights(1e-9);
    for (int i = 0; i < LandCoverContrast::pattern_step_count; ++i) {
        const double at = deviations_at(i);
        const double second = mixture.share_of_second(at);
        const glm::dvec2 weight = density_at(at) * glm::dvec2(1.0 - second, second);
        sums += weight * at;
        weights += weight;
    }
    return sums / weights;
}

using Shares = std::array<glm::dvec3, LandCoverContrast::pattern_step_count>;

/// By what shares of itself the mean of a mixture changes, pattern by pattern.
Shares shares_of_mixture(const Mixture& mixture) {
    Shares shares{};
    const glm::dvec2 means = means_of_covers(mixture);
    glm::dvec3 mean(0.0);
    double whole = 0.0;
    for (int i = 0; i < LandCoverContrast::pattern_step_count; ++i) {
        const double at = deviations_at(i);
        const double weight = density_at(at);
        glm::dvec3& shown = shares[static_cast<std::size_t>(i)];
        shown = shown_of(mixture, means, at);
        mean += weight * shown;
        whole += weight;
    }
    mean = glm::max(mean / whole, glm::dvec3(min_mean));
    double most = max_share;
    for (glm::dvec3& share : shares) {
        share = share / mean - 1.0;
        const glm::dvec3 grey((share.x + share.y + share.z) / 3.0);
        share = glm::mix(grey, share, hue_share) * (mixture.is_snow ? snow_contrast : 1.0);
        most = std::max({most, share.x, share.y, share.z});
    }
    // Less contrast rather than another mean.
    for (glm::dvec3& share : shares) { share *= max_share / most; }
    return shares;
}

std::uint32_t packed_shares(const glm::dvec3& shares) {
    const auto bits = [](double share) {
        return static_cast<std::uint32_t>(std::lround(std::max(share, -1.0) * 512.0)) & 0x3ffU;
    };
    return bits(shares.x) << 22U | bits(shares.y) << 12U | bits(shares.z) << 2U;
}

} // namespace

LandCoverContrast::LandCoverContrast(const std::array<LandCover, covers>& of, const DetailPattern& pattern)
    : pattern_(&pattern) {
    table_.reserve(std::size_t{mixture_count} * pattern_step_count);
    for (int kind = 0; kind < mixture_count; ++kind) {
        for (const glm::dvec3& shares : shares_of_mixture(mixture_of(kind, of))) {
            table_.push_back(packed_shares(shares));
        }
    }
}

} // namespace octant::visuals::scene
