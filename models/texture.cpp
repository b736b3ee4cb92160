#include "models/texture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace octant::models {

namespace {

/// The texels of a row or column that one texel of the next level stands for: two, or three at an odd end, the outer
/// ones then in part.
struct Footprint {
    int first = 0;
    int count = 0;
    std::array<std::uint32_t, 3> weights{};
};

/// `at`: the texel of the next level, which has `half` of them where this level has `count`. Weights add up to `count`
/// for odd counts, to 2 for even ones.
Footprint footprint(int at, int count, int half) {
    if (count == 1) { return {0, 1, {1, 0, 0}}; }
    if (count % 2 == 0) { return {2 * at, 2, {1, 1, 0}}; }
    const auto left = static_cast<std::uint32_t>(half - at);
    const auto right = static_cast<std::uint32_t>(at + 1);
    return {2 * at, 3, {left, static_cast<std::uint32_t>(half), right}};
}

/// The mean of the texels below one texel of the next level.
void mean_texel(const TextureLevel& level, const Footprint& across, const Footprint& down, std::uint8_t* to) {
    std::array<std::uint64_t, 3> colour{};
    std::array<std::uint64_t, 3> covered{};
    std::uint64_t alpha = 0;
    std::uint64_t weights = 0;
    for (int j = 0; j < down.count; ++j) {
        const std::size_t row = static_cast<std::size_t>(down.first + j) * static_cast<std::size_t>(level.width);
        for (int i = 0; i < across.count; ++i) {
            const std::uint8_t* from = &level.rgba[4 * (row + static_cast<std::size_t>(across.first + i))];
            const std::uint64_t weight = std::uint64_t{across.weights.at(static_cast<std::size_t>(i))} *
                                         down.weights.at(static_cast<std::size_t>(j));
            for (std::size_t part = 0; part < 3; ++part) {
                colour.at(part) += weight * from[part];
                covered.at(part) += weight * from[3] * from[part];
            }
            alpha += weight * from[3];
            weights += weight;
        }
    }
    for (std::size_t part = 0; part < 3; ++part) {
        const std::uint64_t mean =
            alpha > 0 ? (covered.at(part) + alpha / 2) / alpha : (colour.at(part) + weights / 2) / weights;
        to[part] = static_cast<std::uint8_t>(mean);
    }
    to[3] = static_cast<std::uint8_t>((alpha + weights / 2) / weights);
}

/// As mean_texel() of two by two opaque texels.
void mean_of_four(const std::uint8_t* upper, const std::uint8_t* lower, std::uint8_t* to) {
    for (int part = 0; part < 4; ++part) {
        const unsigned sum = 2U + upper[part] + upper[part + 4] + lower[part] + lower[part + 4];
        to[part] = static_cast<std::uint8_t>(sum / 4U);
    }
}

TextureLevel next_level(const TextureLevel& level, bool is_opaque) {
    TextureLevel next;
    next.width = std::max(level.width / 2, 1);
    next.height = std::max(level.height / 2, 1);
    next.rgba.resize(std::size_t{4} * static_cast<std::size_t>(next.width) * static_cast<std::size_t>(next.height));
    std::uint8_t* to = next.rgba.data();
    const std::size_t row_bytes = std::size_t{4} * static_cast<std::size_t>(level.width);
    const bool is_plain = is_opaque && level.width % 2 == 0 && level.height % 2 == 0;
    for (int y = 0; y < next.height; ++y) {
        const std::uint8_t* upper = level.rgba.data() + 2 * static_cast<std::size_t>(y) * row_bytes;
        for (int x = 0; is_plain && x < next.width; ++x, to += 4, upper += 8) {
            mean_of_four(upper, upper + row_bytes, to);
        }
        if (is_plain) { continue; }
        const Footprint down = footprint(y, level.height, next.height);
        for (int x = 0; x < next.width; ++x, to += 4) {
            mean_texel(level, footprint(x, level.width, next.width), down, to);
        }
    }
    return next;
}

bool has_full_alpha(const TextureLevel& level) {
    for (std::size_t at = 3; at < level.rgba.size(); at += 4) {
        if (level.rgba[at] != 255) { return false; }
    }
    return true;
}

} // namespace

std::size_t TexturePicture::bytes() const {
    std::size_t sum = 0;
    for (const TextureLevel& level : levels) { sum += level.rgba.size(); }
    return sum;
}

TexturePicture texture_picture(std::string name, TextureLevel finest) {
    assert(finest.width > 0 && finest.height > 0);
    assert(finest.rgba.size() ==
           std::size_t{4} * static_cast<std::size_t>(finest.width) * static_cast<std::size_t>(finest.height));
    TexturePicture picture{.name = std::move(name), .levels = {}, .is_opaque = has_full_alpha(finest)};
    picture.levels.push_back(std::move(finest));
    while (picture.levels.back().width > 1 || picture.levels.back().height > 1) {
        picture.levels.push_back(next_level(picture.levels.back(), picture.is_opaque));
    }
    return picture;
}

void halve(TexturePicture& picture) {
    if (picture.levels.size() > 1) { picture.levels.erase(picture.levels.begin()); }
}

} // namespace octant::models
