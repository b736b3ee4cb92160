#include "visuals/refine/active_mesh.h"

#include <algorithm>

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

} // namespace octant::visuals::refine
