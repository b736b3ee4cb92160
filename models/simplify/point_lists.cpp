// Which triangle of the present surface a point of the original is nearest to, where collapses did
// not keep it up to date: asked of a tree, or followed along the collapses and then improved from
// neighbour to neighbour.
#include "models/simplify/point_lists.h"

#include "models/measure/triangle_bvh.h"
#include "models/simplify/aims.h"
#include "models/simplify/point_block.h"
#include "models/simplify/surface_cost.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace octant::models::simplify {

namespace {

/// For each vertex of the mesh at first the slot of the vertex that it became.
std::vector<std::uint32_t> slots_became(const CollapsingSurface& collapsing, std::size_t vertices) {
    const std::vector<Collapse>& collapses = collapsing.collapses();
    std::vector<std::uint32_t> slots(vertices + collapses.size(), none);
    for (std::uint32_t slot = 0; slot < collapsing.vertex_numbers().size(); ++slot) {
        if (collapsing.surface().mesh.vertex_is_there(slot)) {
            slots[collapsing.vertex_numbers()[slot]] = slot;
        }
    }
    for (std::size_t i = collapses.size(); i-- > 0;) {
        slots[collapses[i].first] = slots[vertices + i];
        slots[collapses[i].second] = slots[vertices + i];
    }
    slots.resize(vertices);
    return slots;
}

/// The triangle and all that share a vertex with it.
void take_around(
    const CollapsibleMesh& mesh, std::uint32_t face, std::vector<std::uint32_t>& found) {
    found.assign(1, face);
    for (const std::uint32_t vertex : mesh.corners(face)) {
        mesh.around(vertex, [&](HalfEdge h) {
            if (std::ranges::find(found, face_of(h)) == found.end()) {
                found.push_back(face_of(h));
            }
        });
    }
}

} // namespace

TrackedPoints
points_on(const WorkingSurface& surface, const TargetMesh& target, std::size_t wanted) {
    TrackedPoints points(target, wanted);
    std::vector<Triangle> triangles;
    for (std::uint32_t face = 0; face < surface.mesh.face_slots(); ++face) {
        triangles.push_back(surface.mesh.corners(face));
    }
    const measure::TriangleBvh tree(surface.places, triangles);
    std::vector<std::uint32_t> nearest(points.size());
    for (std::uint32_t point = 0; point < points.size(); ++point) {
        const auto& place = points.place(point);
        nearest[point] = tree.nearest({place[0], place[1], place[2]}).triangle;
    }
    points.assign_all(nearest, surface.mesh.face_slots());
    return points;
}

TrackedPoints
points_carried(const CollapsingSurface& collapsing, const TargetMesh& target, std::size_t wanted) {
    const std::vector<std::uint32_t> slots = slots_became(collapsing, target.places.size());
    const CollapsibleMesh& mesh = collapsing.surface().mesh;
    TrackedPoints points(target, wanted);
    std::vector<std::uint32_t> nearest(points.size());
    for (std::uint32_t point = 0; point < points.size(); ++point) {
        const std::uint32_t corner = target.triangles[points.face(point)][0];
        nearest[point] = mesh.face_at(slots[corner]);
    }
    points.assign_all(nearest, mesh.face_slots());
    return points;
}

void list_nearer(const WorkingSurface& surface, TrackedPoints& points, int threads) {
    const CollapsibleMesh& mesh = surface.mesh;
    std::vector<std::uint32_t> chosen(points.size(), none);
    for_face_ranges(mesh, threads, [&](std::uint32_t first, std::uint32_t end) {
        PointBlock block;
        std::vector<FlatTriangle> triangles;
        std::vector<std::uint32_t> near;
        for (std::uint32_t face = first; face < end; ++face) {
            if (!mesh.face_is_there(face)) {
                continue;
            }
            block.clear();
            points.gather(face, block);
            take_around(mesh, face, near);
            triangles.clear();
            for (const std::uint32_t other : near) {
                triangles.push_back(flat(surface.corner_places(other)));
            }
            find_nearest(block, 0, block.size(), triangles, false);
            for (std::size_t i = 0; i < block.size(); ++i) {
                chosen[block.numbers[i]] = near[static_cast<std::size_t>(block.nearest[i])];
            }
        }
    });
    points.assign_all(chosen, mesh.face_slots());
}

void measure_lists(const WorkingSurface& surface, TrackedPoints& points) {
    SurfaceCost cost;
    for (std::uint32_t face = 0; face < surface.mesh.face_slots(); ++face) {
        if (surface.mesh.face_is_there(face)) {
            const std::array<std::uint32_t, 1> alone = {face};
            cost.gather(points, alone);
            cost.triangles.assign(1, flat(surface, face));
            cost.total();
            points.assign(cost.block(), alone, alone);
        }
    }
}

} // namespace octant::models::simplify
