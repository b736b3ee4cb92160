#include "models/collapse_sequence.h"
#include "models/measure/mesh_defects.h"
#include "models/simplify/simplify.h"
#include "models/simplify/working_surface.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <set>
#include <vector>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

/// Whether collapsing an edge leaves a manifold of the same topology.
bool may_collapse(const CollapsibleMesh& mesh, HalfEdge h) {
    return mesh.effect_of(h, TopologyChanges::None).kind == CollapseEffect::Kind::SameTopology;
}

CollapsibleMesh collapsible(const TriangleMesh& mesh) { return {mesh.vertices_m.size(), mesh.triangles}; }

HalfEdge edge_between(const CollapsibleMesh& mesh, std::uint32_t from, std::uint32_t to) {
    HalfEdge found = none;
    for (HalfEdge h = 0; h < mesh.face_slots() * 3; ++h) {
        if (mesh.has_face(face_of(h)) && mesh.origin(h) == from && mesh.target(h) == to) { found = h; }
    }
    return found;
}

TriangleMesh what_is_there(const CollapsibleMesh& mesh, const TriangleMesh& places) {
    TriangleMesh made;
    made.vertices_m = places.vertices_m;
    made.vertices_m.resize(mesh.vertex_slots());
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        if (mesh.has_face(face)) { made.triangles.push_back(mesh.corners(face)); }
    }
    return made;
}

std::set<std::uint32_t> neighbours(const CollapsibleMesh& mesh, std::uint32_t vertex) {
    std::set<std::uint32_t> found;
    mesh.edges_around(
        vertex, [&](HalfEdge h) { found.insert(mesh.origin(h) == vertex ? mesh.target(h) : mesh.origin(h)); });
    return found;
}

} // namespace

TEST_CASE("a tetrahedron may not collapse any edge: two equal triangles would be left") {
    const CollapsibleMesh mesh = collapsible(tetrahedron());
    for (HalfEdge h = 0; h < 12; ++h) { CHECK_FALSE(may_collapse(mesh, h)); }
}

TEST_CASE("an octahedron collapses to a closed manifold of 6 triangles and 5 vertices") {
    const TriangleMesh original = octahedron();
    CollapsibleMesh mesh = collapsible(original);
    const HalfEdge h = edge_between(mesh, 0, 4);
    REQUIRE(may_collapse(mesh, h));
    mesh.collapse(h);
    CHECK(mesh.face_count() == 6);
    CHECK(mesh.vertex_count() == 5);
    CHECK_FALSE(mesh.has_vertex(4));
    CHECK(neighbours(mesh, 0) == std::set<std::uint32_t>{1, 2, 3, 5});
    const TriangleMesh after = what_is_there(mesh, original);
    CHECK(is_manifold(after));
    CHECK(boundary_edges(after) == 0);
}

TEST_CASE("an edge whose ends share a neighbour beside its triangles stays: it is a bottleneck") {
    // A ring of three quads around: edges 0-1, 1-2, 2-0 run round the hole without a triangle.
    TriangleMesh prism;
    prism.vertices_m.resize(6);
    prism.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
    const CollapsibleMesh mesh = collapsible(prism);
    CHECK_FALSE(may_collapse(mesh, edge_between(mesh, 0, 1)));
    CHECK_FALSE(may_collapse(mesh, edge_between(mesh, 0, 4))); // from boundary to boundary, inside
}

TEST_CASE("an edge of the boundary may collapse, but neither a lone triangle nor one across") {
    const TriangleMesh flat = strip(1, 3);
    const CollapsibleMesh mesh = collapsible(flat);
    CHECK(mesh.face_count() == 6);
    std::size_t may = 0;
    for (HalfEdge h = 0; h < 18; ++h) {
        const bool across = mesh.twin(h) != none;
        if (may_collapse(mesh, h)) {
            ++may;
            CHECK_FALSE(across);
        }
    }
    CHECK(may > 0);
    TriangleMesh lone;
    lone.vertices_m.resize(3);
    lone.triangles = {{0, 1, 2}};
    CHECK_FALSE(may_collapse(collapsible(lone), 0));
}

TEST_CASE("a flip leaves a closed manifold") {
    const TriangleMesh original = octahedron();
    CollapsibleMesh mesh = collapsible(original);
    CHECK_FALSE(CollapsibleMesh(collapsible(tetrahedron())).may_flip(0));
    const HalfEdge h = edge_between(mesh, 0, 2);
    REQUIRE(mesh.may_flip(h));
    mesh.flip(h);
    CHECK(neighbours(mesh, 4).contains(5));
    CHECK_FALSE(neighbours(mesh, 0).contains(2));
    const TriangleMesh after = what_is_there(mesh, original);
    CHECK(after.triangles.size() == 8);
    CHECK(is_manifold(after));
    CHECK(boundary_edges(after) == 0);
    CHECK(euler_number(after) == 2);
}

TEST_CASE("a compacted mesh is the same with fewer slots") {
    const TriangleMesh original = ball(12);
    CollapsibleMesh mesh = collapsible(original);
    for (HalfEdge h = 0; h < mesh.face_slots() * 3; h += 7) {
        if (mesh.has_face(face_of(h)) && may_collapse(mesh, h)) { mesh.collapse(h); }
    }
    const CollapsibleMesh before = mesh;
    const SlotMap kept = mesh.compact();
    REQUIRE(mesh.face_count() == mesh.face_slots());
    REQUIRE(mesh.vertex_count() == mesh.vertex_slots());
    REQUIRE(mesh.face_slots() < before.face_slots());
    CHECK(mesh.face_count() == before.face_count());
    for (HalfEdge h = 0; h < mesh.face_slots() * 3; ++h) {
        const HalfEdge old = 3 * kept.faces[face_of(h)] + h % 3;
        CHECK(kept.vertices[mesh.origin(h)] == before.origin(old));
        const HalfEdge twin = mesh.twin(h);
        CHECK((twin == none ? none : 3 * kept.faces[face_of(twin)] + twin % 3) == before.twin(old));
        CHECK(may_collapse(mesh, h) == may_collapse(before, old));
    }
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_slots(); ++vertex) {
        CHECK(neighbours(mesh, vertex).size() == neighbours(before, kept.vertices[vertex]).size());
    }
}

TEST_CASE("a vertex of very many triangles costs no more to join than others") {
    constexpr std::uint32_t count = 150'000;
    std::vector<Triangle> fan;
    for (std::uint32_t i = 0; i < count; ++i) { fan.push_back({0, 1 + i, 1 + (i + 1) % count}); }
    const CollapsibleMesh mesh(count + 1, fan);
    std::size_t around = 0;
    mesh.around(0, [&](HalfEdge) { ++around; });
    CHECK(around == count);
    CHECK(mesh.twin(1) == none);
    CHECK(mesh.twin(0) == 3 * (count - 1) + 2);
}

namespace {

SimplifyOptions fast_to_40_faces() {
    SimplifyOptions options;
    options.goal.faces = 40;
    return options;
}

} // namespace

TEST_CASE("a sequence leads to the mesh before the optimization") {
    for (const TriangleMesh& fine : {ball(16), ring(16, 12), strip(8, 12), machined_part(6)}) {
        const Simplified result = simplified(fine, fast_to_40_faces());
        const TriangleMesh end = mesh_after(result.sequence, result.sequence.collapses.size());
        CHECK(result.mesh.triangles.size() == end.triangles.size());
    }
}

TEST_CASE("each collapse of a sequence takes out what it says") {
    for (const TriangleMesh& fine : {ball(16), ring(16, 12), strip(8, 12), machined_part(6)}) {
        const SimplifyOptions options = fast_to_40_faces();
        for (const CollapseSequence& sequence : {fast_sequence(fine, options), simplified(fine, options).sequence}) {
            std::size_t faces = fine.triangles.size();
            double error_m = 0.0;
            for (std::size_t i = 0; i < sequence.collapses.size(); ++i) {
                const Collapse& collapse = sequence.collapses[i];
                REQUIRE(collapse.first < fine.vertices_m.size() + i);
                REQUIRE(collapse.second < fine.vertices_m.size() + i);
                REQUIRE(collapse.left != none);
                CHECK(collapse.error_m >= error_m);
                error_m = collapse.error_m;
                faces -= collapse.right == none ? 1 : 2;
                if (i % 25 == 0) {
                    const TriangleMesh state = mesh_after(sequence, i + 1);
                    REQUIRE(state.triangles.size() == faces);
                    REQUIRE(is_manifold(state));
                    REQUIRE(boundary_edges(state) <= boundary_edges(fine));
                }
            }
        }
    }
}

TEST_CASE("left of a collapse lies left of the edge from first to second") {
    const TriangleMesh fine = octahedron();
    SimplifyOptions options;
    options.goal.faces = 6;
    const Simplified result = simplified(fine, options);
    REQUIRE(result.sequence.collapses.size() == 1);
    const Collapse& collapse = result.sequence.collapses[0];
    const Triangle& left = fine.triangles[collapse.left];
    const Triangle& right = fine.triangles[collapse.right];
    bool runs = false;
    bool runs_back = false;
    for (std::size_t i = 0; i < 3; ++i) {
        runs = runs || (left[i] == collapse.first && left[(i + 1) % 3] == collapse.second);
        runs_back = runs_back || (right[i] == collapse.second && right[(i + 1) % 3] == collapse.first);
    }
    CHECK(runs);
    CHECK(runs_back);
}
