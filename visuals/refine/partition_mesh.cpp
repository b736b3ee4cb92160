// Pictures of what selective refinement does: J. Kim, S. Lee, "Truly Selective Refinement of Progressive Meshes",
// Graphics Interface 2001, section 3, where an active mesh is explained as the partition of the original vertices among
// the active nodes. Used by `octant refine --colour-by` and `--out-partition`.
#include "visuals/refine/partition_mesh.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace octant::visuals::refine {

namespace {

/// The saturated colour at a place on the colour circle; `turn` counts whole turns, 0 is red.
glm::vec3 hue(float turn) {
    const auto part = [&](float from) {
        const float at = turn + from - std::floor(turn + from);
        return glm::clamp(std::abs(6.0F * at - 3.0F) - 1.0F, 0.0F, 1.0F);
    };
    return {part(0.0F), part(2.0F / 3.0F), part(1.0F / 3.0F)};
}

/// A colour for a node. Successive numbers get hues that are far apart, because the golden ratio spreads them evenly
/// over the circle.
glm::vec3 region_colour(std::uint32_t node) {
    constexpr double golden = 0.6180339887498949;
    const auto turn = static_cast<float>(std::fmod(golden * node, 1.0));
    constexpr float paleness = 0.12F;
    const float strength = 0.95F - 0.2F * static_cast<float>(node % 3);
    return strength * glm::mix(hue(turn), glm::vec3(1.0F), paleness);
}

/// A colour for the number of original vertices below a node, from blue (1) to red (1024 and more).
glm::vec3 level_colour(std::size_t originals) {
    constexpr float warmest = 10.0F; // The number of doublings at which red is reached.
    constexpr float blue = 0.66F;
    const float level = std::min(std::log2(static_cast<float>(originals)) / warmest, 1.0F);
    return 0.9F * glm::mix(hue(blue * (1.0F - level)), glm::vec3(1.0F), 0.25F);
}

glm::vec3 colour_of(const ActiveMesh& active, std::size_t vertex, ColourBy by) {
    return by == ColourBy::Region ? region_colour(active.nodes[vertex]) : level_colour(active.originals[vertex].size());
}

} // namespace

models::TriangleMesh coloured_mesh(ActiveMesh active, ColourBy by) {
    if (by != ColourBy::Nothing) {
        active.mesh.colours.resize(active.nodes.size());
        for (std::size_t vertex = 0; vertex < active.nodes.size(); ++vertex) {
            active.mesh.colours[vertex] = colour_of(active, vertex, by);
        }
    }
    return std::move(active.mesh);
}

models::TriangleMesh partition_mesh(const SelectiveRefiner& refiner, ColourBy by) {
    const ProgressiveMesh& hierarchy = refiner.mesh();
    const ProgressiveMeshData& parts = hierarchy.parts();
    const ActiveMesh active = active_mesh(refiner);
    models::TriangleMesh mesh;
    mesh.name = parts.name;
    mesh.vertices_m.resize(hierarchy.leaf_count());
    for (std::uint32_t leaf = 0; leaf < hierarchy.leaf_count(); ++leaf) {
        mesh.vertices_m[parts.original_vertices[leaf]] = glm::dvec3(hierarchy.position_m(leaf)) + parts.origin_m;
    }
    mesh.triangles.resize(hierarchy.face_count());
    for (std::uint32_t face = 0; face < hierarchy.face_count(); ++face) {
        models::Triangle& triangle = mesh.triangles[hierarchy.original_face(face)];
        std::ranges::transform(hierarchy.faces()[face], triangle.begin(),
            [&](std::uint32_t leaf) { return parts.original_vertices[leaf]; });
    }
    if (by == ColourBy::Nothing) { return mesh; }
    mesh.colours.resize(hierarchy.leaf_count());
    for (std::size_t vertex = 0; vertex < active.nodes.size(); ++vertex) {
        for (const std::uint32_t original : active.originals[vertex]) {
            mesh.colours[original] = colour_of(active, vertex, by);
        }
    }
    return mesh;
}

} // namespace octant::visuals::refine
