// Sums of gradient noise (K. Perlin, "Improving Noise", SIGGRAPH 2002) whose lattices divide the tile, so that it
// repeats without a seam.
#include "visuals/scene/detail_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace octant::visuals::scene {

namespace {

struct Octave {
    int cell_texels;
    float weight;
};

constexpr std::array octaves = {Octave{2, 0.55F}, Octave{4, 0.8F}, Octave{8, 0.9F}, Octave{16, 0.8F}, Octave{32, 0.75F},
    Octave{64, 0.6F}, Octave{128, 0.45F}};

/// Sixteen directions around, so that no lattice line is seen.
constexpr std::array<glm::vec2, 16> directions = {glm::vec2(1.0F, 0.0F), {0.924F, 0.383F}, {0.707F, 0.707F},
    {0.383F, 0.924F}, {0.0F, 1.0F}, {-0.383F, 0.924F}, {-0.707F, 0.707F}, {-0.924F, 0.383F}, {-1.0F, 0.0F},
    {-0.924F, -0.383F}, {-0.707F, -0.707F}, {-0.383F, -0.924F}, {0.0F, -1.0F}, {0.383F, -0.924F}, {0.707F, -0.707F},
    {0.924F, -0.383F}};

glm::vec2 direction_at(int column, int row, int salt) {
    std::uint32_t h = static_cast<std::uint32_t>(column) * 0x9e3779b1U ^ static_cast<std::uint32_t>(row) * 0x85ebca77U ^
                      static_cast<std::uint32_t>(salt) * 0xc2b2ae3dU;
    h = (h ^ (h >> 15U)) * 0x2c1b3c6dU;
    h = (h ^ (h >> 12U)) * 0x297a2d39U;
    return directions[(h ^ (h >> 15U)) >> 28U];
}

float eased(float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); }

/// Adds one octave's noise of a row of texels to their sums.
void add_octave(const Octave& octave, int row, std::vector<float>& sums) {
    const int cells = DetailPattern::side_texels / octave.cell_texels;
    const int south = row / octave.cell_texels;
    const int north = (south + 1) % cells;
    const auto by_cell = 1.0F / static_cast<float>(octave.cell_texels);
    const float v = (static_cast<float>(row % octave.cell_texels) + 0.5F) * by_cell;
    const float up = eased(v);
    for (int cell = 0; cell < cells; ++cell) {
        const int east = (cell + 1) % cells;
        const glm::vec2 a = direction_at(cell, south, octave.cell_texels);
        const glm::vec2 b = direction_at(east, south, octave.cell_texels);
        const glm::vec2 c = direction_at(cell, north, octave.cell_texels);
        const glm::vec2 d = direction_at(east, north, octave.cell_texels);
        for (int i = 0; i < octave.cell_texels; ++i) {
            const float u = (static_cast<float>(i) + 0.5F) * by_cell;
            const float right = eased(u);
            const float low = (1.0F - right) * (a.x * u + a.y * v) + right * (b.x * (u - 1.0F) + b.y * v);
            const float high =
                (1.0F - right) * (c.x * u + c.y * (v - 1.0F)) + right * (d.x * (u - 1.0F) + d.y * (v - 1.0F));
            sums[static_cast<std::size_t>(cell * octave.cell_texels + i)] += octave.weight * (low + up * (high - low));
        }
    }
}

/// Values of a level, row by row.
std::vector<float> make_noise() {
    const auto size = static_cast<std::size_t>(DetailPattern::side_texels);
    std::vector<float> noise;
    noise.reserve(size * size);
    std::vector<float> sums(size);
    for (int row = 0; row < DetailPattern::side_texels; ++row) {
        std::ranges::fill(sums, 0.0F);
        for (const Octave& octave : octaves) { add_octave(octave, row, sums); }
        noise.insert(noise.end(), sums.begin(), sums.end());
    }
    return noise;
}

std::vector<float> half_of(const std::vector<float>& noise, std::size_t size) {
    std::vector<float> half;
    half.reserve(noise.size() / 4);
    for (std::size_t row = 0; row < size; row += 2) {
        for (std::size_t at = row * size; at < (row + 1) * size; at += 2) {
            half.push_back(0.25F * ((noise[at] + noise[at + 1]) + (noise[at + size] + noise[at + size + 1])));
        }
    }
    return half;
}

/// Bytes of the mean and the deviation that all levels have; what lies beyond a byte is cut, a few texels in a
/// thousand.
DetailPattern level_of(const std::vector<float>& noise, int size) {
    double sum = 0.0;
    double squares = 0.0;
    for (const float value : noise) {
        sum += static_cast<double>(value);
        squares += static_cast<double>(value) * static_cast<double>(value);
    }
    const double mean = sum / static_cast<double>(noise.size());
    const double deviation = std::sqrt(squares / static_cast<double>(noise.size()) - mean * mean);
    const double contrast = 128.0 * DetailPattern::deviation / deviation;
    DetailPattern pattern;
    pattern.size = size;
    pattern.texels.reserve(noise.size());
    for (const float value : noise) {
        const double level = 128.5 + contrast * (static_cast<double>(value) - mean);
        pattern.texels.push_back(static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0)));
    }
    return pattern;
}

using Levels = std::array<DetailPattern, DetailPattern::levels_per_scale + 1>;

Levels make_mip_levels() {
    Levels levels;
    std::vector<float> noise = make_noise();
    int size = DetailPattern::side_texels;
    for (DetailPattern& level : levels) {
        level = level_of(noise, size);
        noise = half_of(noise, static_cast<std::size_t>(size));
        size /= 2;
    }
    return levels;
}

} // namespace

const Levels& detail_mip_levels() {
    static const Levels levels = make_mip_levels();
    return levels;
}

double detail_tile_m(int scale) {
    return std::exp2(DetailPattern::levels_per_scale * scale) * DetailPattern::side_texels /
           static_cast<double>(DetailPattern::texels_per_m);
}

glm::dvec2 detail_tile_position(const glm::dvec3& place_m, int scale) {
    const bool is_even = scale % 2 == 0;
    const glm::dvec2 lean_m = glm::dvec2(DetailPattern::shift_per_height) * place_m.z;
    const glm::dvec2 level_m = glm::dvec2(place_m) + (is_even ? lean_m : -lean_m);
    const glm::dvec2 turned_m = is_even ? level_m : glm::dvec2(level_m.y, -level_m.x);
    return turned_m / detail_tile_m(scale);
}

} // namespace octant::visuals::scene
