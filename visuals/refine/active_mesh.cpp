// Pictures of what selective refinement does: J. Kim, S. Lee, "Truly Selective Refinement of Progressive Meshes",
// Graphics Interface 2001, section 3, where an active mesh is explained as the partition of the original vertices among
// the active nodes. Used by `octant refine --colour-by` and `--out-partition`.
#include "visuals/refine/active_mesh.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace octant::visuals::refine {

namespace {

/// All slots that hold a vertex, ordered by the sequence numbers of their nodes.
std::vector<std::uint32_t> slots_in_order(const SelectiveRefiner& refiner) {
    std::vector<std::uint32_t> slots;
    for (std::uint32_t slot = 0; slot < refiner.vertices().size(); ++slot) {
        if (refiner.node_at(slot) != none) { slots.push_back(slot); }
    }
    std::ranges::sort(
        slots, {}, [&](std::uint32_t slot) { return refiner.mesh().sequence_number(refiner.node_at(slot)); });
    return slots;
}

/// Adds the active faces to `mesh`, ordered by their original faces. `vertices` gives for each slot its vertex in
/// `mesh`.
void add_triangles(
    const SelectiveRefiner& refiner, const std::vector<std::uint32_t>& vertices, models::TriangleMesh& mesh) {
    const ProgressiveMeshData& parts = refiner.mesh().parts();
    std::vector<std::uint32_t> places;
    for (std::uint32_t place = 0; 3 * std::size_t{place} < refiner.indices().size(); ++place) {
        if (refiner.face_at(place) != none) { places.push_back(place); }
    }
    std::ranges::sort(
        places, {}, [&](std::uint32_t place) { return refiner.mesh().original_face(refiner.face_at(place)); });
    for (const std::uint32_t place : places) {
        const auto corners = refiner.indices().subspan(3 * std::size_t{place}, 3);
        mesh.triangles.push_back({vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]});
        if (!parts.face_materials.empty()) {
            mesh.triangle_materials.push_back(parts.face_materials[refiner.face_at(place)]);
        }
    }
}

} // namespace

ActiveMesh active_mesh(const SelectiveRefiner& refiner) {
    const ProgressiveMesh& hierarchy = refiner.mesh();
    const ProgressiveMeshData& parts = hierarchy.parts();
    ActiveMesh active;
    active.mesh.name = parts.name;
    active.mesh.materials = parts.materials;
    std::vector<std::uint32_t> vertices(refiner.vertices().size(), none); // by slot
    for (const std::uint32_t slot : slots_in_order(refiner)) {
        const std::uint32_t node = refiner.node_at(slot);
        vertices[slot] = static_cast<std::uint32_t>(active.nodes.size());
        active.nodes.push_back(hierarchy.sequence_number(node));
        active.mesh.vertices_m.push_back(glm::dvec3(hierarchy.position_m(node)) + parts.origin_m);
        if (hierarchy.has_colours()) { active.mesh.colours.push_back(unpacked(hierarchy.packed_colour(node))); }
    }
    add_triangles(refiner, vertices, active.mesh);
    active.originals.resize(active.nodes.size());
    for (std::uint32_t leaf = 0; leaf < hierarchy.leaf_count(); ++leaf) {
        const std::uint32_t slot = refiner.slot(refiner.active_ancestor(leaf));
        active.originals[vertices[slot]].push_back(parts.original_vertices[leaf]);
    }
    for (std::vector<std::uint32_t>& below : active.originals) { std::ranges::sort(below); }
    return active;
}

models::TriangleMesh finest_mesh(const ProgressiveMesh& hierarchy) {
    const ProgressiveMeshData& parts = hierarchy.parts();
    models::TriangleMesh mesh;
    mesh.name = parts.name;
    mesh.notes = parts.notes;
    for (std::uint32_t leaf = 0; leaf < hierarchy.leaf_count(); ++leaf) {
        mesh.vertices_m.push_back(parts.origin_m + glm::dvec3(hierarchy.position_m(leaf)));
        if (hierarchy.has_colours()) { mesh.colours.push_back(unpacked(hierarchy.packed_colour(leaf))); }
    }
    mesh.triangles = parts.faces;
    mesh.triangle_materials.assign(parts.face_materials.begin(), parts.face_materials.end());
    if (!parts.face_materials.empty()) { mesh.materials = parts.materials; }
    return mesh;
}

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
