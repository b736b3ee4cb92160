#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "peers.h"

namespace octant::tests::peers {

namespace {

namespace simplification = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Ends once so many faces are left; CGAL 5.5 brings a stop by edges only.
struct FaceCountStop {
    std::size_t faces;

    template <typename Cost, typename Profile>
    bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
        return profile.surface_mesh().number_of_faces() <= faces;
    }
};

/// Non-manifold edges and vertices are split, triangles of the same corners become one.
Mesh cgal_mesh(const PeerMesh& mesh) {
    namespace processing = CGAL::Polygon_mesh_processing;
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> polygons;
    for (const auto& [x, y, z] : mesh.vertices) { points.emplace_back(x, y, z); }
    for (const auto& [a, b, c] : mesh.triangles) { polygons.push_back({a, b, c}); }
    processing::merge_duplicate_polygons_in_polygon_soup(points, polygons);
    processing::orient_polygon_soup(points, polygons);
    Mesh made;
    processing::polygon_soup_to_polygon_mesh(points, polygons, made);
    return made;
}

PeerMesh peer_mesh(const Mesh& mesh) {
    PeerMesh made;
    for (const Mesh::Vertex_index vertex : mesh.vertices()) {
        const Kernel::Point_3& point = mesh.point(vertex);
        made.vertices.push_back({point.x(), point.y(), point.z()});
    }
    for (const Mesh::Face_index face : mesh.faces()) {
        std::array<std::uint32_t, 3> triangle{};
        std::size_t corner = 0;
        for (const Mesh::Vertex_index vertex : mesh.vertices_around_face(mesh.halfedge(face))) {
            triangle.at(corner++) = vertex;
        }
        made.triangles.push_back(triangle);
    }
    return without_unused_vertices(made);
}

} // namespace

PeerResult cgal_lindstrom_turk(const PeerMesh& mesh, std::size_t faces) {
    Mesh work = cgal_mesh(mesh);
    PeerResult result;
    result.time_ms = timed_ms([&] {
        simplification::edge_collapse(work, FaceCountStop{faces},
            CGAL::parameters::get_cost(simplification::LindstromTurk_cost<Mesh>())
                .get_placement(simplification::LindstromTurk_placement<Mesh>()));
    });
    work.collect_garbage();
    result.mesh = peer_mesh(work);
    return result;
}

PeerResult cgal_garland_heckbert(const PeerMesh& mesh, std::size_t faces) {
    Mesh work = cgal_mesh(mesh);
    using Policies = simplification::GarlandHeckbert_plane_policies<Mesh, Kernel>;
    using Placement = simplification::Bounded_normal_change_placement<Policies::Get_placement>;
    PeerResult result;
    result.time_ms = timed_ms([&] {
        const Policies policies(work);
        const Placement placement(policies.get_placement());
        simplification::edge_collapse(
            work, FaceCountStop{faces}, CGAL::parameters::get_cost(policies.get_cost()).get_placement(placement));
    });
    work.collect_garbage();
    result.mesh = peer_mesh(work);
    return result;
}

} // namespace octant::tests::peers
