#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <cstdio>

#include "peers.h"

namespace octant::tests::peers {

namespace {

struct DoubleTraits : OpenMesh::DefaultTraitsDouble {};

using Mesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using Decimater = OpenMesh::Decimater::DecimaterT<Mesh>;
using Quadric = OpenMesh::Decimater::ModQuadricT<Mesh>;

/// Faces that OpenMesh cannot hold (non-manifold) are left out, and counted on stderr.
Mesh openmesh(const PeerMesh& mesh) {
    Mesh made;
    std::vector<Mesh::VertexHandle> vertices;
    for (const auto& [x, y, z] : mesh.vertices) { vertices.push_back(made.add_vertex({x, y, z})); }
    int refused = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        refused += made.add_face(vertices[a], vertices[b], vertices[c]).is_valid() ? 0 : 1;
    }
    if (refused > 0) { std::fprintf(stderr, "openmesh-quadric: %d faces left out\n", refused); }
    return made;
}

PeerMesh peer_mesh(const Mesh& mesh) {
    PeerMesh made;
    for (const Mesh::VertexHandle vertex : mesh.vertices()) {
        const Mesh::Point& point = mesh.point(vertex);
        made.vertices.push_back({point[0], point[1], point[2]});
    }
    for (const Mesh::FaceHandle face : mesh.faces()) {
        std::array<std::uint32_t, 3> triangle{};
        std::size_t corner = 0;
        for (const Mesh::VertexHandle vertex : mesh.fv_range(face)) {
            triangle.at(corner++) = static_cast<std::uint32_t>(vertex.idx());
        }
        made.triangles.push_back(triangle);
    }
    return without_unused_vertices(made);
}

} // namespace

PeerResult openmesh_quadric(const PeerMesh& mesh, std::size_t faces) {
    Mesh work = openmesh(mesh);
    work.request_vertex_status(); // the decimater would take its own ones with it
    work.request_edge_status();
    work.request_halfedge_status();
    work.request_face_status();
    PeerResult result;
    result.time_ms = timed_ms([&] {
        Decimater decimater(work);
        OpenMesh::Decimater::ModHandleT<Quadric> quadric;
        decimater.add(quadric);
        decimater.module(quadric).unset_max_err();
        decimater.initialize();
        decimater.decimate_to_faces(0, faces);
    });
    work.garbage_collection();
    result.mesh = peer_mesh(work);
    return result;
}

} // namespace octant::tests::peers
