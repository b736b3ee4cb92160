#pragma once

#include "models/colour_vertex.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/nature/water_reflection.h"
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
        std::shared_ptr<const nature::ReliefShadows> terrain_shadows);

    /// Gives other colours from now on.
    void
    apply_settings(const scene::AirSettings& settings, std::shared_ptr<const nature::ReliefShadows> terrain_shadows);

    /// Fills in ColourVertex::colour; `morphs` as GroundMesh::origins.
    void
    fill(std::span<models::ColourVertex> vertices, std::span<const terrain::VertexMorph> morphs);

    /// Colour of a place of the world, packed, with the number of its covers for alpha.
    std::uint32_t at(const glm::dvec2& place_m, const glm::vec3& from_eye_m);

    /// What stands at a sample.
    nature::SceneryDensity scenery_density_of(int column, int row) const;

    /// Mean over the ground, of widely spaced samples, display values 0..1.
    glm::vec3 mean() const;

private:
    /// A place of the grid, of which there are `subdivisions` from each sample to the next.
    struct SubgridPoint {
        std::uint32_t column = 0;
        std::uint32_t row = 0;

        bool operator==(const SubgridPoint&) const = default;
    };

    /// A place's colours at two neighbouring octaves.
    struct CachedColours {
        SubgridPoint place;
        std::uint32_t octave = unused;
        std::uint32_t fine = 0;
        std::uint32_t coarse = 0;
    };

    static constexpr std::uint32_t unused = ~std::uint32_t{0};
    static constexpr std::uint32_t subdivisions = 64;
    /// Footprints are counted from the distance of samples over 2^finer_octaves.
    static constexpr unsigned finer_octaves = 5;

    void reserve(std::size_t vertices);
    std::uint32_t colour_at_distance(const SubgridPoint& place, float distance_m);
    const CachedColours& cached_entry(const SubgridPoint& place, unsigned octave);
    CachedColours& slot_in(std::vector<CachedColours>& table, const SubgridPoint& place) const;
    void compute(CachedColours& entry, unsigned octave) const;
    std::uint32_t colour_of(const SubgridPoint& place, unsigned octave) const;
    TerrainPoint sample_point(const SubgridPoint& place, int step) const;
    TerrainPoint point_between(const SubgridPoint& place) const;
    float land_share_at(const TerrainPoint& point) const;
    std::uint32_t seen_water(std::uint32_t own, const glm::vec3& from_eye_m) const;

    const terrain::GroundTiles& ground_;
    GroundPalette palette_;
    nature::WaterReflection water_;
    float footprints_per_m_; ///< of the distance, in footprints of octave 0
    unsigned last_octave_;
    std::vector<CachedColours> recent_; ///< asked for lately; a power of two of places
    std::vector<CachedColours> older_; ///< those asked for before
    std::size_t recent_count_ = 0;
};

} // namespace octant::visuals::landscape
