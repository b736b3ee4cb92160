#include "visuals/landscape/ground_texture_maker.h"

#include "sim/base/thread_pool.h"
#include "visuals/landscape/ground_palette.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace octant::visuals::landscape {

namespace {

std::uint8_t byte_of(float part) {
    return static_cast<std::uint8_t>(std::lround(glm::clamp(part, 0.0F, 1.0F) * 255.0F));
}

std::uint8_t byte_of_slope(float part) {
    return static_cast<std::uint8_t>(128 + std::lround(glm::clamp(part, -1.0F, 1.0F) * 127.0F));
}

/// Samples from one texel to the next: a power of two.
int stride_of(const terrain::GroundSamples& ground) {
    int stride = 1;
    while ((std::max(ground.columns(), ground.rows()) - 1) / stride >= max_sampled_size_texels) { stride *= 2; }
    return stride;
}

/// An image of samples `stride` apart, its texels of so many parts 0.
scene::GroundImage sampled(const terrain::GroundSamples& ground, int stride, std::size_t parts) {
    scene::GroundImage image;
    image.width = (ground.columns() - 1) / stride + 1;
    image.height = (ground.rows() - 1) / stride + 1;
    image.first_m = -ground.half_extent_m();
    image.step_m = glm::dvec2(stride * ground.spacing_m());
    image.texels.resize(parts * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    return image;
}

/// Number of a texel.
std::size_t index_of(const scene::GroundImage& image, int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(column);
}

/// The drape's colour there over the ground's nearest one.
void mix(const std::uint8_t* own, const scene::GroundImage& ground, const glm::dvec2& at_m, std::uint8_t* to) {
    const glm::ivec2 nearest = glm::clamp(glm::ivec2(glm::round((at_m - ground.first_m) / ground.step_m)),
        glm::ivec2(0), glm::ivec2(ground.width - 1, ground.height - 1));
    const std::uint8_t* const below = &ground.texels[3 * index_of(ground, nearest.x, nearest.y)];
    for (std::size_t part = 0; part < 3; ++part) {
        const int mixed = own[part] * own[3] + below[part] * (255 - own[3]);
        to[part] = static_cast<std::uint8_t>((mixed + 127) / 255);
    }
}

/// Mixes the drape into the colours of the ground, both over all of it.
scene::GroundImage draped(
    const scene::GroundImage& ground, const models::heights::Image& drape, const glm::dvec2& half_extent_m) {
    scene::GroundImage image;
    image.width = drape.width;
    image.height = drape.height;
    image.step_m = 2.0 * half_extent_m / glm::dvec2(image.width, image.height);
    image.first_m = 0.5 * image.step_m - half_extent_m;
    image.texels.resize(
        std::size_t{3} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    parallel_for_rows(image.height, [&](int row) {
        std::uint8_t* to = &image.texels[3 * index_of(image, 0, row)];
        for (int column = 0; column < image.width; ++column, to += 3) {
            const std::uint8_t* const own = drape.pixel(column, image.height - 1 - row);
            if (own[3] == 255) {
                std::copy_n(own, 3, to);
            } else {
                mix(own, ground, image.first_m + glm::dvec2(column, row) * image.step_m, to);
            }
        }
    });
    return image;
}

/// Sum over a row of normals of the colours nearest to each, under light.
glm::dvec3 sum_of_lit_row(const scene::GroundTexture& texture, const nature::Daylight& day, int row) {
    const scene::GroundImage& albedo = texture.albedo;
    const scene::GroundImage& normal = texture.normal;
    const int albedo_row = row * albedo.height / normal.height;
    glm::dvec3 sum(0.0);
    for (int column = 0; column < normal.width; ++column) {
        const std::size_t at = index_of(normal, column, row);
        const glm::vec2 slope(static_cast<float>(normal.texels[2 * at] - 128) / 127.0F,
            static_cast<float>(normal.texels[2 * at + 1] - 128) / 127.0F);
        const float up = std::sqrt(std::max(1.0F - glm::dot(slope, slope), 0.0F));
        const glm::vec3 light = illumination(glm::vec3(slope, up), day);
        const std::size_t under = index_of(albedo, column * albedo.width / normal.width, albedo_row);
        for (int part = 0; part < 3; ++part) {
            const auto own = static_cast<float>(albedo.texels[3 * under + static_cast<std::size_t>(part)]);
            sum[part] += static_cast<double>(std::min(light[part] * own, 255.0F));
        }
    }
    return sum;
}

/// The mean colour of the whole ground under the light of a day.
glm::vec3 mean_lit(const scene::GroundTexture& texture, const nature::Daylight& day) {
    const scene::GroundImage& normal = texture.normal;
    std::vector<glm::dvec3> rows(static_cast<std::size_t>(normal.height));
    parallel_for_rows(
        normal.height, [&](int row) { rows[static_cast<std::size_t>(row)] = sum_of_lit_row(texture, day, row); });
    const glm::dvec3 sum = std::accumulate(rows.begin(), rows.end(), glm::dvec3(0.0));
    return glm::vec3(sum / (255.0 * normal.width * normal.height));
}

scene::TextureTransform place_in(const scene::GroundImage& image, const glm::dvec3& eye_m) {
    const glm::dvec2 extent_m = image.step_m * glm::dvec2(image.width, image.height);
    const glm::dvec2 corner_m = image.first_m - 0.5 * image.step_m;
    return {glm::vec2((glm::dvec2(eye_m) - corner_m) / extent_m), glm::vec2(glm::dvec2(1.0) / extent_m)};
}

} // namespace

scene::GroundTexture ground_texture(const terrain::GroundSamples& ground, const scene::AirSettings& settings,
    const models::heights::Image* drape, const nature::Climate& climate) {
    assert(drape == nullptr || std::max(drape->width, drape->height) <= max_texture_size_px);
    const int stride = stride_of(ground);
    scene::GroundTexture texture;
    texture.normal = sampled(ground, stride, 2);
    texture.albedo = sampled(ground, stride, 3);
    const GroundPalette palette(settings, climate, make_relief_shadows(ground, settings));
    const auto footprint_m = static_cast<float>(stride * ground.spacing_m());
    parallel_for_rows(texture.normal.height, [&](int row) {
        for (int column = 0; column < texture.normal.width; ++column) {
            const TerrainPoint point = ground_point(ground, column * stride, row * stride, stride);
            const glm::vec3 own = palette.albedo(point, footprint_m) * palette.light_visibility(point, footprint_m);
            const std::size_t at = index_of(texture.normal, column, row);
            texture.normal.texels[2 * at] = byte_of_slope(point.normal.x);
            texture.normal.texels[2 * at + 1] = byte_of_slope(point.normal.y);
            for (int part = 0; part < 3; ++part) {
                texture.albedo.texels[3 * at + static_cast<std::size_t>(part)] = byte_of(own[part]);
            }
        }
    });
    if (drape != nullptr) { texture.albedo = draped(texture.albedo, *drape, ground.half_extent_m()); }
    texture.mean_colour = mean_lit(texture, daylight_of(settings));
    return texture;
}

scene::GroundTexture without_texels(const scene::GroundTexture& texture) {
    const auto bare = [](const scene::GroundImage& image) {
        return scene::GroundImage{image.width, image.height, {}, image.first_m, image.step_m};
    };
    return {bare(texture.albedo), bare(texture.normal), texture.mean_colour};
}

scene::GroundTextureTransforms ground_texture_transforms(const scene::GroundTexture& texture, const glm::dvec3& eye_m) {
    return {place_in(texture.albedo, eye_m), place_in(texture.normal, eye_m)};
}

} // namespace octant::visuals::landscape
