#pragma once

#include "models/material.h"
#include "models/simplify/attribute_seams.h"
#include "models/triangle_mesh.h"
#include "visuals/refine/mesh_textures.h"
#include "visuals/refine/progressive_mesh.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::world {

/// Where the nodes of a hierarchy lie on the pictures of its charts: MeshTextures without the pictures, as a cache
/// keeps them.
struct NodePlaces {
    std::vector<std::uint32_t> first; ///< as MeshTextures::first
    std::vector<visuals::refine::ChartPlace> places;
    std::vector<std::uint32_t> chart_materials; ///< for each chart its material in the mesh
};

/// Whether a material of a mesh has a texture that lies on triangles.
bool has_textures(const models::TriangleMesh& mesh);

/// Whether triangles without a picture have the colours of their materials, of which there are several, but no more
/// than 256: no colours of vertices, which run into one another.
bool has_plain_colours(const models::TriangleMesh& mesh);

/// The charts of a repaired mesh with textures or with plain colours (`is_plain`); nothing for one without, and, with a
/// note, for one of more charts than a hierarchy tells apart.
std::optional<models::simplify::AttributeSeams> texture_charts(
    const models::TriangleMesh& mesh, bool is_plain, std::vector<std::string>& notes);

/// The places of the nodes of a hierarchy that was made of `charts.marked()`.
NodePlaces node_places(
    const visuals::refine::ProgressiveMesh& hierarchy, const models::simplify::AttributeSeams& charts);

/// The same with the pictures of the mesh's materials, and their colours where it has plain ones. `places` must fit
/// them and a hierarchy of `node_count` nodes: null where it does not.
std::shared_ptr<const visuals::refine::MeshTextures> mesh_textures(
    NodePlaces places, std::span<const models::Material> materials, bool is_plain, std::size_t node_count);

} // namespace octant::ui::world
