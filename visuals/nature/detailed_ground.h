#pragma once

#include "visuals/nature/near_detail_mesh.h"
#include "visuals/nature/near_detail_histogram.h"
#include "visuals/nature/near_detail_view.h"
#include "visuals/nature/scenery.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/common.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::nature {

/// The mesh of a frame with what stands on it and detail below its samples.
class DetailedGround {
public:
    explicit DetailedGround(Scenery scenery)
        : scenery_(std::move(scenery)) {}

    Scenery& scenery() { return scenery_; }

    struct Triangles {
        std::span<const models::ColourVertex> vertices;
        std::span<const std::uint32_t> indices; ///< in the order of the mesh
        std::size_t detail_triangles = 0;                   ///< triangles that halving has added
        std::size_t scenery_triangles = 0;                 ///< triangles of what stands on the ground
    };

    /// The mesh comes coloured; `colour` as NearDetailMesh::begin() has it. The triangles stay valid
    /// until the next call but one.
    Triangles detailed_mesh(
        const terrain::GroundMesh& mesh,
        const NearDetailView& view,
        const NearDetailOptions& detail,
        const ColourAtPoint* colour = nullptr);

    /// Replaces numbers of triangles of the last mesh, ascending, by those of the triangles that
    /// were made in their places.
    void replace(std::vector<std::uint32_t>& triangles, std::size_t first) const;

private:
    NearDetailHistogram histogram_;
    NearDetailMesh mesh_builder_;
    Scenery scenery_;

    struct Frame {
        std::vector<models::ColourVertex> vertices;
        std::vector<std::uint32_t> indices;
    };

    std::array<Frame, 2> frames_;
    std::size_t frame_ = 0;
    std::vector<std::uint32_t> first_index_of_; ///< for each triangle of the mesh, and the end
    mutable std::vector<std::uint32_t> replaced_;
};

} // namespace octant::visuals::nature
