#pragma once

#include "models/texture.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::refine {

/// Where a node of a hierarchy lies on the picture of one chart.
struct ChartPlace {
    std::uint32_t chart = 0;
    glm::vec2 place{0.0F}; ///< as scene::ModelVertex::on_texture
};

/// What the triangles of a chart show.
struct ChartSurface {
    /// 0 = no picture: the colours of the nodes; k = MeshTextures::textures[k - 1].
    std::uint32_t texture = 0;
    /// Without a picture: `colour` stands in place of the colours of the nodes.
    bool is_plain = false;
    std::uint32_t colour =
        0xffffffffU; ///< of a plain chart, or what the picture is multiplied by, as ColourVertex::colour
};

/// The pictures on a hierarchy, and the colours that end at edges. Seams of texture coordinates, and edges of
/// materials, divide its surface into charts; the faces of a chart have its number as their material
/// (ProgressiveMeshData::face_materials), and a node lies on the pictures of all charts that its leaves touch.
struct MeshTextures {
    std::vector<std::uint32_t> first; ///< for each node the first of its `places`, and the end of the last one's
    std::vector<ChartPlace> places;   ///< of a node by ascending charts
    std::vector<ChartSurface> charts;
    std::vector<models::SurfaceTexture> textures;

    std::span<const ChartPlace> places_of(std::uint32_t node) const {
        return std::span(places).subspan(first[node], first[node + 1] - first[node]);
    }
};

} // namespace octant::visuals::refine
