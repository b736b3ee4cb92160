#include "visuals/scene/ground_texture.h"

#include "visuals/scene/ground_colours.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace octant::visuals::scene {

namespace {

std::uint8_t byte_of(float part) {
    return static_cast<std::uint8_t>(std::lround(glm::clamp(part, 0.0F, 1.0F) * 255.0F));
}

std::uint8_t byte_of_slope(float part) {
    return static_cast<std::uint8_t>(128 + std::lround(glm::clamp(part, -1.0F, 1.0F) * 127.0F));
}

/// An image of samples `stride` apart, without its texels.
GroundImage sampled(const models::HeightField& field, int stride) {
    GroundImage image;
    image.width = (field.columns() - 1) / stride + 1;
    image.height = (field.rows() - 1) / stride + 1;
    image.first_m = -field.half_extent_m();
    image.step_m = glm::dvec2(stride * field.spacing_m());
    return image;
}

/// Mixes the drape into the colours of the ground, both over the whole field.
GroundImage
draped(const GroundImage& ground, const models::Image& drape, const glm::dvec2& half_extent_m) {
    GroundImage image;
    image.width = drape.width;
    image.height = drape.height;
    image.step_m = 2.0 * half_extent_m / glm::dvec2(image.width, image.height);
    image.first_m = 0.5 * image.step_m - half_extent_m;
    image.texels.reserve(
        std::size_t{3} * static_cast<std::size_t>(image.width) *
        static_cast<std::size_t>(image.height));
    for (int row = 0; row < image.height; ++row) {
        for (int column = 0; column < image.width; ++column) {
            const std::uint8_t* const own = drape.pixel(column, image.height - 1 - row);
            if (own[3] == 255) {
                image.texels.insert(image.texels.end(), own, own + 3);
                continue;
            }
            const glm::dvec2 at_m = image.first_m + glm::dvec2(column, row) * image.step_m;
            const glm::ivec2 nearest = glm::clamp(
                glm::ivec2(glm::round((at_m - ground.first_m) / ground.step_m)),
                glm::ivec2(0),
                glm::ivec2(ground.width - 1, ground.height - 1));
            const auto below =
                static_cast<std::size_t>(nearest.y) * static_cast<std::size_t>(ground.width) +
                static_cast<std::size_t>(nearest.x);
            for (std::size_t part = 0; part < 3; ++part) {
                const int mixed =
                    own[part] * own[3] + ground.texels[3 * below + part] * (255 - own[3]);
                image.texels.push_back(static_cast<std::uint8_t>((mixed + 127) / 255));
            }
        }
    }
    return image;
}

/// Of the ground under light, from the normals' texels and the colours nearest to each.
glm::vec3 mean_lit(const GroundTexture& texture, const glm::vec3& to_sun) {
    const GroundImage& albedo = texture.albedo;
    const GroundImage& normal = texture.normal;
    glm::dvec3 sum(0.0);
    for (int row = 0; row < normal.height; ++row) {
        const int albedo_row = row * albedo.height / normal.height;
        glm::dvec3 row_sum(0.0);
        for (int column = 0; column < normal.width; ++column) {
            const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(normal.width) +
                            static_cast<std::size_t>(column);
            const glm::vec2 slope(
                static_cast<float>(normal.texels[2 * at] - 128) / 127.0F,
                static_cast<float>(normal.texels[2 * at + 1] - 128) / 127.0F);
            const float up = std::sqrt(std::max(1.0F - glm::dot(slope, slope), 0.0F));
            const double light = light_on(glm::vec3(slope, up), to_sun);
            const auto under =
                static_cast<std::size_t>(albedo_row) * static_cast<std::size_t>(albedo.width) +
                static_cast<std::size_t>(column * albedo.width / normal.width);
            for (int part = 0; part < 3; ++part) {
                row_sum[part] += std::min(
                    light * albedo.texels[3 * under + static_cast<std::size_t>(part)], 255.0);
            }
        }
        sum += row_sum;
    }
    return glm::vec3(sum / (255.0 * normal.width * normal.height));
}

TexturePlace place_in(const GroundImage& image, const glm::dvec3& eye_m) {
    const glm::dvec2 extent_m = image.step_m * glm::dvec2(image.width, image.height);
    const glm::dvec2 corner_m = image.first_m - 0.5 * image.step_m;
    return {
        glm::vec2((glm::dvec2(eye_m) - corner_m) / extent_m),
        glm::vec2(glm::dvec2(1.0) / extent_m)};
}

} // namespace

GroundTexture ground_texture(
    const models::HeightField& field, const Settings& settings, const models::Image* drape) {
    assert(drape == nullptr || std::max(drape->width, drape->height) <= largest_texture);
    const int stride =
        (std::max(field.columns(), field.rows()) + largest_texture - 1) / largest_texture;
    GroundTexture texture;
    texture.normal = sampled(field, stride);
    texture.albedo = sampled(field, stride);
    const GroundPalette palette(settings);
    const auto spacing_m = static_cast<float>(field.spacing_m());
    for (int row = 0; row < texture.normal.height; ++row) {
        for (int column = 0; column < texture.normal.width; ++column) {
            const GroundPoint point = ground_point(field, column * stride, row * stride);
            const glm::vec3 own = palette.own(point, spacing_m);
            texture.normal.texels.push_back(byte_of_slope(point.normal.x));
            texture.normal.texels.push_back(byte_of_slope(point.normal.y));
            for (int part = 0; part < 3; ++part) {
                texture.albedo.texels.push_back(byte_of(own[part]));
            }
        }
    }
    if (drape != nullptr) {
        texture.albedo = draped(texture.albedo, *drape, field.half_extent_m());
    }
    texture.mean_colour = mean_lit(texture, direction_to_sun(settings));
    return texture;
}

TexturePlaces texture_places(const GroundTexture& texture, const glm::dvec3& eye_m) {
    return {place_in(texture.albedo, eye_m), place_in(texture.normal, eye_m)};
}

} // namespace octant::visuals::scene
