#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
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
    double time_ms = 0.0; ///< of the simplification alone: no reading, copying or writing
};

/// Reads v and f of an OBJ file; polygons become fans, vertices without triangles are dropped.
/// Throws std::runtime_error.
PeerMesh read_obj(const std::string& path);

void write_obj(const std::string& path, const PeerMesh& mesh);

/// Leaves out the vertices that no triangle uses.
PeerMesh without_unused_vertices(const PeerMesh& mesh);

// Each simplifies to at most `faces` triangles, or as far as it can.

PeerResult cgal_lindstrom_turk(const PeerMesh& mesh, std::size_t faces);
PeerResult cgal_garland_heckbert(const PeerMesh& mesh, std::size_t faces);
PeerResult meshoptimizer(const PeerMesh& mesh, std::size_t faces);
PeerResult openmesh_quadric(const PeerMesh& mesh, std::size_t faces);

/// Milliseconds that a call takes.
template <typename Work>
double timed_ms(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    return took.count();
}

} // namespace octant::tests::peers
