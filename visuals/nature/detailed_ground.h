#pragma once

#include "models/colour_vertex.h"
#include "visuals/nature/ground_decoration.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::nature {

/// The most by which the middle of an edge is moved, over the distance of samples.
inline constexpr double max_offset_ratio = 0.06;

/// What is added to the mesh near the eye.
struct NearDetailOptions {
    bool has_subdivision = true;
    bool scenery = true;

    bool operator==(const NearDetailOptions&) const = default;
};

/// The input of apply_detail_budget().
struct DetailBudget {
    /// The number of triangles of the ground over 20,000, the default; nothing = no limit.
    std::optional<double> share = 1.0;
    double width_rad = 1.4;             ///< of the picture
    double focal_px = 869.0;            ///< pixels that a metre covers straight ahead, one metre off
    double height_above_ground_m = 0.0; ///< the eye over the ground
};

/// Sets the members of `view` that limit detail: min_edge_rad, range_ratio, focal_px, and the two maxima of triangles.
/// Edge length and range are chosen such that the maxima are hardly ever reached, because detail that a maximum cuts
/// off would appear suddenly. Without a limit of triangles the result does not depend on the width of the picture:
/// pictures from one eye with the same `focal_px` show the same ground where they overlap.
void apply_detail_budget(const DetailBudget& budget, const NearDetailOptions& detail, NearDetailView& view);

/// Own colour of a place of the world with its alpha, packed; where it lies from the eye.
using ColourAtPoint = std::function<std::uint32_t(const glm::dvec2& place_m, const glm::vec3& from_eye_m)>;

/// Makes the mesh of each frame with what stands on it and detail below its samples. Keeps its memory.
class DetailedGround {
public:
    DetailedGround();
    DetailedGround(const DetailedGround&) = delete;
    DetailedGround& operator=(const DetailedGround&) = delete;
    DetailedGround(DetailedGround&&) = delete;
    DetailedGround& operator=(DetailedGround&&) = delete;
    ~DetailedGround();

    struct Triangles {
        std::span<const models::ColourVertex> vertices;
        std::span<const std::uint32_t> indices;      ///< in the order of the mesh
        std::span<const models::VertexRun> standing; ///< vertices of what stands on the ground, ascending
        std::size_t detail_triangles = 0;            ///< triangles that halving has added
        std::size_t scenery_triangles = 0;           ///< triangles of what stands on the ground
        float min_edge_rad = 0.0F;                   ///< edges that look shorter stayed whole
    };

    /// `mesh` has colours; `colour` gives those of the middles of edges; null = the mean of both ends. The result stays
    /// valid until the next call but one.
    Triangles detailed_mesh(const terrain::GroundMesh& mesh, const NearDetailView& view,
        const NearDetailOptions& detail, const GroundDecorations& decorations, const ColourAtPoint* colour = nullptr);

    /// Replaces the numbers triangles[first..] of triangles of the last mesh, ascending, by the numbers of the
    /// triangles into which these were divided.
    void replace(std::vector<std::uint32_t>& triangles, std::size_t first) const;

private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
};

} // namespace octant::visuals::nature
