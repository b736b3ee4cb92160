// Conversion between files and working units, and from the mesh that is being changed back to a TriangleMesh.
//
// is_valid_deformation keeps steps from folding the surface over: the test of the angle between old and new normal of
// M. Garland and P. Heckbert (1997). Slivers are allowed where the error allows them: along cylinders and rims they lie
// best. The topology has a test of its own, CollapsibleMesh::effect_of.
//
// OriginalSurface finds the nearest point of a triangle by the regions of C. Ericson, "Real-Time Collision Detection",
// 2005, section 5.1.5.
#include "models/simplify/working_surface.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace octant::models::simplify {

WorkingUnits WorkingUnits::of(const TriangleMesh& mesh, double colour_weight) {
    // Colours that do not count are carried along with this weight.
    constexpr double min_weight = 1e-4;
    const BoundingBox bounds = bounds_of(mesh);
    const double diagonal_m = glm::distance(bounds.min_m, bounds.max_m);
    return {
        0.5 * (bounds.min_m + bounds.max_m), diagonal_m > 0.0 ? diagonal_m : 1.0, std::max(colour_weight, min_weight)};
}

glm::vec3 WorkingUnits::colour_to_file(const glm::dvec3& colour) const {
    return glm::clamp(glm::vec3(colour / colour_scale), glm::vec3(0.0F), glm::vec3(1.0F));
}

std::vector<glm::dvec3> WorkingUnits::places_of(const TriangleMesh& mesh) const {
    std::vector<glm::dvec3> places;
    places.reserve(mesh.vertices_m.size());
    for (const glm::dvec3& vertex_m : mesh.vertices_m) { places.push_back(from_file(vertex_m)); }
    return places;
}

std::vector<glm::dvec3> WorkingUnits::colours_of(const TriangleMesh& mesh) const {
    std::vector<glm::dvec3> colours;
    colours.reserve(mesh.colours.size());
    for (const glm::vec3& colour : mesh.colours) { colours.push_back(glm::dvec3(colour) * colour_scale); }
    return colours;
}

WorkingSurface::WorkingSurface(const TriangleMesh& from, const WorkingUnits& units)
    : mesh(from.vertices_m.size(), from.triangles), places(units.places_of(from)), colours(units.colours_of(from)),
      materials(from.triangle_materials) {}

bool WorkingSurface::is_border_vertex(std::uint32_t vertex) const {
    if (mesh.is_boundary_vertex(vertex)) { return true; }
    bool found = false;
    if (!materials.empty()) {
        mesh.around(vertex, [&](HalfEdge h) { found = found || is_material_border(h); });
    }
    return found;
}

void WorkingSurface::lock_border(const TriangleMesh& from, const WorkingUnits& units) {
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_slots(); ++vertex) {
        if (mesh.has_vertex(vertex) && mesh.is_boundary_vertex(vertex)) {
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
    if (is_locked(vertex)) { return glm::dvec3(0.0); }
    if (materials.empty() && !mesh.is_boundary_vertex(vertex)) { return way; }
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
    if (count == 0 || !(length > 0.0)) { return way; }
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

SlotMap WorkingSurface::compact() {
    SlotMap kept = mesh.compact();
    compact_slots(places, kept.vertices);
    if (coloured()) { compact_slots(colours, kept.vertices); }
    if (!materials.empty()) { compact_slots(materials, kept.faces); }
    return kept;
}

TriangleMesh WorkingSurface::to_mesh(const TriangleMesh& original, const WorkingUnits& units) const {
    TriangleMesh made;
    made.name = original.name;
    made.materials = original.materials;
    std::vector<std::uint32_t> numbers(mesh.vertex_slots(), none);
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
        if (!mesh.has_vertex(v)) { continue; }
        numbers[v] = static_cast<std::uint32_t>(made.vertices_m.size());
        made.vertices_m.push_back(to_file(places[v], units));
        if (coloured()) { made.colours.push_back(units.colour_to_file(colours[v])); }
    }
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        if (!mesh.has_face(face)) { continue; }
        const Triangle corners = mesh.corners(face);
        made.triangles.push_back({numbers[corners[0]], numbers[corners[1]], numbers[corners[2]]});
        if (!materials.empty()) { made.triangle_materials.push_back(materials[face]); }
    }
    return made;
}

bool is_valid_deformation(const std::array<glm::dvec3, 3>& before, const std::array<glm::dvec3, 3>& after) {
    const glm::dvec3 old_normal = area_vector(before);
    const glm::dvec3 new_normal = area_vector(after);
    if (!(glm::dot(new_normal, new_normal) > 0.0)) { return false; }
    return !(glm::dot(old_normal, old_normal) > 0.0) || glm::dot(old_normal, new_normal) > 0.0;
}

bool may_flip_to(
    const std::array<std::array<glm::dvec3, 3>, 2>& before, const std::array<std::array<glm::dvec3, 3>, 2>& after) {
    return std::ranges::all_of(before, [&](const auto& from) {
        return std::ranges::all_of(after, [&](const auto& to) { return is_valid_deformation(from, to); });
    });
}

bool may_move(const WorkingSurface& surface, std::span<const RingFace> ring, const glm::dvec3& place) {
    return std::ranges::all_of(ring, [&](const RingFace& face) {
        const glm::dvec3& old_place = surface.places[surface.mesh.origin(face.half_edge)];
        return is_valid_deformation(moved_corners(surface, face, old_place), moved_corners(surface, face, place));
    });
}

namespace {

/// Where the squared share of its sides' rectangle that a triangle covers is below this, rounding hides on which side
/// of it a point lies; the nearest point of its sides is taken then.
constexpr double min_area_share2 = 1e-12;

} // namespace

OriginalSurface::OriginalSurface(const WorkingSurface& surface, const TriangleMesh& made_of, const WorkingUnits& units)
    : mesh_(made_of), units_(units), places_(surface.places) {
    const CollapsibleMesh& mesh = surface.mesh;
    neighbours_.reserve(mesh.face_slots());
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        std::array<std::uint32_t, 3>& beyond = neighbours_.emplace_back();
        for (std::uint32_t side = 0; side < 3; ++side) {
            const HalfEdge twin = mesh.twin(3 * face + side);
            beyond[side] = twin == none ? none : face_of(twin);
        }
    }
}

const std::shared_ptr<const measure::TriangleBvh>& OriginalSurface::tree() const {
    if (!tree_) { tree_ = std::make_shared<const measure::TriangleBvh>(mesh_); }
    return tree_;
}

measure::NearestOnMesh OriginalSurface::nearest(const glm::dvec3& place) const {
    measure::NearestOnMesh found = tree()->nearest(units_.to_file(place));
    found.point = units_.from_file(found.point);
    found.distance2 /= units_.diagonal_m * units_.diagonal_m;
    return found;
}

glm::dvec3 OriginalSurface::normal(std::uint32_t triangle) const {
    const auto [a, b, c] = mesh_.triangles[triangle];
    return area_vector({places_[a], places_[b], places_[c]});
}

OriginalSurface::OnTriangle OriginalSurface::nearest_on(std::uint32_t triangle, const glm::dvec3& point) const {
    const Triangle& t = mesh_.triangles[triangle];
    const glm::dvec3& a = places_[t[0]];
    const glm::dvec3 ab = places_[t[1]] - a;
    const glm::dvec3 ac = places_[t[2]] - a;
    const glm::dvec3 ap = point - a;
    const double d1 = glm::dot(ab, ap);
    const double d2 = glm::dot(ac, ap);
    const auto made = [&](const glm::dvec3& from_a, std::uint32_t side, std::uint32_t corner) {
        const glm::dvec3 off = ap - from_a;
        return OnTriangle{a + from_a, glm::dot(off, off), side, corner};
    };
    if (d1 <= 0.0 && d2 <= 0.0) { return made(glm::dvec3(0.0), none, 0); }
    const double bb = glm::dot(ab, ab);
    const double bc = glm::dot(ab, ac);
    const double cc = glm::dot(ac, ac);
    const double d3 = d1 - bb;
    const double d4 = d2 - bc;
    if (d3 >= 0.0 && d4 <= d3) { return made(ab, none, 1); }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) { return made((bb > 0.0 ? d1 / bb : 0.0) * ab, 0, none); }
    const double d5 = d1 - bc;
    const double d6 = d2 - cc;
    if (d6 >= 0.0 && d5 <= d6) { return made(ac, none, 2); }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) { return made((cc > 0.0 ? d2 / cc : 0.0) * ac, 2, none); }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double length = (d4 - d3) + (d5 - d6);
        const double along = length > 0.0 ? (d4 - d3) / length : 0.0;
        return made(ab + along * (ac - ab), 1, none);
    }
    const double sum = va + vb + vc;
    if (!(sum > min_area_share2 * bb * cc)) {
        const auto on_side = [&](std::uint32_t side, const glm::dvec3& from, const glm::dvec3& way) {
            const double length2 = glm::dot(way, way);
            const double along = glm::dot(ap - from, way);
            const bool ends = !(along > 0.0 && along < length2);
            const std::uint32_t corner = along > 0.0 ? (side + 1) % 3 : side;
            const double share = ends ? (along > 0.0 ? 1.0 : 0.0) : along / length2;
            return made(from + share * way, ends ? none : side, ends ? corner : none);
        };
        const OnTriangle sides[] = {on_side(0, glm::dvec3(0.0), ab), on_side(1, ab, ac - ab), on_side(2, ac, -ac)};
        return *std::ranges::min_element(sides, {}, &OnTriangle::distance2);
    }
    return made((vb / sum) * ab + (vc / sum) * ac, none, none);
}

OriginalPoint OriginalSurface::nearest_from(std::uint32_t start, const glm::dvec3& point, double& distance2) const {
    std::uint32_t at = start;
    OnTriangle best = nearest_on(at, point);
    while (true) {
        std::uint32_t next = none;
        OnTriangle nearer;
        const auto look = [&](std::uint32_t triangle) {
            const OnTriangle here = nearest_on(triangle, point);
            const double least2 = next == none ? best.distance2 : nearer.distance2;
            if (here.distance2 < least2) {
                nearer = here;
                next = triangle;
            }
        };
        if (best.side != none && neighbours_[at][best.side] != none) {
            look(neighbours_[at][best.side]);
        } else if (best.corner != none) {
            // Around the corner, first one way and at a boundary then the other way.
            const std::uint32_t corner = mesh_.triangles[at][best.corner];
            for (const bool forward : {true, false}) {
                std::uint32_t triangle = at;
                do {
                    std::uint32_t i = 0;
                    while (mesh_.triangles[triangle][i] != corner) { ++i; }
                    triangle = neighbours_[triangle][forward ? (i + 2) % 3 : i];
                    if (triangle != none && triangle != at) { look(triangle); }
                } while (triangle != none && triangle != at);
                if (triangle == at) { break; }
            }
        }
        if (next == none) {
            distance2 = best.distance2;
            return {measure::narrow(best.place), at};
        }
        best = nearer;
        at = next;
    }
}

} // namespace octant::models::simplify
