#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

/// Other people's simplifiers, for comparisons. Nothing of the product knows of them.
namespace octant::tests::peers {

struct PeerMesh {
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct PeerResult {
    PeerMesh mesh;
    double time_ms = 0.0; ///< processor time of the simplification alone: no reading or writing
};

/// Reads v and f of an OBJ file; polygons become fans, vertices without triangles are dropped. Throws
/// std::runtime_error.
PeerMesh read_obj(const std::string& path);

void write_obj(const std::string& path, const PeerMesh& mesh);

/// Leaves out the vertices that no triangle uses.
PeerMesh without_unused_vertices(const PeerMesh& mesh);

// Each simplifies to at most `faces` triangles, or as far as it can.

PeerResult cgal_lindstrom_turk(const PeerMesh& mesh, std::size_t faces);
PeerResult cgal_garland_heckbert(const PeerMesh& mesh, std::size_t faces);
PeerResult meshoptimizer(const PeerMesh& mesh, std::size_t faces);
PeerResult openmesh_quadric(const PeerMesh& mesh, std::size_t faces);

/// Milliseconds of processor time that a call takes: none of the libraries uses threads here.
template <typename Work>
double timed_ms(const Work& work) {
    const std::clock_t start = std::clock();
    work();
    return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

} // namespace octant::tests::peers
