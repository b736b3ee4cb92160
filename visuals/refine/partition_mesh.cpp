#include "visuals/refine/partition_mesh.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace octant::visuals::refine {

namespace refine = visuals::refine;

namespace {

/// Full colours around the circle, 0..1.
glm::vec3 hue(float turn) {
    const auto part = [&](float from) {
        const float at = turn + from - std::floor(turn + from);
        return glm::clamp(std::abs(6.0F * at - 3.0F) - 1.0F, 0.0F, 1.0F);
    };
    return {part(0.0F), part(2.0F / 3.0F), part(1.0F / 3.0F)};
}

/// Numbers that follow one another are far apart in colour (golden ratio).
glm::vec3 region_colour(std::uint32_t node) {
    constexpr double golden = 0.6180339887498949;
    const auto turn = static_cast<float>(std::fmod(golden * node, 1.0));
    constexpr float paleness = 0.12F;
    const float strength = 0.95F - 0.2F * static_cast<float>(node % 3);
    return strength * glm::mix(hue(turn), glm::vec3(1.0F), paleness);
}

glm::vec3 level_colour(std::size_t originals) {
    constexpr float warmest = 10.0F; // doublings
    constexpr float blue = 0.66F;
    const float level = std::min(std::log2(static_cast<float>(originals)) / warmest, 1.0F);
    return 0.9F * glm::mix(hue(blue * (1.0F - level)), glm::vec3(1.0F), 0.25F);
}

glm::vec3 colour_of(const refine::ActiveMesh& active, std::size_t vertex, ColourBy by) {
    return by == ColourBy::Region ? region_colour(active.nodes[vertex])
                                  : level_colour(active.originals[vertex].size());
}

} // namespace

models::TriangleMesh coloured_active(refine::ActiveMesh active, ColourBy by) {
    if (by != ColourBy::Nothing) {
        active.mesh.colours.resize(active.nodes.size());
        for (std::size_t vertex = 0; vertex < active.nodes.size(); ++vertex) {
            active.mesh.colours[vertex] = colour_of(active, vertex, by);
        }
    }
    return std::move(active.mesh);
}

models::TriangleMesh partition_mesh(const refine::SelectiveRefiner& refiner, ColourBy by) {
    const refine::ProgressiveMesh& hierarchy = refiner.mesh();
    const refine::ProgressiveParts& parts = hierarchy.parts();
    const refine::ActiveMesh active = refine::active_mesh(refiner);
    models::TriangleMesh mesh;
    mesh.name = parts.name;
    mesh.vertices_m.resize(hierarchy.leaf_count());
    for (std::uint32_t leaf = 0; leaf < hierarchy.leaf_count(); ++leaf) {
        mesh.vertices_m[parts.original_vertices[leaf]] =
            glm::dvec3(hierarchy.position_m(leaf)) + parts.origin_m;
    }
    mesh.triangles.resize(hierarchy.face_count());
    for (std::uint32_t face = 0; face < hierarchy.face_count(); ++face) {
        models::Triangle& triangle = mesh.triangles[hierarchy.original_face(face)];
        std::ranges::transform(hierarchy.faces()[face], triangle.begin(), [&](std::uint32_t leaf) {
            return parts.original_vertices[leaf];
        });
    }
    if (by == ColourBy::Nothing) {
        return mesh;
    }
    mesh.colours.resize(hierarchy.leaf_count());
    for (std::size_t vertex = 0; vertex < active.nodes.size(); ++vertex) {
        for (const std::uint32_t original : active.originals[vertex]) {
            mesh.colours[original] = colour_of(active, vertex, by);
        }
    }
    return mesh;
}

} // namespace octant::visuals::refine
