#include "visuals/scene/land_cover_contrast.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace octant::visuals::scene {

namespace {

/// Standard deviations of the pattern over which one cover gives way to the other: about five pixels, so that a turn by
/// half a pixel changes little, and woods from afar are no hard blots.
constexpr double border_width = 2.8;
/// Snow thins out over a wider border than one cover meets another, and with less contrast: patches as sharp and as
/// dark as those look like camouflage.
constexpr double snow_border_width = 5.0;
constexpr double snow_contrast = 0.4;
/// Of the brightness of closed woods: lone crowns, with their shade on the ground.
constexpr float lone_crown_brightness = 0.65F;
/// A cover of a smaller share than this appears as its share grows: at once it would have an edge.
constexpr double least_share = 0.125;
/// Of the brightness of a cover: shade under crowns is not black.
constexpr double darkest = 0.3;
/// Of the difference in hue: means are seldom of the very colours that covers are said to have.
constexpr double hue_share = 0.38;
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
    bool is_snow;    ///< the second cover
    double contrast; ///< of what is seen

    /// The share of the second cover at a value of the pattern, in standard deviations.
    double share_of_second(double deviations) const {
        const double width = is_snow ? snow_border_width : border_width;
        const double above = (has_crowns ? -deviations : deviations) - border;
        return glm::clamp(above / width + 0.5, 0.0, 1.0);
    }
};

/// Of the cover before one and of that one, by the second one's share. Before the first cover is land of its colour
/// that does not change.
Mixture mixture_of(std::size_t cover, double second, const std::array<LandCover, LandCoverContrast::covers>& covers) {
    Mixture mixture{{}, covers[cover], place_of_share(1.0 - second), cover == 1, cover == 3, 1.0};
    if (mixture.is_snow) { mixture.contrast = glm::mix(1.0, snow_contrast, std::min(4.0 * second, 1.0)); }
    mixture.first = cover == 0 ? LandCover{mixture.second.colour, 0.0F} : covers[cover - 1];
    if (mixture.has_crowns) {
        mixture.first.colour *= lone_crown_brightness;
        mixture.second.mottling *= -1.0F; // it is brightest where it is farthest from crowns, where the pattern is low
    }
    return mixture;
}

/// Of a normal distribution, by standard deviations.
double density_at(double deviations) { return std::exp(-0.5 * deviations * deviations); }

/// What a pixel shows of a mixture. `means`: means_of_covers().
glm::dvec3 shown_of(const Mixture& mixture, const glm::dvec2& means, double deviations) {
    const auto shown = [&](const LandCover& cover, double mean) {
        const double change = static_cast<double>(cover.mottling) * (deviations - mean);
        return glm::dvec3(cover.colour) * std::max(1.0 + change, darkest);
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
        share = glm::mix(grey, share, hue_share) * mixture.contrast;
        most = std::max({most, share.x, share.y, share.z});
    }
    // Less contrast rather than another mean.
    for (glm::dvec3& share : shares) { share *= max_share / most; }
    return shares;
}

/// The same, continuous from one mixture to the next.
Shares shares_of_kind(int kind, const std::array<LandCover, LandCoverContrast::covers>& covers) {
    constexpr int kinds = LandCoverContrast::mixture_count / LandCoverContrast::covers;
    const bool is_last = kind == LandCoverContrast::mixture_count - 1;
    const double second = is_last ? 1.0 : kind % kinds / static_cast<double>(kinds);
    const auto shares_at = [&](double share) {
        return shares_of_mixture(mixture_of(static_cast<std::size_t>(kind / kinds), share, covers));
    };
    const double pure = second < 0.5 ? 0.0 : 1.0;
    const double from_pure = std::abs(second - pure) / least_share;
    if (from_pure >= 1.0) { return shares_at(second); }
    Shares shares = shares_at(pure);
    const Shares mixed = shares_at(std::abs(pure - least_share));
    for (std::size_t i = 0; i < shares.size(); ++i) { shares[i] = glm::mix(shares[i], mixed[i], from_pure); }
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
        for (const glm::dvec3& shares : shares_of_kind(kind, of)) { table_.push_back(packed_shares(shares)); }
    }
}

} // namespace octant::visuals::scene
