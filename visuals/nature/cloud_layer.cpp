#include "visuals/nature/cloud_layer.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

// Density is gradient-free value noise in octaves over a periodic lattice, of which the share `cover` lies above a
// threshold. Squares of cells lie around the eye like those of a geometry clipmap (Losasso and Hoppe 2004): each has
// cells of twice the size of the one inside it, and its corners take the values of the next one as they come near its
// edge, so that nothing jumps.

namespace octant::visuals::nature {

namespace {

constexpr double finest_cell_m = 64.0; ///< of the finest level
constexpr int period = 512;            ///< of the density, in those cells
constexpr int widest = 32;             ///< of the octaves of one cloud, in those cells
constexpr int weather = 128;           ///< the octave that gathers them
constexpr float max_density = 0.93F;   ///< of what is behind, a cloud leaves a little
constexpr double through_m = 25.0;     ///< so near the layer's height nothing of it is seen ...
constexpr double whole_m = 150.0;      ///< ... and so far from it all

std::size_t wrapped(std::int64_t index, int size) {
    const std::int64_t rest = index % size;
    return static_cast<std::size_t>(rest < 0 ? rest + size : rest);
}

/// A number 0..1 for a lattice point (SplitMix64's finalizer; Steele, Lea and Flood 2014).
float random_bits(std::uint64_t column, std::uint64_t row, std::uint64_t octave) {
    std::uint64_t z = (column * 0x9e3779b97f4a7c15ULL + row) * 0xd1b54a32d192ed03ULL + octave + 1;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return static_cast<float>((z ^ (z >> 31U)) >> 40U) / 16777216.0F;
}

float smooth(float share) { return share * share * (3.0F - 2.0F * share); }

/// Adds an octave whose lattice points lie `step` cells apart.
void add_octave(int step, float weight, std::vector<float>& field) {
    const int points = period / step;
    std::vector<float> lattice(static_cast<std::size_t>(points) * static_cast<std::size_t>(points));
    for (int row = 0; row < points; ++row) {
        for (int column = 0; column < points; ++column) {
            lattice[static_cast<std::size_t>(row * points + column)] = random_bits(
                static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row), static_cast<std::uint64_t>(step));
        }
    }
    const auto at = [&](int column, int row) {
        return lattice[wrapped(row, points) * static_cast<std::size_t>(points) + wrapped(column, points)];
    };
    for (int row = 0; row < period; ++row) {
        const int low = row / step;
        const float up = smooth(static_cast<float>(row % step) / static_cast<float>(step));
        for (int column = 0; column < period; ++column) {
            const int left = column / step;
            const float on = smooth(static_cast<float>(column % step) / static_cast<float>(step));
            field[static_cast<std::size_t>(row * period + column)] +=
                weight * glm::mix(glm::mix(at(left, low), at(left + 1, low), on),
                             glm::mix(at(left, low + 1), at(left + 1, low + 1), on), up);
        }
    }
}

/// From noise to density: in the share `cover` of all places it is half of the most or more.
void threshold_density(double cover, std::vector<float>& field) {
    std::vector<float> sorted = field;
    const auto place =
        static_cast<std::size_t>(std::clamp(1.0 - cover, 0.0, 1.0) * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(place), sorted.end());
    const float threshold = sorted[place];
    const auto [least, most] = std::ranges::minmax(field);
    const float soft = 0.14F * (most - least);
    for (float& value : field) {
        const float share = std::clamp((value - threshold) / soft + 0.5F, 0.0F, 1.0F);
        value = cover > 0.0 ? max_density * smooth(share) : 0.0F;
    }
}

/// The density of cells of twice the size: weights 1, 2, 1 along rows and columns.
std::vector<float> halved(const std::vector<float>& fine, int size) {
    const int half = size / 2;
    std::vector<float> coarse(static_cast<std::size_t>(half) * static_cast<std::size_t>(half));
    for (int row = 0; row < half; ++row) {
        for (int column = 0; column < half; ++column) {
            float sum = 0.0F;
            for (int down = -1; down <= 1; ++down) {
                for (int on = -1; on <= 1; ++on) {
                    const float weight = (down == 0 ? 2.0F : 1.0F) * (on == 0 ? 2.0F : 1.0F);
                    sum += weight * fine[wrapped(2 * row + down, size) * static_cast<std::size_t>(size) +
                                         wrapped(2 * column + on, size)];
                }
            }
            coarse[static_cast<std::size_t>(row * half + column)] = sum / 16.0F;
        }
    }
    return coarse;
}

} // namespace

CloudLayer::CloudLayer(double cover) {
    std::vector<float> field(static_cast<std::size_t>(period) * period, 0.0F);
    add_octave(weather, 0.8F, field);
    float weight = 1.0F;
    for (int step = widest; step >= 1; step /= 2, weight *= 0.58F) { add_octave(step, weight, field); }
    threshold_density(cover, field);
    density_[0] = std::move(field);
    for (int level = 1; level <= levels; ++level) {
        const auto finer = static_cast<std::size_t>(level - 1);
        density_[finer + 1] = halved(density_[finer], period >> (level - 1));
    }
}

void CloudLayer::set_daylight(const Daylight& day) {
    horizontal_to_sun_ = glm::vec2(day.horizontal_to_sun());
    bright_ = glm::min(0.75F * day.ambient() + 0.85F * day.sunlight(), glm::vec3(1.0F));
    dark_ = glm::min(0.65F * day.ambient() + 0.3F * day.sunlight(), glm::vec3(1.0F));
}

/// What a level has at a corner of its cells.
CloudLayer::Node CloudLayer::node(int level, std::int64_t column, std::int64_t row) const {
    const int size = period >> level;
    const std::vector<float>& density = density_[static_cast<std::size_t>(level)];
    const auto at = [&](std::int64_t x, std::int64_t y) {
        return density[wrapped(y, size) * static_cast<std::size_t>(size) + wrapped(x, size)];
    };
    const glm::vec2 rise(at(column + 1, row) - at(column - 1, row), at(column, row + 1) - at(column, row - 1));
    return {at(column, row), std::clamp(-glm::dot(rise, horizontal_to_sun_), -1.0F, 1.0F)};
}

/// The same, by this share that of the next level between its own corners.
CloudLayer::Node CloudLayer::blended_node(int level, std::int64_t column, std::int64_t row, float coarser) const {
    const Node own = node(level, column, row);
    if (coarser <= 0.0F || level + 1 >= levels) { return own; }
    // Rounded down: columns may be below zero.
    const std::int64_t left = column >> 1;
    const std::int64_t low = row >> 1;
    const Node a = node(level + 1, left, low);
    const Node b = node(level + 1, left + (column & 1), low + (row & 1));
    return {glm::mix(own.density, 0.5F * (a.density + b.density), coarser),
        glm::mix(own.light, 0.5F * (a.light + b.light), coarser)};
}

/// From below thick clouds are dark, from above the sun's side is bright.
models::ColourVertex CloudLayer::vertex(
    const Node& node, const glm::dvec3& at_m, bool from_above, float thinning) const {
    const float thick = node.density / max_density;
    const float lit = from_above ? 0.92F + 0.5F * node.light : 1.0F - 0.65F * thick * thick + 0.25F * node.light;
    const glm::vec3 colour = glm::mix(dark_, bright_, std::clamp(lit, 0.0F, 1.0F));
    const auto alpha =
        static_cast<std::uint32_t>(std::lround(255.0F * std::clamp(node.density * thinning, 0.0F, 1.0F)));
    return {glm::vec3(at_m), (models::packed_colour(colour) & 0x00ffffffU) | (alpha << 24U)};
}

void CloudLayer::add_level(int level, const glm::dvec3& eye_m, double height_m, double earth_radius_m) {
    const double size_m = finest_cell_m * static_cast<double>(1 << level);
    const auto first_of = [&](double place_m, double own_m) {
        return 2 * static_cast<std::int64_t>(std::floor(place_m / (2.0 * own_m))) - side / 2;
    };
    const std::int64_t first_x = first_of(eye_m.x, size_m);
    const std::int64_t first_y = first_of(eye_m.y, size_m);
    // The square of the level inside, in this level's cells.
    const std::int64_t hole_x = first_of(eye_m.x, 0.5 * size_m) / 2 - first_x;
    const std::int64_t hole_y = first_of(eye_m.y, 0.5 * size_m) / 2 - first_y;
    const double through = glm::smoothstep(through_m, whole_m, std::abs(eye_m.z - height_m));
    const auto first_vertex = static_cast<std::uint32_t>(vertices_.size());
    for (int row = 0; row < nodes_per_side; ++row) {
        for (int column = 0; column < nodes_per_side; ++column) {
            const std::int64_t x = first_x + column;
            const std::int64_t y = first_y + row;
            glm::dvec3 at_m(static_cast<double>(x) * size_m - eye_m.x, static_cast<double>(y) * size_m - eye_m.y,
                height_m - eye_m.z);
            const double away_m = glm::length(glm::dvec2(at_m));
            const double off = std::max(std::abs(at_m.x), std::abs(at_m.y)) / (size_m * side / 2);
            const auto coarser = static_cast<float>(glm::smoothstep(0.55, 0.86, off));
            const double thinning = through * (1.0 - glm::smoothstep(0.6, 0.95, away_m / reach_m));
            if (earth_radius_m > 0.0) { at_m.z -= away_m * away_m / (2.0 * earth_radius_m); }
            vertices_.push_back(
                vertex(blended_node(level, x, y, coarser), at_m, eye_m.z > height_m, static_cast<float>(thinning)));
        }
    }
    const auto alpha_at = [&](std::uint32_t corner) { return vertices_[corner].colour >> 24U; };
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const bool inside =
                level > 0 && column >= hole_x && column < hole_x + side / 2 && row >= hole_y && row < hole_y + side / 2;
            const auto a = first_vertex + static_cast<std::uint32_t>(row * nodes_per_side + column);
            const std::uint32_t b = a + 1;
            const std::uint32_t d = a + nodes_per_side;
            const std::uint32_t c = d + 1;
            if (!inside && (alpha_at(a) | alpha_at(b) | alpha_at(c) | alpha_at(d)) != 0) {
                indices_.insert(indices_.end(), {a, b, c, a, c, d});
            }
        }
    }
}

CloudLayer::Triangles CloudLayer::seen_from(const glm::dvec3& eye_m, double height_m, double earth_radius_m) {
    vertices_.clear();
    indices_.clear();
    for (int level = 0; level < levels; ++level) { add_level(level, eye_m, height_m, earth_radius_m); }
    return {vertices_, indices_};
}

} // namespace octant::visuals::nature
