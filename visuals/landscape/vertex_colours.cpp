#include "visuals/landscape/vertex_colours.h"

#include "visuals/landscape/ground_colours.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

namespace octant::visuals::landscape {

namespace {

/// Footprint as a share of the distance: about the distance of neighbouring vertices where the
/// ground is rough, 14 pixels of 720 lines over 45 degrees; nearer than the distance of samples
/// about half of what edges look like there.
constexpr float footprint_share = 1.0F / 192.0F;
constexpr float near_footprint_share = 1.0F / 40.0F;
constexpr std::size_t min_places = 1U << 14U;
constexpr std::size_t looked_ahead = 16; ///< vertices whose places are fetched into the cache
constexpr int mean_samples = 16;         ///< a side

/// Packed colours mixed by 256ths, rounded.
std::uint32_t mixed(std::uint32_t a, std::uint32_t b, std::uint32_t share_of_b) {
    constexpr std::uint32_t even = 0x00ff00ffU;
    constexpr std::uint32_t half = 0x00800080U;
    const std::uint32_t share_of_a = 256U - share_of_b;
    const std::uint32_t low = ((a & even) * share_of_a + (b & even) * share_of_b + half) >> 8U;
    const std::uint32_t high =
        ((a >> 8U) & even) * share_of_a + ((b >> 8U) & even) * share_of_b + half;
    return (low & even) | (high & ~even);
}

/// A distance in footprints as whole octaves and what is left, in 256ths; rises steadily.
struct Octave {
    unsigned whole;
    std::uint32_t part;
};

Octave octave_of(float footprints) {
    const auto bits = std::bit_cast<std::uint32_t>(std::max(footprints, 1.0F));
    return {(bits >> 23U) - 127U, (bits >> 15U) & 0xffU};
}

std::size_t hashed(std::uint32_t column, std::uint32_t row) {
    const std::uint32_t h = column * 0x9e3779b1U ^ row * 0x85ebca77U;
    return h ^ (h >> 15U);
}

} // namespace

VertexColours::VertexColours(
    const terrain::GroundTiles& ground,
    const scene::AirSettings& settings,
    std::shared_ptr<const nature::ReliefShadows> terrain_shadows)
    : ground_(ground)
    , palette_(settings, climate_at(ground.metadata().place), std::move(terrain_shadows))
    , water_(daylight_of(settings))
    , footprints_per_m_(
          static_cast<float>(1U << finer_octaves) / static_cast<float>(ground.spacing_m()))
    , last_octave_(static_cast<unsigned>(ground.levels() - 1) + finer_octaves) {
    recent_.resize(min_places);
    older_.resize(min_places);
}

void VertexColours::apply_settings(
    const scene::AirSettings& settings, std::shared_ptr<const nature::ReliefShadows> terrain_shadows) {
    palette_ = GroundPalette(settings, climate_at(ground_.metadata().place), std::move(terrain_shadows));
    water_ = nature::WaterReflection(daylight_of(settings));
    std::ranges::fill(recent_, CachedColours{});
    std::ranges::fill(older_, CachedColours{});
    recent_count_ = 0;
}

void VertexColours::fill(
    std::span<models::ColourVertex> vertices, std::span<const terrain::VertexMorph> morphs) {
    assert(vertices.size() == morphs.size());
    reserve(vertices.size());
    const std::size_t mask = recent_.size() - 1;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const terrain::VertexMorph& origin = morphs[i];
        if (i + looked_ahead < morphs.size()) {
            const terrain::VertexMorph& later = morphs[i + looked_ahead];
            __builtin_prefetch(&recent_[hashed(later.column * subdivisions, later.row * subdivisions) & mask]);
        }
        std::uint32_t colour = colour_at_distance(
            {origin.column * subdivisions, origin.row * subdivisions}, glm::length(vertices[i].position_m));
        if (origin.weight < 1.0F) {
            const std::uint32_t middle =
                mixed(vertices[origin.parent_a].colour, vertices[origin.parent_b].colour, 128U);
            colour = mixed(middle, colour, static_cast<std::uint32_t>(origin.weight * 256.0F));
        }
        vertices[i].colour = colour;
    }
    for (models::ColourVertex& vertex : vertices) {
        if (vertex.colour >> 24U == 0) {
            vertex.colour = seen_water(vertex.colour, vertex.position_m);
        }
    }
}

std::uint32_t VertexColours::at(const glm::dvec2& place_m, const glm::vec3& from_eye_m) {
    const glm::dvec2 grid =
        (place_m + ground_.half_extent_m()) * (static_cast<double>(subdivisions) / ground_.spacing_m());
    const auto place_of = [](double at, int samples) {
        const auto last = static_cast<double>(samples - 1) * subdivisions;
        return static_cast<std::uint32_t>(std::lround(std::clamp(at, 0.0, last)));
    };
    if (4 * recent_count_ > 3 * recent_.size()) {
        reserve(0);
    }
    const std::uint32_t colour = colour_at_distance(
        {place_of(grid.x, ground_.columns()), place_of(grid.y, ground_.rows())},
        glm::length(from_eye_m));
    return colour >> 24U == 0 ? seen_water(colour, from_eye_m) : colour;
}

/// Without what water mirrors.
std::uint32_t VertexColours::colour_at_distance(const SubgridPoint& place, float distance_m) {
    const float near = std::min(
        distance_m * near_footprint_share * footprints_per_m_,
        static_cast<float>(1U << finer_octaves));
    const Octave octave =
        octave_of(std::max(near, distance_m * footprint_share * footprints_per_m_));
    const CachedColours& entry = cached_entry(place, std::min(octave.whole, last_octave_));
    return mixed(entry.fine, entry.coarse, octave.whole < last_octave_ ? octave.part : 256U);
}

std::uint32_t VertexColours::seen_water(std::uint32_t own, const glm::vec3& from_eye_m) const {
    const auto part = [&](unsigned shift) {
        return static_cast<float>(own >> shift & 0xffU) * (1.0F / 255.0F);
    };
    const glm::vec3 shaded_colour = water_.shaded_colour({part(0), part(8), part(16)}, from_eye_m);
    return models::packed_colour(shaded_colour) & 0x00ffffffU;
}

/// Places for all vertices of a mesh; what was not asked for since the last but one time that the
/// table filled is forgotten.
void VertexColours::reserve(std::size_t vertices) {
    const std::size_t places = std::max(min_places, std::bit_ceil(4 * vertices));
    if (places > recent_.size()) {
        std::vector<CachedColours> old(places);
        std::swap(old, recent_);
        older_.assign(places, {});
        recent_count_ = 0;
        for (const CachedColours& entry : old) {
            if (entry.octave != unused) {
                slot_in(recent_, entry.place) = entry;
                ++recent_count_;
            }
        }
    } else if (2 * recent_count_ > recent_.size()) {
        std::swap(recent_, older_);
        std::fill(recent_.begin(), recent_.end(), CachedColours{});
        recent_count_ = 0;
    }
}

VertexColours::CachedColours&
VertexColours::slot_in(std::vector<CachedColours>& table, const SubgridPoint& place) const {
    const std::size_t mask = table.size() - 1;
    std::size_t at = hashed(place.column, place.row) & mask;
    while (table[at].octave != unused && table[at].place != place) {
        at = (at + 1) & mask;
    }
    return table[at];
}

const VertexColours::CachedColours& VertexColours::cached_entry(const SubgridPoint& place, unsigned octave) {
    CachedColours& entry = slot_in(recent_, place);
    if (entry.octave == octave) {
        return entry;
    }
    if (entry.octave == unused) {
        ++recent_count_;
        const CachedColours& before = slot_in(older_, place);
        if (before.octave != unused) {
            entry = before;
        }
        entry.place = place;
    }
    if (entry.octave != octave) {
        compute(entry, octave);
    }
    return entry;
}

void VertexColours::compute(CachedColours& entry, unsigned octave) const {
    const CachedColours before = entry;
    const unsigned coarser = std::min(octave + 1, last_octave_);
    entry.octave = octave;
    entry.fine = before.octave != unused && before.octave + 1 == octave
                     ? before.coarse
                     : colour_of(entry.place, octave);
    entry.coarse = before.octave == octave + 1 ? before.fine
                   : coarser == octave         ? entry.fine
                                               : colour_of(entry.place, coarser);
}

std::uint32_t VertexColours::colour_of(const SubgridPoint& place, unsigned octave) const {
    const int step = octave > finer_octaves ? 1 << (octave - finer_octaves) : 1;
    const bool is_sample = place.column % subdivisions == 0 && place.row % subdivisions == 0;
    TerrainPoint point = is_sample ? sample_point(place, step) : point_between(place);
    point.land_share = palette_.is_water(point) ? land_share_at(point) : 0.0F;
    return palette_.packed(
        point,
        static_cast<float>(ground_.spacing_m()) *
            std::exp2(static_cast<float>(octave) - static_cast<float>(finer_octaves)));
}

/// A sample with the mean slope of so wide a surrounding; of a place between samples, the one
/// south-west of it.
TerrainPoint VertexColours::sample_point(const SubgridPoint& place, int step) const {
    const auto column = static_cast<int>(place.column / subdivisions);
    const auto row = static_cast<int>(place.row / subdivisions);
    const int west = std::max(column - step, 0);
    const int east = std::min(column + step, ground_.columns() - 1);
    const int south = std::max(row - step, 0);
    const int north = std::min(row + step, ground_.rows() - 1);
    const auto spacing_m = static_cast<float>(ground_.spacing_m());
    const float rise_east = (ground_.height_m(east, row) - ground_.height_m(west, row)) /
                            (spacing_m * static_cast<float>(east - west));
    const float rise_north = (ground_.height_m(column, north) - ground_.height_m(column, south)) /
                             (spacing_m * static_cast<float>(north - south));
    return {
        spacing_m * static_cast<float>(column),
        spacing_m * static_cast<float>(row),
        ground_.height_m(column, row),
        glm::normalize(glm::vec3(-rise_east, -rise_north, 1.0F))};
}

/// Heights and slopes even between four samples.
TerrainPoint VertexColours::point_between(const SubgridPoint& place) const {
    const auto last_column = static_cast<std::uint32_t>(ground_.columns() - 2) * subdivisions;
    const auto last_row = static_cast<std::uint32_t>(ground_.rows() - 2) * subdivisions;
    const SubgridPoint cell{std::min(place.column, last_column), std::min(place.row, last_row)};
    const TerrainPoint a = sample_point(cell, 1);
    const TerrainPoint b = sample_point({cell.column + subdivisions, cell.row}, 1);
    const TerrainPoint c = sample_point({cell.column, cell.row + subdivisions}, 1);
    const TerrainPoint d = sample_point({cell.column + subdivisions, cell.row + subdivisions}, 1);
    const auto spacing_m = static_cast<float>(ground_.spacing_m());
    const float east_m = static_cast<float>(place.column) * (spacing_m / subdivisions);
    const float north_m = static_cast<float>(place.row) * (spacing_m / subdivisions);
    const float right = (east_m - a.east_m) / spacing_m;
    const float up = (north_m - a.north_m) / spacing_m;
    const auto between = [&](auto low, auto low_right, auto high, auto high_right) {
        return glm::mix(glm::mix(low, low_right, right), glm::mix(high, high_right, right), up);
    };
    return {
        east_m,
        north_m,
        between(a.height_m, b.height_m, c.height_m, d.height_m),
        glm::normalize(between(a.normal, b.normal, c.normal, d.normal))};
}

/// By samples around, the nearer ones counting like the farther ones.
float VertexColours::land_share_at(const TerrainPoint& point) const {
    constexpr std::array<glm::ivec2, 8> ways = {
        glm::ivec2(1, 0), {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    const auto per_m = 1.0F / static_cast<float>(ground_.spacing_m());
    const glm::ivec2 here(glm::round(glm::vec2(point.east_m, point.north_m) * per_m));
    const glm::ivec2 last(ground_.columns() - 1, ground_.rows() - 1);
    int land = 0;
    int shaded_colour = 0;
    for (const int far_off : {1, 2, 4}) {
        for (const glm::ivec2& way : ways) {
            const glm::ivec2 at = glm::clamp(here + way * far_off, glm::ivec2(0), last);
            land += ground_.height_m(at.x, at.y) > point.height_m + 0.01F ? 1 : 0;
            ++shaded_colour;
        }
    }
    return static_cast<float>(land) / static_cast<float>(shaded_colour);
}

nature::SceneryDensity VertexColours::scenery_density_of(int column, int row) const {
    const TerrainPoint point = ground_point(terrain::GroundSamples(ground_), column, row, 1);
    return palette_.scenery_density(point, static_cast<float>(ground_.spacing_m()));
}

glm::vec3 VertexColours::mean() const {
    glm::vec3 sum(0.0F);
    for (int j = 0; j < mean_samples; ++j) {
        for (int i = 0; i < mean_samples; ++i) {
            const auto column =
                static_cast<std::uint32_t>((2 * i + 1) * ground_.columns() / (2 * mean_samples));
            const auto row =
                static_cast<std::uint32_t>((2 * j + 1) * ground_.rows() / (2 * mean_samples));
            const std::uint32_t colour = colour_of({column * subdivisions, row * subdivisions}, finer_octaves);
            sum += glm::vec3(colour & 0xffU, colour >> 8U & 0xffU, colour >> 16U & 0xffU);
        }
    }
    return sum / (255.0F * static_cast<float>(mean_samples * mean_samples));
}

} // namespace octant::visuals::landscape
