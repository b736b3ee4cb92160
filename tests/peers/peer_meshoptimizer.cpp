#include <meshoptimizer.h>

#include "peers.h"

namespace octant::tests::peers {

PeerResult meshoptimizer(const PeerMesh& mesh, std::size_t faces) {
    std::vector<float> positions;
    std::vector<unsigned int> indices;
    for (const auto& vertex : mesh.vertices) {
        for (const double coordinate : vertex) { positions.push_back(static_cast<float>(coordinate)); }
    }
    for (const auto& triangle : mesh.triangles) { indices.insert(indices.end(), triangle.begin(), triangle.end()); }
    std::vector<unsigned int> left(indices.size());
    PeerResult result;
    result.time_ms = timed_ms([&] {
        constexpr float any_error = 1.0F;
        left.resize(meshopt_simplify(left.data(), indices.data(), indices.size(), positions.data(),
            mesh.vertices.size(), 3 * sizeof(float), faces * 3, any_error, 0, nullptr));
    });
    result.mesh.vertices = mesh.vertices;
    for (std::size_t i = 0; i < left.size(); i += 3) {
        result.mesh.triangles.push_back({left[i], left[i + 1], left[i + 2]});
    }
    result.mesh = without_unused_vertices(result.mesh);
    return result;
}

} // namespace octant::tests::peers
