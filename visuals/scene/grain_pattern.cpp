// Sums of gradient noise (K. Perlin, "Improving Noise", SIGGRAPH 2002) whose lattices divide the
// tile, so that it repeats without a seam.
#include "visuals/scene/grain_pattern.h"

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

constexpr std::array octaves = {
    Octave{2, 0.55F},
    Octave{4, 0.8F},
    Octave{8, 0.9F},
    Octave{16, 0.8F},
    Octave{32, 0.75F},
    Octave{64, 0.6F},
    Octave{128, 0.45F}};

/// Levels a unit of noise: what lies beyond a byte is cut, a few texels in a thousand.
constexpr float contrast = 105.0F;

/// Sixteen directions around, so that no lattice line is seen.
constexpr std::array<glm::vec2, 16> directions = {
    glm::vec2(1.0F, 0.0F),
    {0.924F, 0.383F},
    {0.707F, 0.707F},
    {0.383F, 0.924F},
    {0.0F, 1.0F},
    {-0.383F, 0.924F},
    {-0.707F, 0.707F},
    {-0.924F, 0.383F},
    {-1.0F, 0.0F},
    {-0.924F, -0.383F},
    {-0.707F, -0.707F},
    {-0.383F, -0.924F},
    {0.0F, -1.0F},
    {0.383F, -0.924F},
    {0.707F, -0.707F},
    {0.924F, -0.383F}};

glm::vec2 direction_at(int column, int row, int salt) {
    std::uint32_t h = static_cast<std::uint32_t>(column) * 0x9e3779b1U ^
                      static_cast<std::uint32_t>(row) * 0x85ebca77U ^
                      static_cast<std::uint32_t>(salt) * 0xc2b2ae3dU;
    h = (h ^ (h >> 15U)) * 0x2c1b3c6dU;
    h = (h ^ (h >> 12U)) * 0x297a2d39U;
    return directions[(h ^ (h >> 15U)) >> 28U];
}

float eased(float t) {
    return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}

/// Adds one octave's noise of a row of texels to their sums.
void add_octave(const Octave& octave, int row, std::vector<float>& sums) {
    const int cells = GrainPattern::texels_a_side / octave.cell_texels;
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
            const float low =
                (1.0F - right) * (a.x * u + a.y * v) + right * (b.x * (u - 1.0F) + b.y * v);
            const float high = (1.0F - right) * (c.x * u + c.y * (v - 1.0F)) +
                               right * (d.x * (u - 1.0F) + d.y * (v - 1.0F));
            sums[static_cast<std::size_t>(cell * octave.cell_texels + i)] +=
                octave.weight * (low + up * (high - low));
        }
    }
}

GrainPattern made_pattern() {
    GrainPattern pattern;
    const auto size = static_cast<std::size_t>(pattern.size);
    pattern.texels.reserve(size * size);
    std::vector<float> sums(size);
    for (int row = 0; row < pattern.size; ++row) {
        std::ranges::fill(sums, 0.0F);
        for (const Octave& octave : octaves) {
            add_octave(octave, row, sums);
        }
        for (const float sum : sums) {
            const float level = std::clamp(128.5F + contrast * sum, 0.0F, 255.0F);
            pattern.texels.push_back(static_cast<std::uint8_t>(level));
        }
    }
    return pattern;
}

} // namespace

const GrainPattern& grain_pattern() {
    static const GrainPattern pattern = made_pattern();
    return pattern;
}

GrainPattern half_of(const GrainPattern& pattern) {
    GrainPattern half;
    half.size = pattern.size / 2;
    const auto texel = [&](int column, int row) {
        return static_cast<unsigned>(
            pattern.texels
                [static_cast<std::size_t>(row) * static_cast<std::size_t>(pattern.size) +
                 static_cast<std::size_t>(column)]);
    };
    for (int row = 0; row < pattern.size; row += 2) {
        for (int column = 0; column < pattern.size; column += 2) {
            const unsigned sum = texel(column, row) + texel(column + 1, row) +
                                 texel(column, row + 1) + texel(column + 1, row + 1);
            half.texels.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
        }
    }
    return half;
}

} // namespace octant::visuals::scene
