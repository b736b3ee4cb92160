// Sums of gradient noise in space (K. Perlin, "Improving Noise", SIGGRAPH 2002) whose lattices divide the cube, so that
// it repeats without a seam.
#include "visuals/scene/detail_pattern.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace octant::visuals::scene {

namespace {

/// Noise whose features are as wide as a cell of its lattice, texels of the level that shows it.
struct Octave {
    int cell_texels;
    float weight;
};

constexpr std::array octaves = {
    Octave{DetailPattern::min_feature_texels, 0.3F}, Octave{8, 0.65F}, Octave{16, 1.0F}, Octave{32, 1.0F}};

/// Directions all around: two parts of one size and one of twice that, then (1, 1, 1), of length 1.
std::array<glm::vec3, 32> make_directions() {
    std::array<glm::vec3, 32> directions{};
    const float sixth = 1.0F / std::sqrt(6.0F);
    const float third = 1.0F / std::sqrt(3.0F);
    for (unsigned i = 0; i < directions.size(); ++i) {
        const glm::vec3 signs((i & 1U) != 0 ? -1.0F : 1.0F, (i & 2U) != 0 ? -1.0F : 1.0F, (i & 4U) != 0 ? -1.0F : 1.0F);
        glm::vec3 sizes(i < 24U ? sixth : third);
        if (i < 24U) { sizes[static_cast<glm::length_t>(i / 8U)] *= 2.0F; }
        directions[i] = signs * sizes;
    }
    return directions;
}

/// A lattice's directions at its points, `cells` along a side.
std::vector<glm::vec3> lattice_of(int cells, int salt) {
    const std::array<glm::vec3, 32> directions = make_directions();
    std::vector<glm::vec3> lattice;
    const auto points = static_cast<std::uint32_t>(cells * cells * cells);
    lattice.reserve(points);
    for (std::uint32_t point = 0; point < points; ++point) {
        std::uint32_t h = point * 0x9e3779b1U ^ static_cast<std::uint32_t>(salt) * 0xc2b2ae3dU;
        h = (h ^ (h >> 15U)) * 0x2c1b3c6dU;
        h = (h ^ (h >> 12U)) * 0x297a2d39U;
        lattice.push_back(directions[(h ^ (h >> 15U)) >> 27U]);
    }
    return lattice;
}

float eased(float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); }

/// Adds the noise of one octave to the texels of a level of a size.
void add_octave(const Octave& octave, int salt, int size, std::vector<float>& texels) {
    const int cells = size / octave.cell_texels;
    const std::vector<glm::vec3> lattice = lattice_of(cells, salt);
    const float by_cell = 1.0F / static_cast<float>(octave.cell_texels);
    const auto part_of = [&](int texel) { return (static_cast<float>(texel % octave.cell_texels) + 0.5F) * by_cell; };
    std::size_t at = 0;
    for (int z = 0; z < size; ++z) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x, ++at) {
                const glm::vec3 part(part_of(x), part_of(y), part_of(z));
                float sum = 0.0F;
                for (int corner = 0; corner < 8; ++corner) {
                    const glm::ivec3 far(corner & 1, corner >> 1 & 1, corner >> 2);
                    const glm::ivec3 cell = (glm::ivec3(x, y, z) / octave.cell_texels + far) % cells;
                    const glm::vec3 from = part - glm::vec3(far);
                    float share = 1.0F;
                    for (glm::length_t axis = 0; axis < 3; ++axis) {
                        const float away = eased(part[axis]);
                        share *= far[axis] != 0 ? away : 1.0F - away;
                    }
                    const auto number = static_cast<std::size_t>((cell.z * cells + cell.y) * cells + cell.x);
                    const glm::vec3& gradient = lattice[number];
                    sum += share * (gradient.x * from.x + gradient.y * from.y + gradient.z * from.z);
                }
                texels[at] += octave.weight * sum;
            }
        }
    }
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

/// The same features have the same noise in all levels.
Levels make_mip_levels() {
    Levels levels;
    int halvings = 0;
    for (DetailPattern& level : levels) {
        const int size = DetailPattern::side_texels >> halvings;
        std::vector<float> noise(static_cast<std::size_t>(size * size * size));
        for (const Octave& octave : octaves) {
            if (octave.cell_texels < size) { add_octave(octave, octave.cell_texels << halvings, size, noise); }
        }
        level = level_of(noise, size);
        ++halvings;
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

double detail_texels_per_m(double focal_px) {
    const double finer = std::clamp(focal_px / DetailPattern::nominal_focal_px, 1.0, 2.0);
    return static_cast<double>(DetailPattern::texels_per_m) * finer;
}

glm::dvec3 detail_tile_position(const glm::dvec3& place_m, int scale) {
    const auto& axes = DetailPattern::axes;
    const glm::dvec3 along(glm::dot(axes[0], place_m), glm::dot(axes[1], place_m), glm::dot(axes[2], place_m));
    const auto axis = [&](int number) { return along[(number + scale) % 3]; };
    return glm::dvec3(axis(0), axis(1), axis(2)) / detail_tile_m(scale);
}

} // namespace octant::visuals::scene
