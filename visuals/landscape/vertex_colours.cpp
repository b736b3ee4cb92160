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
    std::shared_ptr<const nature::ReliefLight> relief)
    : ground_(ground)
    , palette_(settings, climate_at(ground.facts().place), std::move(relief))
    , water_(daylight_of(settings))
    , footprints_per_m_(
          static_cast<float>(1U << finer_octaves) / static_cast<float>(ground.spacing_m()))
    , last_octave_(static_cast<unsigned>(ground.levels() - 1) + finer_octaves) {
    fresh_.resize(min_places);
    stale_.resize(min_places);
}

void VertexColours::follow(
    const scene::AirSettings& settings, std::shared_ptr<const nature::ReliefLight> relief) {
    palette_ = GroundPalette(settings, climate_at(ground_.facts().place), std::move(relief));
    water_ = nature::WaterLight(daylight_of(settings));
    std::ranges::fill(fresh_, Entry{});
    std::ranges::fill(stale_, Entry{});
    fresh_count_ = 0;
}

void VertexColours::fill(
    std::span<models::ColourVertex> vertices, std::span<const terrain::VertexOrigin> origins) {
    assert(vertices.size() == origins.size());
    make_room(vertices.size());
    const std::size_t mask = fresh_.size() - 1;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const terrain::VertexOrigin& origin = origins[i];
        if (i + looked_ahead < origins.size()) {
            const terrain::VertexOrigin& later = origins[i + looked_ahead];
            __builtin_prefetch(&fresh_[hashed(later.column * parts, later.row * parts) & mask]);
        }
        std::uint32_t colour = seen_from(
            {origin.column * parts, origin.row * parts}, glm::length(vertices[i].position_m));
        if (origin.weight < 1.0F) {
            const std::uint32_t middle =
                mixed(vertices[origin.end_a].colour, vertices[origin.end_b].colour, 128U);
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
        (place_m + ground_.half_extent_m()) * (static_cast<double>(parts) / ground_.spacing_m());
    const auto place_of = [](double at, int samples) {
        const auto last = static_cast<double>(samples - 1) * parts;
        return static_cast<std::uint32_t>(std::lround(std::clamp(at, 0.0, last)));
    };
    if (4 * fresh_count_ > 3 * fresh_.size()) {
        make_room(0);
    }
    const std::uint32_t colour = seen_from(
        {place_of(grid.x, ground_.columns()), place_of(grid.y, ground_.rows())},
        glm::length(from_eye_m));
    return colour >> 24U == 0 ? seen_water(colour, from_eye_m) : colour;
}

/// Without what water mirrors.
std::uint32_t VertexColours::seen_from(const GridPlace& place, float distance_m) {
    const float near = std::min(
        distance_m * near_footprint_share * footprints_per_m_,
        static_cast<float>(1U << finer_octaves));
    const Octave octave =
        octave_of(std::max(near, distance_m * footprint_share * footprints_per_m_));
    const Entry& entry = entry_of(place, std::min(octave.whole, last_octave_));
    return mixed(entry.fine, entry.coarse, octave.whole < last_octave_ ? octave.part : 256U);
}

std::uint32_t VertexColours::seen_water(std::uint32_t own, const glm::vec3& from_eye_m) const {
    const auto part = [&](unsigned shift) {
        return static_cast<float>(own >> shift & 0xffU) * (1.0F / 255.0F);
    };
    const glm::vec3 seen = water_.seen({part(0), part(8), part(16)}, from_eye_m);
    return models::packed_colour(seen) & 0x00ffffffU;
}

/// Places for all vertices of a mesh; what was not asked for since the last but one time that the
/// table filled is forgotten.
void VertexColours::make_room(std::size_t vertices) {
    const std::size_t places = std::max(min_places, std::bit_ceil(4 * vertices));
    if (places > fresh_.size()) {
        std::vector<Entry> old(places);
        std::swap(old, fresh_);
        stale_.assign(places, {});
        fresh_count_ = 0;
        for (const Entry& entry : old) {
            if (entry.octave != unused) {
                entry_in(fresh_, entry.place) = entry;
                ++fresh_count_;
            }
        }
    } else if (2 * fresh_count_ > fresh_.size()) {
        std::swap(fresh_, stale_);
        std::fill(fresh_.begin(), fresh_.end(), Entry{});
        fresh_count_ = 0;
    }
}

VertexColours::Entry&
VertexColours::entry_in(std::vector<Entry>& table, const GridPlace& place) const {
    const std::size_t mask = table.size() - 1;
    std::size_t at = hashed(place.column, place.row) & mask;
    while (table[at].octave != unused && table[at].place != place) {
        at = (at + 1) & mask;
    }
    return table[at];
}

const VertexColours::Entry& VertexColours::entry_of(const GridPlace& place, unsigned octave) {
    Entry& entry = entry_in(fresh_, place);
    if (entry.octave == octave) {
        return entry;
    }
    if (entry.octave == unused) {
        ++fresh_count_;
        const Entry& before = entry_in(stale_, place);
        if (before.octave != unused) {
            entry = before;
        }
        entry.place = place;
    }
    if (entry.octave != octave) {
        work_out(entry, octave);
    }
    return entry;
}

void VertexColours::work_out(Entry& entry, unsigned octave) const {
    const Entry before = entry;
    const unsigned coarser = std::min(octave + 1, last_octave_);
    entry.octave = octave;
    entry.fine = before.octave != unused && before.octave + 1 == octave
                     ? before.coarse
                     : colour_of(entry.place, octave);
    entry.coarse = before.octave == octave + 1 ? before.fine
                   : coarser == octave         ? entry.fine
                                               : colour_of(entry.place, coarser);
}

std::uint32_t VertexColours::colour_of(const GridPlace& place, unsigned octave) const {
    const int step = octave > finer_octaves ? 1 << (octave - finer_octaves) : 1;
    const bool is_sample = place.column % parts == 0 && place.row % parts == 0;
    GroundPoint point = is_sample ? sample_point(place, step) : point_between(place);
    point.shore = palette_.is_water(point) ? shore_at(point) : 0.0F;
    return palette_.packed(
        point,
        static_cast<float>(ground_.spacing_m()) *
            std::exp2(static_cast<float>(octave) - static_cast<float>(finer_octaves)));
}

/// A sample with the mean slope of so wide a surrounding; of a place between samples, the one
/// south-west of it.
GroundPoint VertexColours::sample_point(const GridPlace& place, int step) const {
    const auto column = static_cast<int>(place.column / parts);
    const auto row = static_cast<int>(place.row / parts);
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
GroundPoint VertexColours::point_between(const GridPlace& place) const {
    const auto last_column = static_cast<std::uint32_t>(ground_.columns() - 2) * parts;
    const auto last_row = static_cast<std::uint32_t>(ground_.rows() - 2) * parts;
    const GridPlace cell{std::min(place.column, last_column), std::min(place.row, last_row)};
    const GroundPoint a = sample_point(cell, 1);
    const GroundPoint b = sample_point({cell.column + parts, cell.row}, 1);
    const GroundPoint c = sample_point({cell.column, cell.row + parts}, 1);
    const GroundPoint d = sample_point({cell.column + parts, cell.row + parts}, 1);
    const auto spacing_m = static_cast<float>(ground_.spacing_m());
    const float east_m = static_cast<float>(place.column) * (spacing_m / parts);
    const float north_m = static_cast<float>(place.row) * (spacing_m / parts);
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
float VertexColours::shore_at(const GroundPoint& point) const {
    constexpr std::array<glm::ivec2, 8> ways = {
        glm::ivec2(1, 0), {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    const auto per_m = 1.0F / static_cast<float>(ground_.spacing_m());
    const glm::ivec2 here(glm::round(glm::vec2(point.east_m, point.north_m) * per_m));
    const glm::ivec2 last(ground_.columns() - 1, ground_.rows() - 1);
    int land = 0;
    int seen = 0;
    for (const int far_off : {1, 2, 4}) {
        for (const glm::ivec2& way : ways) {
            const glm::ivec2 at = glm::clamp(here + way * far_off, glm::ivec2(0), last);
            land += ground_.height_m(at.x, at.y) > point.height_m + 0.01F ? 1 : 0;
            ++seen;
        }
    }
    return static_cast<float>(land) / static_cast<float>(seen);
}

nature::Growth VertexColours::growth_of(int column, int row) const {
    const GroundPoint point = ground_point(terrain::GroundSamples(ground_), column, row, 1);
    return palette_.growth(point, static_cast<float>(ground_.spacing_m()));
}

glm::vec3 VertexColours::mean() const {
    glm::vec3 sum(0.0F);
    for (int j = 0; j < mean_samples; ++j) {
        for (int i = 0; i < mean_samples; ++i) {
            const auto column =
                static_cast<std::uint32_t>((2 * i + 1) * ground_.columns() / (2 * mean_samples));
            const auto row =
                static_cast<std::uint32_t>((2 * j + 1) * ground_.rows() / (2 * mean_samples));
            const std::uint32_t colour = colour_of({column * parts, row * parts}, finer_octaves);
            sum += glm::vec3(colour & 0xffU, colour >> 8U & 0xffU, colour >> 16U & 0xffU);
        }
    }
    return sum / (255.0F * static_cast<float>(mean_samples * mean_samples));
}

} // namespace octant::visuals::landscape
