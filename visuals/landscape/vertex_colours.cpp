#include "visuals/landscape/vertex_colours.h"

#include "visuals/landscape/ground_colours.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

namespace octant::visuals::landscape {

namespace {

/// Footprint as a share of the distance: about the distance of neighbouring vertices where the
/// ground is rough, 14 pixels of 720 lines over 45 degrees.
constexpr double footprint_share = 1.0 / 192.0;
constexpr std::size_t least_places = 1U << 14U;
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

std::uint32_t sample_of(const terrain::VertexOrigin& origin) {
    return std::uint32_t{origin.row} << 16U | origin.column;
}

std::size_t hashed(std::uint32_t sample) {
    const std::uint32_t h = sample * 0x9e3779b1U;
    return h ^ (h >> 15U);
}

} // namespace

VertexColours::VertexColours(
    const terrain::GroundTiles& ground,
    const scene::AirSettings& settings,
    std::shared_ptr<const nature::ReliefLight> relief)
    : ground_(ground)
    , palette_(settings, climate_at(ground.facts().place), std::move(relief))
    , octaves_per_m_(static_cast<float>(footprint_share / ground.spacing_m()))
    , last_octave_(static_cast<unsigned>(ground.levels() - 1)) {
    fresh_.resize(least_places);
    stale_.resize(least_places);
}

void VertexColours::follow(
    const scene::AirSettings& settings, std::shared_ptr<const nature::ReliefLight> relief) {
    palette_ = GroundPalette(settings, climate_at(ground_.facts().place), std::move(relief));
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
            __builtin_prefetch(&fresh_[hashed(sample_of(origins[i + looked_ahead])) & mask]);
        }
        const Octave octave = octave_of(glm::length(vertices[i].position_m) * octaves_per_m_);
        const Entry& entry = entry_of(origin, std::min(octave.whole, last_octave_));
        std::uint32_t colour =
            mixed(entry.fine, entry.coarse, octave.whole < last_octave_ ? octave.part : 256U);
        if (origin.weight < 1.0F) {
            const std::uint32_t middle =
                mixed(vertices[origin.end_a].colour, vertices[origin.end_b].colour, 128U);
            colour = mixed(middle, colour, static_cast<std::uint32_t>(origin.weight * 256.0F));
        }
        vertices[i].colour = colour;
    }
}

/// Places for all vertices of a mesh; what was not asked for since the last but one time that the
/// table filled is forgotten.
void VertexColours::make_room(std::size_t vertices) {
    const std::size_t places = std::max(least_places, std::bit_ceil(4 * vertices));
    if (places > fresh_.size()) {
        std::vector<Entry> old(places);
        std::swap(old, fresh_);
        stale_.assign(places, {});
        fresh_count_ = 0;
        for (const Entry& entry : old) {
            if (entry.octave != unused) {
                place_of(fresh_, entry.sample) = entry;
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
VertexColours::place_of(std::vector<Entry>& table, std::uint32_t sample) const {
    const std::size_t mask = table.size() - 1;
    std::size_t at = hashed(sample) & mask;
    while (table[at].octave != unused && table[at].sample != sample) {
        at = (at + 1) & mask;
    }
    return table[at];
}

const VertexColours::Entry&
VertexColours::entry_of(const terrain::VertexOrigin& origin, unsigned octave) {
    const std::uint32_t sample = sample_of(origin);
    Entry& entry = place_of(fresh_, sample);
    if (entry.octave == octave) {
        return entry;
    }
    if (entry.octave == unused) {
        ++fresh_count_;
        const Entry& before = place_of(stale_, sample);
        if (before.octave != unused) {
            entry = before;
        }
        entry.sample = sample;
    }
    if (entry.octave != octave) {
        work_out(entry, origin, octave);
    }
    return entry;
}

void VertexColours::work_out(
    Entry& entry, const terrain::VertexOrigin& origin, unsigned octave) const {
    const Entry before = entry;
    const unsigned coarser = std::min(octave + 1, last_octave_);
    entry.octave = octave;
    entry.fine = before.octave != unused && before.octave + 1 == octave
                     ? before.coarse
                     : colour_of(origin.column, origin.row, octave);
    entry.coarse = before.octave == octave + 1 ? before.fine
                   : coarser == octave         ? entry.fine
                                               : colour_of(origin.column, origin.row, coarser);
}

std::uint32_t
VertexColours::colour_of(std::uint16_t column, std::uint16_t row, unsigned octave) const {
    const int step = 1 << octave;
    const int west = std::max(column - step, 0);
    const int east = std::min(column + step, ground_.columns() - 1);
    const int south = std::max(row - step, 0);
    const int north = std::min(row + step, ground_.rows() - 1);
    const auto spacing_m = static_cast<float>(ground_.spacing_m());
    const float rise_east = (ground_.height_m(east, row) - ground_.height_m(west, row)) /
                            (spacing_m * static_cast<float>(east - west));
    const float rise_north = (ground_.height_m(column, north) - ground_.height_m(column, south)) /
                             (spacing_m * static_cast<float>(north - south));
    const GroundPoint point{
        spacing_m * static_cast<float>(column),
        spacing_m * static_cast<float>(row),
        ground_.height_m(column, row),
        glm::normalize(glm::vec3(-rise_east, -rise_north, 1.0F))};
    return models::packed_colour(palette_.lit(point, spacing_m * static_cast<float>(step)));
}

nature::Growth VertexColours::growth_of(int column, int row) const {
    const GroundPoint point = ground_point(terrain::GroundSamples(ground_), column, row, 1);
    return palette_.growth(point, static_cast<float>(ground_.spacing_m()));
}

glm::vec3 VertexColours::mean() const {
    glm::vec3 sum(0.0F);
    for (int j = 0; j < mean_samples; ++j) {
        for (int i = 0; i < mean_samples; ++i) {
            const std::uint32_t colour = colour_of(
                static_cast<std::uint16_t>((2 * i + 1) * ground_.columns() / (2 * mean_samples)),
                static_cast<std::uint16_t>((2 * j + 1) * ground_.rows() / (2 * mean_samples)),
                0);
            sum += glm::vec3(colour & 0xffU, colour >> 8U & 0xffU, colour >> 16U & 0xffU);
        }
    }
    return sum / (255.0F * static_cast<float>(mean_samples * mean_samples));
}

} // namespace octant::visuals::landscape
