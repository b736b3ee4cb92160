#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "peers.h"

namespace octant::tests::peers {

namespace {

/// The vertex that a corner of a face names: "7", "7/1", "7//2" or "-1", the last one so far.
std::uint32_t corner_vertex(const std::string& word, std::size_t vertices) {
    const long number = std::stol(word);
    const long index = number < 0 ? static_cast<long>(vertices) + number : number - 1;
    if (index < 0 || index >= static_cast<long>(vertices)) {
        throw std::runtime_error("a face names vertex " + word + ", which is not there");
    }
    return static_cast<std::uint32_t>(index);
}

} // namespace

PeerMesh without_unused_vertices(const PeerMesh& mesh) {
    constexpr std::uint32_t unused = ~std::uint32_t{0};
    PeerMesh used;
    std::vector<std::uint32_t> places(mesh.vertices.size(), unused);
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) { places[vertex] = 0; }
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i] != unused) {
            places[i] = static_cast<std::uint32_t>(used.vertices.size());
            used.vertices.push_back(mesh.vertices[i]);
        }
    }
    for (const auto& [a, b, c] : mesh.triangles) { used.triangles.push_back({places[a], places[b], places[c]}); }
    return used;
}

PeerMesh read_obj(const std::string& path) {
    std::ifstream file(path);
    if (!file) { throw std::runtime_error(path + ": cannot be read"); }
    PeerMesh mesh;
    std::string line;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            auto& [x, y, z] = mesh.vertices.emplace_back();
            words >> x >> y >> z;
        } else if (kind == "f") {
            std::vector<std::uint32_t> corners;
            for (std::string word; words >> word;) { corners.push_back(corner_vertex(word, mesh.vertices.size())); }
            for (std::size_t i = 2; i < corners.size(); ++i) {
                mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
            }
        }
    }
    if (mesh.triangles.empty()) { throw std::runtime_error(path + ": no faces"); }
    return without_unused_vertices(mesh);
}

void write_obj(const std::string& path, const PeerMesh& mesh) {
    std::FILE* file = std::fopen(path.c_str(), "w");
    if (file == nullptr) { throw std::runtime_error(path + ": cannot be written"); }
    for (const auto& [x, y, z] : mesh.vertices) { std::fprintf(file, "v %.17g %.17g %.17g\n", x, y, z); }
    for (const auto& [a, b, c] : mesh.triangles) { std::fprintf(file, "f %u %u %u\n", a + 1, b + 1, c + 1); }
    if (std::fclose(file) != 0) { throw std::runtime_error(path + ": cannot be written"); }
}

} // namespace octant::tests::peers
