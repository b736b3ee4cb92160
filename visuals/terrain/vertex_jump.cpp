// The measure of popping: what the quadtree paper does not look at (it counts triangles) and
// geomorphs remove. `octant study popping` plots it along flights.
#include "visuals/terrain/vertex_jump.h"

#include <glm/geometric.hpp>

namespace octant::visuals::terrain {

std::optional<VertexJump> JumpMeter::next(const GroundMesh& mesh, const PictureView& view) {
    Frame& later = frames_[taken_ % 2];
    const Frame& earlier = frames_[(taken_ + 1) % 2];
    later.surface.take(mesh, view.eye_m);
    later.view = view;
    later.vertices_m.clear();
    used_.assign(mesh.vertices.size(), 0);
    for (const std::uint32_t vertex : mesh.indices) {
        if (used_[vertex] == 0) {
            used_[vertex] = 1;
            later.vertices_m.push_back(view.eye_m + glm::dvec3(mesh.vertices[vertex].position_m));
        }
    }
    if (++taken_ == 1) {
        return std::nullopt;
    }
    VertexJump most;
    compare_at(later, earlier, later, most);
    compare_at(earlier, later, later, most);
    return most;
}

/// Compares the vertices of `own` with the surface of `other`, as seen from `later`.
void JumpMeter::compare_at(
    const Frame& own, const Frame& other, const Frame& later, VertexJump& most) {
    for (const glm::dvec3& vertex_m : own.vertices_m) {
        const glm::dvec3 seen = later.view.seen_m(vertex_m - later.view.eye_m);
        if (!later.view.shows(seen) ||
            !own.view.shows(own.view.seen_m(vertex_m - own.view.eye_m)) ||
            !other.view.shows(other.view.seen_m(vertex_m - other.view.eye_m))) {
            continue;
        }
        const auto height_m = other.surface.height_at(vertex_m.x, vertex_m.y);
        if (!height_m) {
            continue;
        }
        const glm::dvec3 there =
            later.view.seen_m(glm::dvec3(vertex_m.x, vertex_m.y, *height_m) - later.view.eye_m);
        if (there.z < later.view.near_m) {
            continue;
        }
        const double jump_px = glm::distance(later.view.pixel(seen), later.view.pixel(there));
        if (jump_px > most.jump_px) {
            most = {jump_px, vertex_m};
        }
    }
}

} // namespace octant::visuals::terrain
