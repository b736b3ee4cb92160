#include "visuals/raster/lit_ground_texture.h"

#include "sim/base/thread_pool.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace octant::visuals::raster {

namespace {

constexpr float max_texel_level = 255.0F;

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
        const auto i =
            2 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
        return (glm::vec2(image.texels[i], image.texels[i + 1]) - 128.0F) / 127.0F;
    };
    const glm::vec2 xy = glm::mix(glm::mix(slope(low.x, low.y), slope(high.x, low.y), part.x),
        glm::mix(slope(low.x, high.y), slope(high.x, high.y), part.x), part.y);
    return {xy, std::sqrt(std::max(1.0F - glm::dot(xy, xy), 0.0F))};
}

/// Texels beyond the texture's rim are those of its rim.
void light_row(const scene::GroundTexture& texture, const Light& light, int row, LitGroundTexture::MipLevel& level) {
    const scene::GroundImage& albedo = texture.albedo;
    const auto width = static_cast<std::size_t>(albedo.width);
    const auto y = static_cast<std::size_t>(std::min(row, albedo.height - 1));
    std::uint32_t* const to = level.texels.data() + level.number(0, row);
    for (int column = 0; column < level.width; ++column) {
        const glm::dvec2 at_m = albedo.first_m + glm::dvec2(column, row) * albedo.step_m;
        const glm::vec3 outwards = normal_at(texture.normal, at_m);
        const glm::vec3 sum = light.ambient + light.sunlight * std::max(glm::dot(outwards, light.to_sun), 0.0F);
        const auto x = static_cast<std::size_t>(std::min(column, albedo.width - 1));
        const std::uint8_t* const own = albedo.texels.data() + 3 * (y * width + x);
        std::uint32_t packed = 0;
        for (glm::length_t part = 0; part < 3; ++part) {
            const float lit = std::min(static_cast<float>(own[part]) * sum[part], max_texel_level);
            packed |= static_cast<std::uint32_t>(lit + 0.5F) << (8 * static_cast<unsigned>(part));
        }
        to[column] = packed;
    }
}

LitGroundTexture::MipLevel half_of(const LitGroundTexture::MipLevel& from) {
    LitGroundTexture::MipLevel to(std::max(from.width / 2, 2), std::max(from.height / 2, 2));
    const auto texel = [&](int x, int y) {
        return from.texels[from.number(std::min(x, from.width - 1), std::min(y, from.height - 1))];
    };
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            std::uint32_t sum = 0;
            for (unsigned shift = 0; shift < 24; shift += 8) {
                std::uint32_t part = 2;
                for (const int k : {0, 1, 2, 3}) { part += texel(2 * x + (k & 1), 2 * y + (k >> 1)) >> shift & 0xffU; }
                sum |= part / 4 << shift;
            }
            to.texels[to.number(x, y)] = sum;
        }
    }
    return to;
}

} // namespace

void LitGroundTexture::load(const scene::GroundTexture& texture) {
    texture_ = texture;
    levels_.clear();
}

void LitGroundTexture::light(const Light& light) {
    if (!levels_.empty() && same(light, light_)) { return; }
    light_ = light;
    const scene::GroundImage& albedo = texture_.albedo;
    levels_.clear();
    levels_.emplace_back(std::max(albedo.width, 2), std::max(albedo.height, 2));
    MipLevel& level = levels_.back();
    parallel_for_rows(level.height, [&](int row) { light_row(texture_, light, row, level); });
    while (levels_.back().width > 2 || levels_.back().height > 2) { levels_.push_back(half_of(levels_.back())); }
}

TexelTransform LitGroundTexture::texel_transform(const scene::TextureTransform& place) const {
    const glm::vec2 size(texture_.albedo.width, texture_.albedo.height);
    return {place.at_eye * size - 0.5F, place.per_m * size};
}

} // namespace octant::visuals::raster
