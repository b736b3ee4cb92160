// Converts a mesh file that assimp reads to OBJ: octant-mesh-to-obj IN OUT.obj [--subdivide N] Vertices of equal
// position (and colour) become one, polygons become triangles.
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>
#include <stdexcept>

#include "peers.h"

using namespace octant::tests::peers;

namespace {

struct ColouredMesh {
    PeerMesh mesh;
    std::vector<std::array<float, 3>> colours; ///< empty, or by vertex
};

ColouredMesh read(const char* path) {
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_PP_PTV_NORMALIZE, false);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene* scene =
        importer.ReadFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_SortByPType);
    if (scene == nullptr) { throw std::runtime_error(importer.GetErrorString()); }
    ColouredMesh made;
    std::map<std::array<float, 6>, std::uint32_t> places;
    bool coloured = scene->mNumMeshes > 0;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) { coloured = coloured && scene->mMeshes[m]->HasVertexColors(0); }
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
        const aiMesh& part = *scene->mMeshes[m];
        std::vector<std::uint32_t> new_index;
        for (unsigned i = 0; i < part.mNumVertices; ++i) {
            const aiVector3D& p = part.mVertices[i];
            const aiColor4D colour = coloured ? part.mColors[0][i] : aiColor4D{};
            const auto [place, added] = places.emplace(std::array{p.x, p.y, p.z, colour.r, colour.g, colour.b},
                static_cast<std::uint32_t>(made.mesh.vertices.size()));
            if (added) {
                made.mesh.vertices.push_back({p.x, p.y, p.z});
                if (coloured) { made.colours.push_back({colour.r, colour.g, colour.b}); }
            }
            new_index.push_back(place->second);
        }
        for (unsigned i = 0; i < part.mNumFaces; ++i) {
            const aiFace& face = part.mFaces[i];
            if (face.mNumIndices == 3) {
                const auto at = [&](unsigned k) { return new_index[face.mIndices[k]]; };
                if (at(0) != at(1) && at(1) != at(2) && at(2) != at(0)) {
                    made.mesh.triangles.push_back({at(0), at(1), at(2)});
                }
            }
        }
    }
    return made;
}

using Vec = std::array<double, 3>;

/// Four triangles for each; new vertices lie on the curved surface that the vertex normals tell of.
PeerMesh subdivided(const PeerMesh& mesh) {
    std::vector<Vec> normals(mesh.vertices.size(), Vec{});
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            const double n = (q[i] - p[i]) * (r[j] - p[j]) - (q[j] - p[j]) * (r[i] - p[i]);
            for (const std::uint32_t vertex : {a, b, c}) { normals[vertex].at(k) += n; }
        }
    }
    for (Vec& n : normals) {
        const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (double& x : n) { x /= length > 0.0 ? length : 1.0; }
    }
    PeerMesh made{mesh.vertices, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, added] =
            middles.emplace(std::minmax({a, b}), static_cast<std::uint32_t>(made.vertices.size()));
        if (added) {
            Vec m{};
            double up_a = 0.0;
            double up_b = 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                m.at(k) = 0.5 * (mesh.vertices[a].at(k) + mesh.vertices[b].at(k));
                up_a += (m.at(k) - mesh.vertices[a].at(k)) * normals[a].at(k);
                up_b += (m.at(k) - mesh.vertices[b].at(k)) * normals[b].at(k);
            }
            for (std::size_t k = 0; k < 3; ++k) {
                m.at(k) -= 0.25 * (up_a * normals[a].at(k) + up_b * normals[b].at(k));
            }
            made.vertices.push_back(m);
        }
        return place->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        made.triangles.insert(made.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return made;
}

void write(const char* path, const ColouredMesh& coloured) {
    if (coloured.colours.empty()) {
        write_obj(path, coloured.mesh);
        return;
    }
    std::FILE* file = std::fopen(path, "w");
    if (file == nullptr) { throw std::runtime_error(std::string(path) + ": cannot be written"); }
    for (std::size_t i = 0; i < coloured.colours.size(); ++i) {
        const auto& [x, y, z] = coloured.mesh.vertices[i];
        const auto& [r, g, b] = coloured.colours[i];
        std::fprintf(file, "v %.9g %.9g %.9g %.6g %.6g %.6g\n", x, y, z, r, g, b);
    }
    for (const auto& [a, b, c] : coloured.mesh.triangles) { std::fprintf(file, "f %u %u %u\n", a + 1, b + 1, c + 1); }
    std::fclose(file);
}

} // namespace

int main(int argc, char** argv) {
    const bool subdivides = argc == 5 && std::strcmp(argv[3], "--subdivide") == 0;
    if (argc != 3 && !subdivides) {
        std::fputs("octant-mesh-to-obj IN OUT.obj [--subdivide N]\n", stderr);
        return 2;
    }
    try {
        ColouredMesh mesh = read(argv[1]);
        for (int i = subdivides ? std::stoi(argv[4]) : 0; i > 0; --i) { mesh = {subdivided(mesh.mesh), {}}; }
        write(argv[2], mesh);
        std::printf("%zu\n", mesh.mesh.triangles.size());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "octant-mesh-to-obj: %s: %s\n", argv[1], error.what());
        return 2;
    }
    return 0;
}
