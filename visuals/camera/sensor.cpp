#include "visuals/camera/sensor.h"

#include "sim/base/hash.h"
#include "sim/base/units.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace octant::visuals::camera {

// Tables are made by additions, multiplications, divisions and square roots alone, which give the same bits on every
// processor.

namespace {

constexpr int full = 65535;

/// The root of that degree of a number from 0 to about 1, by Newton's method from `start`.
double root(double number, int degree, double start) {
    double at = std::max(start, 1e-3);
    for (int i = 0; i < 60; ++i) {
        double power = 1.0;
        for (int k = 1; k < degree; ++k) { power *= at; }
        const double next = ((degree - 1) * at + number / power) / degree;
        if (std::abs(next - at) <= 1e-15 * at) { return next; }
        at = next;
    }
    return at;
}

constexpr double linear_below = 0.04045; ///< of a display value
constexpr double linear_slope = 12.92;

/// Light of each display value.
std::vector<float> light_table() {
    std::vector<float> table;
    table.reserve(full + 1);
    double fifth_root = 0.3;
    for (int i = 0; i <= full; ++i) {
        const double value = static_cast<double>(i) / full;
        if (value <= linear_below) {
            table.push_back(static_cast<float>(value / linear_slope));
            continue;
        }
        const double square = (value + 0.055) / 1.055 * ((value + 0.055) / 1.055);
        fifth_root = root(square, 5, fifth_root);
        table.push_back(static_cast<float>(square * fifth_root));
    }
    return table;
}

constexpr int root_steps = 4096;

/// Display values, 1 = full, for evenly spaced square roots of light; they bend little between.
std::vector<float> value_table() {
    std::vector<float> table;
    table.reserve(root_steps + 2);
    double cube_root = 0.1;
    for (int i = 0; i <= root_steps; ++i) {
        const double light_root = static_cast<double>(i) / root_steps;
        const double light = light_root * light_root;
        double value = light * linear_slope;
        if (value > linear_below) {
            cube_root = root(light * light * light_root, 3, cube_root);
            value = 1.055 * std::sqrt(cube_root) - 0.055;
        }
        table.push_back(static_cast<float>(value));
    }
    table.push_back(table.back());
    return table;
}

const std::vector<float>& lights() {
    static const std::vector<float> table = light_table();
    return table;
}

const std::vector<float>& values() {
    static const std::vector<float> table = value_table();
    return table;
}

/// The share of a normal distribution between its mean and `at` standard deviations, and its density there.
struct Normal {
    double share = 0.0;
    double density = 0.0;
};

Normal normal_at(double at) {
    const double half_square = 0.5 * at * at;
    double exponential = 1.0; // of half_square
    double exponential_term = 1.0;
    double share = at;
    double share_term = at;
    for (int n = 1; n < 60; ++n) {
        exponential_term *= half_square / n;
        exponential += exponential_term;
        share_term *= -half_square / n;
        share += share_term / (2 * n + 1);
    }
    const double density_of_mean = 1.0 / std::sqrt(2.0 * pi);
    return {density_of_mean * share, density_of_mean / exponential};
}

constexpr std::size_t deviates = 1024;

/// Normal deviates that are equally likely, divided by the square root of 2: the sum of two of them has the variance 1.
std::array<float, deviates> deviate_table() {
    std::array<double, deviates / 2> above{};
    double at = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < above.size(); ++i) {
        const double wanted = (static_cast<double>(i) + 0.5) / deviates;
        for (int step = 0; step < 20; ++step) {
            const Normal here = normal_at(at);
            at += (wanted - here.share) / here.density;
        }
        above[i] = at;
        squares += at * at;
    }
    const double scale = std::sqrt(static_cast<double>(above.size()) / squares / 2.0);
    std::array<float, deviates> table{};
    for (std::size_t i = 0; i < above.size(); ++i) {
        table[deviates / 2 + i] = static_cast<float>(above[i] * scale);
        table[deviates / 2 - 1 - i] = -table[deviates / 2 + i];
    }
    return table;
}

const std::array<float, deviates>& deviate_values() {
    static const std::array<float, deviates> table = deviate_table();
    return table;
}

/// Normal deviates of a pixel: one for each colour, from a number of 64 random bits.
std::array<float, 3> deviates_of(std::uint64_t bits, const std::array<float, deviates>& table) {
    const auto one = [&](unsigned shift) { return table[bits >> shift & (deviates - 1)]; };
    return {one(0) + one(10), one(20) + one(30), one(40) + one(50)};
}

/// Neighbours in a sequence of numbers that are scrambled lie that far apart.
constexpr std::uint64_t stride = 0x9e3779b97f4a7c15ULL;

} // namespace

float light_of(std::uint16_t colour) { return lights()[colour]; }

std::uint16_t colour_of(float light) {
    const std::vector<float>& table = values();
    const float at = std::sqrt(std::clamp(light, 0.0F, 1.0F)) * root_steps;
    const auto below = static_cast<std::size_t>(at);
    const float share = at - static_cast<float>(below);
    const float value = table[below] + (table[below + 1] - table[below]) * share;
    return static_cast<std::uint16_t>(value * static_cast<float>(full) + 0.5F);
}

void add_light(std::span<const std::uint16_t> colours, std::span<float> sums) {
    assert(colours.size() == sums.size());
    const std::vector<float>& table = lights();
    for (std::size_t i = 0; i < colours.size(); ++i) { sums[i] += table[colours[i]]; }
}

void Sensor::develop(
    std::span<const float> sums, int count, const NoiseKey& key, std::span<std::uint16_t> colours) const {
    assert(colours.size() == sums.size() && sums.size() % 3 == 0);
    const auto factor = static_cast<float>(exposure / count);
    if (noise == 0.0) {
        for (std::size_t i = 0; i < sums.size(); ++i) { colours[i] = colour_of(sums[i] * factor); }
        return;
    }
    constexpr double grey = 0.5;
    constexpr double photon_share = 15.0 / 16.0;
    const auto grey_colour = static_cast<std::size_t>(grey * full + 0.5);
    const double grey_light = lights()[grey_colour];
    // The light that a colour's change by its share stands for, at grey.
    constexpr std::size_t side = 256;
    const double slope =
        (lights()[grey_colour + side] - lights()[grey_colour - side]) / (2.0 * static_cast<double>(side) / full);
    const double deviation = noise * slope;
    const auto per_light = static_cast<float>(deviation * deviation * photon_share / grey_light);
    const auto reading = static_cast<float>(deviation * deviation * (1.0 - photon_share));
    const std::array<float, deviates>& table = deviate_values();
    const std::uint64_t first = scrambled64(scrambled64(key.seed + stride) + key.picture);
    for (std::size_t pixel = 0; pixel < sums.size() / 3; ++pixel) {
        const auto deviate = deviates_of(scrambled64(first + pixel * stride), table);
        for (std::size_t k = 0; k < 3; ++k) {
            const float light = sums[3 * pixel + k] * factor;
            colours[3 * pixel + k] = colour_of(light + std::sqrt(light * per_light + reading) * deviate[k]);
        }
    }
}

void to_bytes(std::span<const std::uint16_t> colours, std::span<std::uint8_t> bytes) {
    assert(colours.size() == bytes.size());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        bytes[i] = static_cast<std::uint8_t>((colours[i] * 255U + 32767U) / 65535U);
    }
}

} // namespace octant::visuals::camera
