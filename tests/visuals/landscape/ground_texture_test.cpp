#include "visuals/landscape/ground_palette.h"
#include "visuals/landscape/ground_texture_maker.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using namespace octant;
using namespace octant::visuals::landscape;
using namespace octant::visuals::scene;
namespace terrain = octant::visuals::terrain;

namespace {

models::heights::HeightField rugged() {
    std::vector<float> heights_m;
    for (int i = 0; i < 9 * 7; ++i) { heights_m.push_back(static_cast<float>(i * i % 97) * 2.0F - 20.0F); }
    return {9, 7, 50.0, heights_m};
}

std::array<int, 3> colour(const GroundImage& image, int column, int row) {
    const std::size_t at =
        3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(column));
    return {image.texels[at], image.texels[at + 1], image.texels[at + 2]};
}

/// Which texel lies below the eye, from the middle of the south-western one.
glm::dvec2 texel_below(const GroundImage& image, const TextureTransform& place) {
    return glm::dvec2(place.at_eye) * glm::dvec2(image.width, image.height) - 0.5;
}

} // namespace

TEST_CASE("the texture under its light shows each sample as the lit vertex does, at its place") {
    const models::heights::HeightField field = rugged();
    const Settings settings;
    const GroundTexture texture = ground_texture(terrain::GroundSamples(field), settings.air, nullptr);
    const std::vector<std::uint32_t> lit = ground_colours(field, settings.air);
    const visuals::nature::Daylight day = daylight_of(settings.air);
    REQUIRE(texture.normal.width == 9);
    REQUIRE(texture.normal.height == 7);
    for (int row = 0; row < 7; ++row) {
        for (int column = 0; column < 9; ++column) {
            const auto at = static_cast<std::size_t>(row * 9 + column);
            const glm::vec2 slope(static_cast<float>(texture.normal.texels[2 * at] - 128) / 127.0F,
                static_cast<float>(texture.normal.texels[2 * at + 1] - 128) / 127.0F);
            const glm::vec3 normal(slope, std::sqrt(1.0F - glm::dot(slope, slope)));
            const std::array<int, 3> own = colour(texture.albedo, column, row);
            for (std::size_t part = 0; part < 3; ++part) {
                const float expected = static_cast<float>((lit[at] >> (8 * part)) & 255U);
                const float shown =
                    std::min(static_cast<float>(own[part]) * illumination(normal, day)[static_cast<int>(part)], 255.0F);
                CHECK(shown == Approx(expected).margin(4.0));
            }
            const GroundTextureTransforms places = ground_texture_transforms(texture, field.sample_m(column, row));
            const glm::dvec2 texel = texel_below(texture.albedo, places.albedo);
            CHECK(texel.x == Approx(column).margin(1e-4));
            CHECK(texel.y == Approx(row).margin(1e-4));
        }
    }
    const glm::vec3 mean = mean_colour(lit);
    for (int part = 0; part < 3; ++part) { CHECK(texture.mean_colour[part] == Approx(mean[part]).margin(0.01)); }
}

TEST_CASE("level ground has a normal that is exactly upright") {
    const models::heights::HeightField field(3, 3, 10.0, std::vector<float>(9, -1.0F));
    for (const std::uint8_t part : ground_texture(terrain::GroundSamples(field), {}, nullptr).normal.texels) {
        CHECK(int{part} == 128);
    }
}

TEST_CASE("a drape lies north up from edge to edge and lets the ground through where it has none") {
    const models::heights::HeightField field = rugged();
    models::heights::Image drape;
    drape.width = 2;
    drape.height = 2;
    drape.rgba = {255, 0, 0, 255,
        /* north-east */ 0, 255, 0, 255,
        /* south-west */ 0, 0, 255, 255,
        /* nothing */ 9, 9, 9, 0};
    const GroundTexture texture = ground_texture(terrain::GroundSamples(field), {}, &drape);
    const GroundTexture bare = ground_texture(terrain::GroundSamples(field), {}, nullptr);
    CHECK(colour(texture.albedo, 0, 1) == std::array{255, 0, 0});
    CHECK(colour(texture.albedo, 1, 1) == std::array{0, 255, 0});
    CHECK(colour(texture.albedo, 0, 0) == std::array{0, 0, 255});
    CHECK(colour(texture.albedo, 1, 0) == colour(bare.albedo, 6, 2)); // 100 m east, 75 m south
    CHECK(texture.normal.texels == bare.normal.texels);
    const auto corner = ground_texture_transforms(texture, {-200.0, 150.0, 0.0}).albedo;
    CHECK(corner.at_eye.x == Approx(0.0).margin(1e-6));
    CHECK(corner.at_eye.y == Approx(1.0));
    CHECK(corner.per_m.x * 400.0F == Approx(1.0));
    CHECK(corner.per_m.y * 300.0F == Approx(1.0));
}

TEST_CASE("a texel of ground sampled at a stride has the mean slope of its surroundings") {
    std::vector<float> heights_m;
    for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 8194; ++column) {
            const int bump = column % 2 == 0 ? 0 : 40; // between the texels
            heights_m.push_back(static_cast<float>(2 * column + bump));
        }
    }
    const models::heights::HeightField field(8194, 2, 10.0, heights_m);
    const GroundTexture texture = ground_texture(terrain::GroundSamples(field), {}, nullptr);
    const double slope = -0.2 / std::sqrt(1.0 + 0.2 * 0.2);
    for (const std::size_t texel : {std::size_t{1}, std::size_t{2000}, std::size_t{4095}}) {
        CHECK(texture.normal.texels[2 * texel] == 128 + std::lround(127.0 * slope));
    }
}

TEST_CASE("a field of more samples than a texture may have is sampled at a stride") {
    const models::heights::HeightField field(8194, 2, 10.0, std::vector<float>(2 * 8194, 5.0F));
    const GroundTexture texture = ground_texture(terrain::GroundSamples(field), {}, nullptr);
    CHECK(texture.normal.width == 4097);
    CHECK(texture.normal.step_m.x == 20.0);
    const glm::dvec2 texel =
        texel_below(texture.normal, ground_texture_transforms(texture, field.sample_m(8192, 0)).normal);
    CHECK(texel.x == Approx(4096.0).margin(0.01));
}
