#include "sim/base/random_generator.h"
#include "tests/visuals/raster/reference_picture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace octant::visuals::raster {

namespace {

constexpr glm::ivec2 coverage_size_px{128, 64}; // powers of two: corners come out where they are put

/// Corners at 1/256 pixel, some far outside the picture, some on pixel middles.
glm::vec2 any_position(RandomGenerator& dice) {
    const auto along = [&](int most) {
        const bool on_middle = below(dice, 4) == 0;
        const int from = static_cast<int>(below(dice, static_cast<std::uint64_t>(most + 60))) - 30;
        const float part = on_middle ? 0.5F : static_cast<float>(below(dice, 256)) / 256.0F;
        return static_cast<float>(from) + part;
    };
    const float x = along(coverage_size_px.x);
    return {x, along(coverage_size_px.y)};
}

std::vector<FlatTriangle> any_triangles(std::uint64_t seed, int count) {
    RandomGenerator dice(seed);
    std::vector<FlatTriangle> triangles;
    for (int i = 0; i < count; ++i) {
        FlatTriangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            triangle.at_px[k] = any_position(dice);
            triangle.depth_m[k] = 4.0F;
        }
        if (below(dice, 3) == 0) { // a sliver
            triangle.at_px[2] = triangle.at_px[0] + glm::vec2(0.25F, 0.0625F);
        }
        // Its number: the renderer gives flat colours back as they are.
        triangle.colour.fill(static_cast<std::uint32_t>(i + 1) * 7U | 0xff000000U);
        triangles.push_back(triangle);
    }
    return triangles;
}

glm::ivec3 colour_of(std::uint32_t packed) { return {packed & 0xffU, packed >> 8 & 0xffU, packed >> 16 & 0xffU}; }

/// Samples of the picture whose colour differs from the reference, weighed by levels / 255.
double difference(const std::vector<FlatTriangle>& triangles, int samples) {
    FlatPlan plan(coverage_size_px);
    plan.paint(triangles);
    const scene::Picture picture = drawn(plan.plan(), coverage_size_px, samples);
    const std::vector<std::uint32_t> seen = covered_by(triangles, coverage_size_px, samples);
    double sum = 0.0;
    std::size_t next = 0;
    for (int y = 0; y < coverage_size_px.y; ++y) {
        for (int x = 0; x < coverage_size_px.x; ++x) {
            glm::dvec3 mean(0.0);
            for (int i = 0; i < samples; ++i) {
                const std::uint32_t number = seen[next++];
                if (number != 0) { mean += glm::dvec3(colour_of(triangles[number - 1].colour[0])); }
            }
            const glm::dvec3 apart = glm::dvec3(pixel(picture, x, y)) - mean / (1.0 * samples);
            for (glm::length_t k = 0; k < 3; ++k) {
                sum += std::max(std::abs(apart[k]) - 0.5001, 0.0); // rounding
            }
        }
    }
    return sum;
}

} // namespace

TEST_CASE("with one sample each pixel shows the last triangle that covers its middle") {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        CHECK(difference(any_triangles(seed, 60), 1) == 0.0);
    }
}

TEST_CASE("with four and sixteen samples a pixel is the mean of what its samples show") {
    // Crossings are known to 2^-16 pixel within a row: a sample may fall on the other side of an edge that it touches.
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        CHECK(difference(any_triangles(seed, 60), 4) <= 100.0);
        CHECK(difference(any_triangles(seed, 60), 16) <= 100.0);
    }
}

TEST_CASE("no line shows between neighbours, whatever their corners and samples") {
    for (const int samples : {1, 4, 16}) {
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            // A fan around any place inside, its rim outside the picture.
            RandomGenerator dice(seed);
            const glm::vec2 middle(static_cast<float>(below(dice, 128 * 256)) / 256.0F,
                static_cast<float>(below(dice, 64 * 256)) / 256.0F);
            std::vector<glm::vec2> rim;
            for (const auto& [from, to] :
                {std::pair(glm::vec2(-9, -9), glm::vec2(140, -9)), std::pair(glm::vec2(140, -9), glm::vec2(140, 80)),
                    std::pair(glm::vec2(140, 80), glm::vec2(-9, 80)),
                    std::pair(glm::vec2(-9, 80), glm::vec2(-9, -9))}) {
                float share = 0.0F;
                while (share < 1.0F) {
                    rim.push_back(from + (to - from) * share);
                    share += static_cast<float>(1 + below(dice, 60)) / 64.0F;
                }
            }
            std::vector<FlatTriangle> fan;
            for (std::size_t i = 0; i < rim.size(); ++i) {
                FlatTriangle triangle;
                triangle.at_px = {middle, rim[i], rim[(i + 1) % rim.size()]};
                fan.push_back(triangle);
            }
            FlatPlan plan(coverage_size_px);
            plan.paint(fan);
            const scene::Picture picture = drawn(plan.plan(), coverage_size_px, samples);
            int dark = 0;
            for (const std::uint8_t byte : picture.rgba) { dark += byte != 255 ? 1 : 0; }
            CAPTURE(samples, seed, middle.x, middle.y);
            CHECK(dark == 0);
        }
    }
}

TEST_CASE("a picture whose size is no multiple of the tiles is drawn to its last row and column") {
    constexpr glm::ivec2 odd_px{67, 35};
    FlatPlan plan(odd_px);
    plan.paint({{{glm::vec2(-300, -300), glm::vec2(900, -300), glm::vec2(-300, 900)}}});
    const scene::Picture picture = drawn(plan.plan(), odd_px, 16);
    CHECK(pixel(picture, 66, 34) == glm::ivec3(255));
    CHECK(pixel(picture, 0, 34) == glm::ivec3(255));
    CHECK(pixel(picture, 66, 0) == glm::ivec3(255));
}

TEST_CASE("corners behind the eye are cut away and the rest is seen") {
    FlatPlan plan(coverage_size_px);
    FlatTriangle triangle;
    triangle.at_px = {glm::vec2(64, 32), glm::vec2(-300, 400), glm::vec2(500, 400)};
    triangle.depth_m = {64.0F, 0.25F, 0.25F}; // nearer than the near plane
    plan.paint({triangle});
    const scene::Picture picture = drawn(plan.plan(), coverage_size_px, 16);
    CHECK(pixel(picture, 64, 60) == glm::ivec3(255));
    CHECK(pixel(picture, 64, 20) == glm::ivec3(0));
}

} // namespace octant::visuals::raster
