// Open ground: a sum of gradient noise in space (K. Perlin, "Improving Noise", SIGGRAPH 2002) and of small domes.
// Crowns: large and small domes. Domes: the highest of paraboloids around points, one at random in each cell of a
// lattice (S. Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996). All lattices divide the cube, so that it
// repeats without a seam. Coarser levels are filtered from the first one.
#include "visuals/scene/detail_pattern.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>

namespace octant::visuals::scene {

namespace {

/// The values of a cube's texels, `size` along a side.
struct Field {
    int size = 0;
    std::vector<float> values;

    explicit Field(int side) : size(side), values(static_cast<std::size_t>(side * side * side)) {}

    /// Beyond the cube it goes on from the start; its size is a power of two.
    std::size_t index(const glm::ivec3& at) const {
        const int last = size - 1;
        return static_cast<std::size_t>(((at.z & last) * size + (at.y & last)) * size + (at.x & last));
    }
};

/// Sets each value by its texel's indices.
template <class ValueAt>
void fill(Field& field, const ValueAt& value_at) {
    std::size_t i = 0;
    for (int z = 0; z < field.size; ++z) {
        for (int y = 0; y < field.size; ++y) {
            for (int x = 0; x < field.size; ++x) { field.values[i++] = value_at(glm::ivec3(x, y, z)); }
        }
    }
}

/// Less its mean, with this standard deviation.
void normalize(Field& field, float deviation) {
    double sum = 0.0;
    double squares = 0.0;
    for (const float value : field.values) {
        sum += static_cast<double>(value);
        squares += static_cast<double>(value) * static_cast<double>(value);
    }
    const auto count = static_cast<double>(field.values.size());
    const double mean = sum / count;
    const double factor = static_cast<double>(deviation) / std::sqrt(squares / count - mean * mean);
    for (float& value : field.values) { value = static_cast<float>((static_cast<double>(value) - mean) * factor); }
}

/// 32 bits of noise.
std::uint32_t hashed(std::uint32_t number, int salt) {
    std::uint32_t h = number * 0x9e3779b1U ^ static_cast<std::uint32_t>(salt) * 0xc2b2ae3dU;
    h = (h ^ (h >> 15U)) * 0x2c1b3c6dU;
    h = (h ^ (h >> 12U)) * 0x297a2d39U;
    return h ^ (h >> 15U);
}

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

float eased(float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); }

/// Noise whose features are as wide as a cell of its lattice.
Field gradient_noise(int cell_texels, int size) {
    const int cells = size / cell_texels;
    const std::array<glm::vec3, 32> directions = make_directions();
    std::vector<glm::vec3> lattice;
    const auto points = static_cast<std::uint32_t>(cells * cells * cells);
    lattice.reserve(points);
    for (std::uint32_t point = 0; point < points; ++point) {
        lattice.push_back(directions[hashed(point, cell_texels) >> 27U]);
    }
    const auto direction = [&](const glm::ivec3& point) {
        const glm::ivec3 in_cube = point % cells;
        return lattice[static_cast<std::size_t>((in_cube.z * cells + in_cube.y) * cells + in_cube.x)];
    };
    const float by_cell = 1.0F / static_cast<float>(cell_texels);
    const auto part_at = [&](int at) { return (static_cast<float>(at % cell_texels) + 0.5F) * by_cell; };
    Field field(size);
    std::size_t texel = 0;
    for (int row = 0; row < size * size; ++row) {
        const glm::vec2 part(part_at(row % size), part_at(row / size));
        const glm::vec2 away(eased(part.x), eased(part.y));
        for (int cell = 0; cell < cells; ++cell) {
            // Along a row the noise of a side of a cell is linear.
            std::array<float, 2> first{};
            std::array<float, 2> slope{};
            for (int corner = 0; corner < 8; ++corner) {
                const glm::ivec3 far(corner & 1, corner >> 1 & 1, corner >> 2);
                const glm::vec3 to =
                    direction(glm::ivec3(cell, row % size / cell_texels, row / size / cell_texels) + far);
                const float share = (far.y == 1 ? away.x : 1.0F - away.x) * (far.z == 1 ? away.y : 1.0F - away.y);
                const auto side = static_cast<std::size_t>(far.x);
                const glm::vec2 off = part - glm::vec2(far.y, far.z);
                first[side] += share * (to.y * off.x + to.z * off.y - to.x * static_cast<float>(far.x));
                slope[side] += share * to.x;
            }
            for (int at = 0; at < cell_texels; ++at) {
                const float along = part_at(at);
                field.values[texel++] =
                    glm::mix(first[0] + slope[0] * along, first[1] + slope[1] * along, eased(along));
            }
        }
    }
    return field;
}

/// Heights of paraboloids of unlike height, `cells` along a side.
Field domes(int cells, int size) {
    constexpr float height_spread = 0.6F; // a dome is one high at its foot, a cell's width away
    constexpr float place_spread = 1.0F;  // of a cell
    const auto part = [](std::uint32_t bits) { return static_cast<float>(bits >> 8U) * (1.0F / 16777216.0F); };
    const float cells_a_texel = static_cast<float>(cells) / static_cast<float>(size);
    const auto place_of = [&](int texel) { return (static_cast<float>(texel) + 0.5F) * cells_a_texel; };
    const auto first_in = [&](int cell) { // texel
        int texel = cell * size / cells - 1;
        while (place_of(texel) < static_cast<float>(cell)) { ++texel; }
        return texel;
    };
    Field field(size);
    std::ranges::fill(field.values, -9.0F);
    const auto points = static_cast<std::uint32_t>(cells * cells * cells);
    for (std::uint32_t i = 0; i < points; ++i) {
        const auto number = static_cast<int>(i);
        const glm::ivec3 cell(number % cells, number / cells % cells, number / cells / cells);
        const glm::vec3 spread(
            part(hashed(4 * i, cells)), part(hashed(4 * i + 1, cells)), part(hashed(4 * i + 2, cells)));
        const glm::vec3 middle = glm::vec3(cell) + 0.5F + place_spread * (spread - 0.5F);
        const float height = height_spread * part(hashed(4 * i + 3, cells));
        // It is seen in its cell and in those around it.
        const glm::ivec3 from(first_in(cell.x - 1), first_in(cell.y - 1), first_in(cell.z - 1));
        const glm::ivec3 end(first_in(cell.x + 2), first_in(cell.y + 2), first_in(cell.z + 2));
        const auto squared = [](float value) { return value * value; };
        for (int z = from.z; z < end.z; ++z) {
            const float at_z = height - squared(place_of(z) - middle.z);
            for (int y = from.y; y < end.y; ++y) {
                const float at_y = at_z - squared(place_of(y) - middle.y);
                float* const row = &field.values[field.index({0, y, z})];
                for (int x = from.x; x < end.x; ++x) {
                    float& highest = row[x & (size - 1)];
                    highest = std::max(highest, at_y - squared(place_of(x) - middle.x));
                }
            }
        }
    }
    return field;
}

void add(Field part, float deviation, Field& sum) {
    normalize(part, deviation);
    for (std::size_t i = 0; i < sum.values.size(); ++i) { sum.values[i] += part.values[i]; }
}

/// Without the sun's light.
struct Reliefs {
    Field open{DetailPattern::side_texels};
    Field crowns{DetailPattern::side_texels};

    Reliefs() {
        constexpr int size = DetailPattern::side_texels;
        add(gradient_noise(4, size), 0.13F, open);
        add(gradient_noise(8, size), 0.46F, open);
        add(gradient_noise(16, size), 0.8F, open);
        add(gradient_noise(32, size), 0.5F, open);
        add(domes(9, size), 0.4F, open);
        add(domes(5, size), 1.0F, crowns);
        add(domes(3, size), 0.9F, crowns);
        add(gradient_noise(32, size), 0.8F, crowns);
    }
};

const Reliefs& reliefs() {
    static const Reliefs reliefs;
    return reliefs;
}

/// A relief and its light: by how much it is lower on the sun's side. `to_sun`: texels along the cube's axes.
Field lit(const Field& relief, const glm::vec3& to_sun, float light) {
    const auto shifted = [&](const glm::vec3& by) {
        const glm::vec3 low = glm::floor(by);
        const glm::vec3 part = by - low;
        std::array<glm::ivec3, 8> off{};
        std::array<float, 8> share{};
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const glm::ivec3 far(corner & 1U, corner >> 1U & 1U, corner >> 2U);
            off[corner] = glm::ivec3(low) + far;
            const glm::vec3 shares = glm::mix(1.0F - part, part, glm::vec3(far));
            share[corner] = shares.x * shares.y * shares.z;
        }
        return [&relief, off, share](const glm::ivec3& at) {
            float sum = 0.0F;
            for (std::size_t corner = 0; corner < 8; ++corner) {
                sum += share[corner] * relief.values[relief.index(at + off[corner])];
            }
            return sum;
        };
    };
    const auto towards = shifted(to_sun);
    const auto away = shifted(-to_sun);
    Field slopes(relief.size);
    fill(slopes, [&](const glm::ivec3& at) { return away(at) - towards(at); });
    Field sum = relief;
    normalize(sum, 1.0F);
    add(std::move(slopes), light, sum);
    return sum;
}

/// Each value is a mean of its own and those beside it, along each axis.
Field smoothed(const Field& field, const std::array<float, 3>& shares) {
    Field from = field;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        glm::ivec3 beside(0);
        beside[axis] = 1;
        Field to(field.size);
        fill(to, [&](const glm::ivec3& at) {
            return shares[0] * from.values[from.index(at - beside)] + shares[1] * from.values[from.index(at)] +
                   shares[2] * from.values[from.index(at + beside)];
        });
        from = std::move(to);
    }
    return from;
}

/// Half as many texels a side.
Field halved(const Field& field) {
    const Field smooth = smoothed(field, {0.25F, 0.5F, 0.25F});
    Field half(field.size / 2);
    fill(half, [&](const glm::ivec3& at) {
        float sum = 0.0F;
        for (int corner = 0; corner < 8; ++corner) {
            sum += smooth.values[smooth.index(2 * at + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2))];
        }
        return 0.125F * sum;
    });
    return half;
}

/// Bytes in the order of the values, of a normal distribution with the deviation that all levels have.
std::vector<std::uint8_t> normally_distributed(const Field& field) {
    constexpr std::size_t bins = 1U << 14U;
    const auto [min, max] = std::minmax_element(field.values.begin(), field.values.end());
    const float low = *min;
    const float bins_per_unit = static_cast<float>(bins - 1) / (*max - low);
    const auto bin_of = [&](float value) { return static_cast<std::size_t>((value - low) * bins_per_unit); };
    std::vector<std::size_t> counts(bins);
    for (const float value : field.values) { ++counts[bin_of(value)]; }
    // exp(-x^2 / 2), of sums and products alone.
    std::array<double, 256> up_to{};
    double whole = 0.0;
    for (std::size_t level = 0; level < up_to.size(); ++level) {
        const double x = (static_cast<double>(level) - 128.0) / (128.0 * DetailPattern::deviation);
        double density = 1.0 - x * x / 128.0;
        for (int i = 0; i < 6; ++i) { density *= density; }
        whole += density;
        up_to[level] = whole;
    }
    std::vector<std::uint8_t> level_of_bin(bins);
    std::size_t level = 0;
    double before = 0.0;
    for (std::size_t bin = 0; bin < bins; ++bin) {
        const double share =
            (before + 0.5 * static_cast<double>(counts[bin])) / static_cast<double>(field.values.size());
        while (level < 255 && up_to[level] < share * whole) { ++level; }
        level_of_bin[bin] = static_cast<std::uint8_t>(level);
        before += static_cast<double>(counts[bin]);
    }
    std::vector<std::uint8_t> texels;
    texels.reserve(field.values.size());
    for (const float value : field.values) { texels.push_back(level_of_bin[bin_of(value)]); }
    return texels;
}

} // namespace

DetailPattern::DetailPattern(const glm::dvec3& to_sun) : texels_(std::size_t{2} * texels_of_kind) {
    constexpr double light_texels = 2.0; // over which slopes are taken
    glm::vec3 in_cube(0.0F);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        in_cube[axis] = static_cast<float>(light_texels * glm::dot(axes[static_cast<std::size_t>(axis)], to_sun));
    }
    for (const Kind kind : {Kind::Open, Kind::Crowns}) {
        Field field =
            smoothed(lit(kind == Kind::Open ? reliefs().open : reliefs().crowns, in_cube, 0.6F), {0.2F, 0.6F, 0.2F});
        for (int level = 0; level < levels; ++level) {
            if (level > 0) { field = halved(field); }
            write_level(kind, level, normally_distributed(field));
        }
    }
}

void DetailPattern::write_level(Kind kind, int level, const std::vector<std::uint8_t>& texels) {
    const std::size_t size = static_cast<std::size_t>(side_texels) >> static_cast<unsigned>(level);
    std::uint16_t* const first =
        &texels_[static_cast<std::size_t>(kind) * texels_of_kind + static_cast<std::size_t>(row_of(level)) * stride];
    for (std::size_t row = 0; row < size * size; ++row) {
        const std::size_t beside_row = row / size * size + (row + 1) % size;
        const std::uint8_t* const own = &texels[row * size];
        const std::uint8_t* const beside = &texels[beside_row * size];
        std::uint16_t* const line = first + row * stride;
        for (std::size_t column = 0; column <= size; ++column) {
            const std::size_t from = column % size;
            line[column] = static_cast<std::uint16_t>(own[from] | beside[from] << 8);
        }
    }
}

std::uint8_t DetailPattern::texel(Kind kind, int level, const glm::ivec3& at) const {
    const int row = row_of(level) + at.z * (side_texels >> level) + at.y;
    const auto number = static_cast<std::size_t>(kind) * texels_of_kind + static_cast<std::size_t>(row * stride + at.x);
    return static_cast<std::uint8_t>(texels_[number] & 0xffU);
}

const DetailPattern& detail_pattern(double sun_azimuth_rad) {
    constexpr int directions = 8;
    constexpr double turn_rad = 6.283185307179586;
    static std::array<std::once_flag, directions> is_made;
    static std::array<std::optional<DetailPattern>, directions> patterns;
    const int eighths = static_cast<int>(std::lround(sun_azimuth_rad / turn_rad * directions));
    const auto number = static_cast<std::size_t>((eighths % directions + directions) % directions);
    std::call_once(is_made[number], [&] {
        const double azimuth_rad = static_cast<double>(number) / directions * turn_rad;
        patterns[number].emplace(glm::dvec3(std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0));
    });
    return *patterns[number];
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
    return along / detail_tile_m(scale);
}

} // namespace octant::visuals::scene
