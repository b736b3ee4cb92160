#include "visuals/raster/ground_image.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace octant::visuals::raster {

namespace {

constexpr float most_level = 255.0F;

bool same(const Light& a, const Light& b) {
    return a.ambient == b.ambient && a.sunlight == b.sunlight && a.to_sun == b.to_sun;
}

/// The normal at a world place, between the texels' normals.
glm::vec3 normal_at(const scene::GroundImage& image, const glm::dvec2& at_m) {
    const glm::dvec2 last(image.width - 1, image.height - 1);
    const glm::dvec2 at = glm::clamp((at_m - image.first_m) / image.step_m, glm::dvec2(0.0), last);
    const glm::ivec2 low = glm::min(glm::ivec2(at), glm::max(glm::ivec2(last) - 1, glm::ivec2(0)));
    const glm::ivec2 high = glm::min(low + 1, glm::ivec2(last));
    const glm::vec2 part(at - glm::dvec2(low));
    const auto slope = [&](int x, int y) {
        const auto i = 2 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                            static_cast<std::size_t>(x));
        return (glm::vec2(image.texels[i], image.texels[i + 1]) - 128.0F) / 127.0F;
    };
    const glm::vec2 xy = glm::mix(
        glm::mix(slope(low.x, low.y), slope(high.x, low.y), part.x),
        glm::mix(slope(low.x, high.y), slope(high.x, high.y), part.x),
        part.y);
    return {xy, std::sqrt(std::max(1.0F - glm::dot(xy, xy), 0.0F))};
}

GroundImage::Level half_of(const GroundImage::Level& from) {
    GroundImage::Level to;
    to.width = std::max(from.width / 2, 1);
    to.height = std::max(from.height / 2, 1);
    to.texels.reserve(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
    const auto texel = [&](int x, int y) {
        return from.texels
            [static_cast<std::size_t>(std::min(y, from.height - 1)) *
                 static_cast<std::size_t>(from.width) +
             static_cast<std::size_t>(std::min(x, from.width - 1))];
    };
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            std::uint32_t sum = 0;
            for (unsigned shift = 0; shift < 24; shift += 8) {
                std::uint32_t part = 2;
                for (const int k : {0, 1, 2, 3}) {
                    part += texel(2 * x + (k & 1), 2 * y + (k >> 1)) >> shift & 0xffU;
                }
                sum |= part / 4 << shift;
            }
            to.texels.push_back(sum);
        }
    }
    return to;
}

} // namespace

void GroundImage::load(const scene::GroundTexture& texture) {
    texture_ = texture;
    levels_.clear();
}

void GroundImage::light(const Light& light) {
    if (!levels_.empty() && same(light, light_)) {
        return;
    }
    light_ = light;
    const scene::GroundImage& albedo = texture_.albedo;
    Level level{albedo.width, albedo.height, {}};
    level.texels.reserve(
        static_cast<std::size_t>(albedo.width) * static_cast<std::size_t>(albedo.height));
    for (int y = 0; y < albedo.height; ++y) {
        for (int x = 0; x < albedo.width; ++x) {
            const glm::dvec2 at_m = albedo.first_m + glm::dvec2(x, y) * albedo.step_m;
            const glm::vec3 outwards = normal_at(texture_.normal, at_m);
            const glm::vec3 sum =
                light.ambient + light.sunlight * std::max(glm::dot(outwards, light.to_sun), 0.0F);
            const std::size_t i = 3 * level.texels.size();
            std::uint32_t packed = 0;
            for (glm::length_t part = 0; part < 3; ++part) {
                const auto own =
                    static_cast<float>(albedo.texels[i + static_cast<std::size_t>(part)]);
                const float lit = std::min(own * sum[part], most_level);
                packed |= static_cast<std::uint32_t>(lit + 0.5F)
                          << (8 * static_cast<unsigned>(part));
            }
            level.texels.push_back(packed);
        }
    }
    levels_.clear();
    levels_.push_back(std::move(level));
    while (levels_.back().width > 1 || levels_.back().height > 1) {
        levels_.push_back(half_of(levels_.back()));
    }
}

TexelPlace GroundImage::texel_place(const scene::TexturePlace& place) const {
    const glm::vec2 size(texture_.albedo.width, texture_.albedo.height);
    return {place.at_eye * size - 0.5F, place.per_m * size};
}

} // namespace octant::visuals::raster
