#pragma once

#include "models/colour_vertex.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_tiles.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::landscape {

/// Colours the vertices of meshes with geomorphs so that no change of detail changes a colour in a
/// step. What a vertex shows depends on its sample and its distance from the eye alone: slope and
/// cover are filtered to a footprint that grows steadily with the distance. A vertex that comes or
/// goes moves in colour as it does in height, from the mean of its ends to its own.
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

    /// Colour of a sample seen through a footprint of 2^octave samples, packed.
    std::uint32_t colour_of(std::uint16_t column, std::uint16_t row, unsigned octave) const;

    /// What stands at a sample.
    nature::Growth growth_of(int column, int row) const;

    /// Mean over the ground, of widely spaced samples, display values 0..1.
    glm::vec3 mean() const;

private:
    /// A sample's colours at two neighbouring octaves.
    struct Entry {
        std::uint32_t sample = 0;
        std::uint32_t octave = unused;
        std::uint32_t fine = 0;
        std::uint32_t coarse = 0;
    };

    static constexpr std::uint32_t unused = ~std::uint32_t{0};

    void make_room(std::size_t vertices);
    const Entry& entry_of(const terrain::VertexOrigin& origin, unsigned octave);
    Entry& place_of(std::vector<Entry>& table, std::uint32_t sample) const;
    void work_out(Entry& entry, const terrain::VertexOrigin& origin, unsigned octave) const;

    const terrain::GroundTiles& ground_;
    GroundPalette palette_;
    float octaves_per_m_; ///< footprint in samples of a metre's distance
    unsigned last_octave_;
    std::vector<Entry> fresh_; ///< asked for lately; a power of two of places
    std::vector<Entry> stale_; ///< those asked for before
    std::size_t fresh_count_ = 0;
};

} // namespace octant::visuals::landscape
