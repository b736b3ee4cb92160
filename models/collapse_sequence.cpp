#include "models/collapse_sequence.h"

#include <cassert>

namespace octant::models {

namespace {

/// The parent of each vertex, original and made, after the first `count` collapses; none = active.
std::vector<std::uint32_t> parents_after(const CollapseSequence& sequence, std::size_t count) {
    const std::size_t originals = sequence.original.vertices_m.size();
    std::vector<std::uint32_t> parents(originals + count, none);
    for (std::size_t i = 0; i < count; ++i) {
        const auto made = static_cast<std::uint32_t>(originals + i);
        parents[sequence.collapses[i].first] = made;
        parents[sequence.collapses[i].second] = made;
    }
    return parents;
}

} // namespace

TriangleMesh mesh_after(const CollapseSequence& sequence, std::size_t count) {
    assert(count <= sequence.collapses.size());
    const TriangleMesh& original = sequence.original;
    const std::size_t originals = original.vertices_m.size();
    const bool coloured = !original.colours.empty();
    TriangleMesh mesh;
    mesh.name = original.name;
    mesh.materials = original.materials;
    std::vector<std::uint32_t> ancestors = parents_after(sequence, count);
    std::vector<std::uint32_t> places(ancestors.size(), none);
    for (std::size_t v = 0; v < ancestors.size(); ++v) {
        if (ancestors[v] != none) { continue; }
        places[v] = static_cast<std::uint32_t>(mesh.vertices_m.size());
        const bool made = v >= originals;
        mesh.vertices_m.push_back(made ? sequence.collapses[v - originals].position_m : original.vertices_m[v]);
        if (coloured) { mesh.colours.push_back(made ? sequence.collapses[v - originals].colour : original.colours[v]); }
    }
    for (std::size_t v = ancestors.size(); v-- > 0;) { // a parent's number is the larger one
        ancestors[v] = ancestors[v] == none ? static_cast<std::uint32_t>(v) : ancestors[ancestors[v]];
    }
    for (std::size_t t = 0; t < original.triangles.size(); ++t) {
        Triangle corners = original.triangles[t];
        for (std::uint32_t& corner : corners) { corner = places[ancestors[corner]]; }
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) { continue; }
        mesh.triangles.push_back(corners);
        if (!original.triangle_materials.empty()) { mesh.triangle_materials.push_back(original.triangle_materials[t]); }
    }
    return mesh;
}

std::size_t collapses_to_faces(const CollapseSequence& sequence, std::size_t faces) {
    std::size_t left = sequence.original.triangles.size();
    std::size_t count = 0;
    while (left > faces && count < sequence.collapses.size()) {
        const Collapse& collapse = sequence.collapses[count];
        left -= static_cast<std::size_t>(collapse.left != none) + static_cast<std::size_t>(collapse.right != none);
        ++count;
    }
    return count;
}

} // namespace octant::models
