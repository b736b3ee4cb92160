// Conversion between files and working units, and from the mesh that is being changed back to a
// TriangleMesh.
//
// may_become keeps steps from folding the surface over: the test of the angle between old and new normal of M.
// Garland and P. Heckbert (1997). Slivers are allowed where the error allows them: along cylinders
// and rims they lie best. The topology has a test of its own, CollapsibleMesh::may_collapse.
#include "models/simplify/working_surface.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace octant::models::simplify {

bool may_become(const std::array<glm::dvec3, 3>& before, const std::array<glm::dvec3, 3>& after) {
    const glm::dvec3 old_normal = area_vector(before);
    const glm::dvec3 new_normal = area_vector(after);
    if (!(glm::dot(new_normal, new_normal) > 0.0)) {
        return false;
    }
    return !(glm::dot(old_normal, old_normal) > 0.0) || glm::dot(old_normal, new_normal) > 0.0;
}

bool may_flip_to(
    const std::array<std::array<glm::dvec3, 3>, 2>& before,
    const std::array<std::array<glm::dvec3, 3>, 2>& after) {
    return std::ranges::all_of(before, [&](const auto& from) {
        return std::ranges::all_of(after, [&](const auto& to) { return may_become(from, to); });
    });
}

bool may_move(
    const WorkingSurface& surface, std::span<const RingFace> ring, const glm::dvec3& place) {
    return std::ranges::all_of(ring, [&](const RingFace& face) {
        const glm::dvec3& old_place = surface.places[surface.mesh.origin(face.half_edge)];
        return may_become(
            moved_corners(surface, face, old_place), moved_corners(surface, face, place));
    });
}

WorkingUnits WorkingUnits::of(const TriangleMesh& mesh, double colour_weight) {
    // Colours that do not count are carried along with this weight.
    constexpr double least_weight = 1e-4;
    const Bounds bounds = bounds_of(mesh);
    const double diagonal_m = glm::distance(bounds.least_m, bounds.most_m);
    return {
        0.5 * (bounds.least_m + bounds.most_m),
        diagonal_m > 0.0 ? diagonal_m : 1.0,
        std::max(colour_weight, least_weight)};
}

glm::vec3 WorkingUnits::colour_to_file(const glm::dvec3& colour) const {
    return glm::clamp(glm::vec3(colour / colour_scale), glm::vec3(0.0F), glm::vec3(1.0F));
}

std::vector<glm::dvec3> WorkingUnits::places_of(const TriangleMesh& mesh) const {
    std::vector<glm::dvec3> places;
    places.reserve(mesh.vertices_m.size());
    for (const glm::dvec3& vertex_m : mesh.vertices_m) {
        places.push_back(from_file(vertex_m));
    }
    return places;
}

std::vector<glm::dvec3> WorkingUnits::colours_of(const TriangleMesh& mesh) const {
    std::vector<glm::dvec3> colours;
    colours.reserve(mesh.colours.size());
    for (const glm::vec3& colour : mesh.colours) {
        colours.push_back(glm::dvec3(colour) * colour_scale);
    }
    return colours;
}

WorkingSurface::WorkingSurface(const TriangleMesh& from, const WorkingUnits& units)
    : mesh(from.vertices_m.size(), from.triangles)
    , places(units.places_of(from))
    , colours(units.colours_of(from))
    , materials(from.triangle_materials) {}

bool WorkingSurface::is_border_vertex(std::uint32_t vertex) const {
    if (mesh.is_boundary_vertex(vertex)) {
        return true;
    }
    bool found = false;
    if (!materials.empty()) {
        mesh.around(vertex, [&](HalfEdge h) { found = found || is_material_border(h); });
    }
    return found;
}

void WorkingSurface::lock_border(const TriangleMesh& from, const WorkingUnits& units) {
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_slots(); ++vertex) {
        if (mesh.vertex_is_there(vertex) && mesh.is_boundary_vertex(vertex)) {
            const glm::dvec3 place = units.from_file(from.vertices_m[vertex]);
            locked_m[{place.x, place.y, place.z}] = from.vertices_m[vertex];
        }
    }
}

glm::dvec3 WorkingSurface::to_file(const glm::dvec3& place, const WorkingUnits& units) const {
    const auto locked = locked_m.find({place.x, place.y, place.z});
    return locked == locked_m.end() ? units.to_file(place) : locked->second;
}

glm::dvec3 WorkingSurface::along_borders(std::uint32_t vertex, const glm::dvec3& way) const {
    if (is_locked(vertex)) {
        return glm::dvec3(0.0);
    }
    if (materials.empty() && !mesh.is_boundary_vertex(vertex)) {
        return way;
    }
    constexpr double straight = -0.5; // The cosine between two borders that go on as one.
    glm::dvec3 normal(0.0);
    std::array<glm::dvec3, 2> borders;
    std::size_t count = 0;
    mesh.edges_around(vertex, [&](HalfEdge h) {
        normal += area_vector(corner_places(face_of(h)));
        if (is_border(h)) {
            const std::uint32_t other = mesh.origin(h) == vertex ? mesh.target(h) : mesh.origin(h);
            const glm::dvec3 border = places[other] - places[vertex];
            const double length = glm::length(border);
            borders[count % 2] = length > 0.0 ? border / length : border;
            ++count;
        }
    });
    const double length = glm::length(normal);
    if (count == 0 || !(length > 0.0)) {
        return way;
    }
    normal /= length;
    const glm::dvec3 up = glm::dot(way, normal) * normal;
    if (count != 2 || !(glm::dot(borders[0], borders[1]) < straight)) {
        return up; // Corners of borders stay.
    }
    const glm::dvec3 along = borders[1] - borders[0];
    const glm::dvec3 flat = along - glm::dot(along, normal) * normal;
    const double flat2 = glm::dot(flat, flat);
    return flat2 > 0.0 ? up + glm::dot(way, flat) / flat2 * flat : up;
}

KeptSlots WorkingSurface::compact() {
    KeptSlots kept = mesh.compact();
    keep_slots(places, kept.vertices);
    if (coloured()) {
        keep_slots(colours, kept.vertices);
    }
    if (!materials.empty()) {
        keep_slots(materials, kept.faces);
    }
    return kept;
}

TriangleMesh
WorkingSurface::to_mesh(const TriangleMesh& original, const WorkingUnits& units) const {
    TriangleMesh made;
    made.name = original.name;
    made.materials = original.materials;
    std::vector<std::uint32_t> numbers(mesh.vertex_slots(), none);
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
        if (!mesh.vertex_is_there(v)) {
            continue;
        }
        numbers[v] = static_cast<std::uint32_t>(made.vertices_m.size());
        made.vertices_m.push_back(to_file(places[v], units));
        if (coloured()) {
            made.colours.push_back(units.colour_to_file(colours[v]));
        }
    }
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        if (!mesh.face_is_there(face)) {
            continue;
        }
        const Triangle corners = mesh.corners(face);
        made.triangles.push_back({numbers[corners[0]], numbers[corners[1]], numbers[corners[2]]});
        if (!materials.empty()) {
            made.triangle_materials.push_back(materials[face]);
        }
    }
    return made;
}

} // namespace octant::models::simplify
