#include "visuals/raster/mask_picture.h"

#include "visuals/raster/sample_pattern.h"
#include "visuals/raster/tile.h"
#include "visuals/raster/triangle_binner.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace octant::visuals::raster {

namespace {

constexpr int cell_px = SamplePattern::lanes; ///< of the picture, for each pixel of the tile
constexpr int samples = SamplePattern::lanes;
constexpr glm::vec3 free_sample(66.0F);
constexpr glm::vec3 line_between(24.0F);
constexpr glm::vec3 cell_ground(34.0F);

/// For each sample of a tile the place of what covers it among the nearest triangles, from 1; 0: nothing. As many
/// triangles as it takes to cover half of all samples.
std::vector<std::size_t> covering(TileJob job, std::span<const TileTriangle> triangles, const SampleLanes& lanes) {
    std::vector<std::size_t> by_sample(TileBuffer::pixels * samples, 0);
    std::vector<std::uint8_t> rgba(TileBuffer::pixels * 4);
    const auto buffer = std::make_unique<TileBuffer>();
    job.rgba = rgba.data();
    job.row_bytes = std::size_t{4} * tile_width;
    for (std::size_t count = 1; count <= triangles.size(); ++count) {
        job.triangles = triangles.last(count);
        paint_tile(job, lanes, *buffer);
        std::size_t covered_samples = 0;
        for (std::size_t i = 0; i < by_sample.size(); ++i) {
            const bool covered = (buffer->covered[i / samples] >> (i % samples) & 1U) != 0;
            by_sample[i] = covered && by_sample[i] == 0 ? count : by_sample[i];
            covered_samples += covered ? 1 : 0;
        }
        if (2 * covered_samples >= by_sample.size()) { break; }
    }
    return by_sample;
}

/// Hues far apart for neighbours in the list.
glm::vec3 colour_of_place(std::size_t place) {
    const double turn = static_cast<double>(place) * 0.61803398875;
    const double sixths = 6.0 * (turn - std::floor(turn));
    glm::vec3 colour;
    for (glm::length_t k = 0; k < 3; ++k) {
        const double from = std::fmod(sixths + std::array{0.0, 4.0, 2.0}[static_cast<std::size_t>(k)], 6.0);
        colour[k] = static_cast<float>(80.0 + 175.0 * std::clamp(std::abs(from - 3.0) - 1.0, 0.0, 1.0));
    }
    return colour;
}

class Canvas {
public:
    Canvas() {
        picture_.width = tile_width * cell_px;
        picture_.height = tile_height * cell_px;
        picture_.rgba.assign(
            std::size_t{4} * static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height), 255);
    }

    void set(const glm::ivec2& at, const glm::vec3& colour) {
        const glm::ivec2 within = glm::clamp(at, glm::ivec2(0), glm::ivec2(picture_.width, picture_.height) - 1);
        const auto first = 4 * static_cast<std::size_t>(within.y * picture_.width + within.x);
        for (std::size_t k = 0; k < 3; ++k) {
            picture_.rgba[first + k] = static_cast<std::uint8_t>(colour[static_cast<glm::length_t>(k)]);
        }
    }

    const scene::Picture& picture() const { return picture_; }

private:
    scene::Picture picture_;
};

} // namespace

scene::Picture mask_picture(const scene::FramePlan& plan, std::span<const scene::ModelBuffers> models,
    const glm::ivec2& size_px, ThreadPool& workers) {
    assert(!plan.ground_texture);
    const SamplePattern pattern = sample_pattern(samples);
    const SampleLanes lanes(pattern);
    TriangleBinner work(pattern, workers);
    work.prepare({plan, models, nullptr, size_px});
    const int tile = work.tiles().y / 2 * work.tiles().x + work.tiles().x / 2;
    TileJob job;
    job.first_px = glm::ivec2(tile % work.tiles().x, tile / work.tiles().x) * glm::ivec2(tile_width, tile_height);
    job.size_px = glm::min(glm::ivec2(tile_width, tile_height), size_px - job.first_px);
    job.light = &work.light();
    std::vector<TileTriangle> list;
    const auto triangles = work.triangles_of(tile, list);
    const auto by_sample = covering(job, triangles, lanes);
    Canvas canvas;
    for (int y = 0; y < tile_height * cell_px; ++y) {
        for (int x = 0; x < tile_width * cell_px; ++x) {
            const bool on_line = x % cell_px == 0 || y % cell_px == 0;
            canvas.set({x, y}, on_line ? line_between : cell_ground);
        }
    }
    for (std::size_t i = 0; i < by_sample.size(); ++i) {
        const auto pixel = static_cast<int>(i / samples);
        const std::size_t lane = i % samples;
        const glm::ivec2 within(pattern.x[lane] + cell_px, pattern.y[lane] + cell_px);
        const glm::ivec2 at = cell_px * glm::ivec2(pixel % tile_width, pixel / tile_width) + within / 2;
        const glm::vec3 colour = by_sample[i] == 0 ? free_sample : colour_of_place(by_sample[i]);
        for (int k = 0; k < 9; ++k) { canvas.set(at + glm::ivec2(k % 3, k / 3) - 1, colour); }
    }
    return canvas.picture();
}

} // namespace octant::visuals::raster
