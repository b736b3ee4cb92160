#pragma once

#include "models/colour_vertex.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/nature/water_light.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_tiles.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::landscape {

/// Colours the vertices of meshes with geomorphs so that no change of detail changes a colour in a
/// step. What a vertex shows depends on its sample and its distance from the eye alone: slope and
/// cover are filtered to a footprint that grows steadily with the distance. A vertex that comes or
/// goes moves in colour as it does in height, from the mean of its ends to its own. Near the eye
/// the footprint is smaller than the distance of samples, and places between them have colours,
/// too. Water takes part of what it shows from the sky and the sun, by the eye's place.
///
/// Colours are worked out when first asked for, so that the size of the ground does not matter, and
/// remembered; memory follows the number of vertices.
class VertexColours {
public:
    /// The ground must outlive the colours.
    VertexColours(
        const terrain::GroundTiles& ground,
        const scene::AirSettings& settings,
        std::shared_ptr<const nature::ReliefLight> relief);

    /// Gives other colours from now on.
    void
    follow(const scene::AirSettings& settings, std::shared_ptr<const nature::ReliefLight> relief);

    /// Fills in ColourVertex::colour; `origins` as GroundMesh::origins.
    void
    fill(std::span<models::ColourVertex> vertices, std::span<const terrain::VertexOrigin> origins);

    /// Colour of a place of the world, packed, with the number of its covers for alpha.
    std::uint32_t at(const glm::dvec2& place_m, const glm::vec3& from_eye_m);

    /// What stands at a sample.
    nature::Growth growth_of(int column, int row) const;

    /// Mean over the ground, of widely spaced samples, display values 0..1.
    glm::vec3 mean() const;

private:
    /// A place of the grid, of which there are `parts` from each sample to the next.
    struct GridPlace {
        std::uint32_t column = 0;
        std::uint32_t row = 0;

        bool operator==(const GridPlace&) const = default;
    };

    /// A place's colours at two neighbouring octaves.
    struct Entry {
        GridPlace place;
        std::uint32_t octave = unused;
        std::uint32_t fine = 0;
        std::uint32_t coarse = 0;
    };

    static constexpr std::uint32_t unused = ~std::uint32_t{0};
    static constexpr std::uint32_t parts = 64;
    /// Footprints are counted from the distance of samples over 2^finer_octaves.
    static constexpr unsigned finer_octaves = 5;

    void make_room(std::size_t vertices);
    std::uint32_t seen_from(const GridPlace& place, float distance_m);
    const Entry& entry_of(const GridPlace& place, unsigned octave);
    Entry& entry_in(std::vector<Entry>& table, const GridPlace& place) const;
    void work_out(Entry& entry, unsigned octave) const;
    std::uint32_t colour_of(const GridPlace& place, unsigned octave) const;
    GroundPoint sample_point(const GridPlace& place, int step) const;
    GroundPoint point_between(const GridPlace& place) const;
    float shore_at(const GroundPoint& point) const;
    std::uint32_t seen_water(std::uint32_t own, const glm::vec3& from_eye_m) const;

    const terrain::GroundTiles& ground_;
    GroundPalette palette_;
    nature::WaterLight water_;
    float footprints_per_m_; ///< of the distance, in footprints of octave 0
    unsigned last_octave_;
    std::vector<Entry> fresh_; ///< asked for lately; a power of two of places
    std::vector<Entry> stale_; ///< those asked for before
    std::size_t fresh_count_ = 0;
};

} // namespace octant::visuals::landscape
