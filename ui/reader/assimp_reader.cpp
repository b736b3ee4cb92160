#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/reader/library_readers.h"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <fmt/format.h>
#include <new>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::reader {

namespace {

using models::invalid_index;
using models::meshfile::BakedPictures;
using models::meshfile::CornerIndices;
using models::meshfile::MeshBuilder;

struct MaterialSurface {
    std::uint32_t material = invalid_index;
    std::uint32_t picture = BakedPictures::none;
    bool two_sided = false;
};

/// Loads a surface's embedded picture or picture file.
std::uint32_t picture_of(const aiScene& scene, const aiMaterial& from, MeshBuilder& mesh) {
    aiString name;
    if (from.GetTexture(aiTextureType_DIFFUSE, 0, &name) != AI_SUCCESS &&
        from.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != AI_SUCCESS) {
        return BakedPictures::none;
    }
    const aiTexture* inside = scene.GetEmbeddedTexture(name.C_Str());
    if (inside == nullptr) { return mesh.pictures().picture(name.C_Str()); }
    if (inside->mHeight != 0) { // plain pixels: no format that an image reader knows
        return BakedPictures::none;
    }
    return mesh.pictures().picture(
        name.C_Str(), std::string_view(reinterpret_cast<const char*>(inside->pcData), inside->mWidth));
}

/// Returns the path of a surface's picture file; empty if there is none or the picture is embedded.
std::string picture_file_of(const aiScene& scene, const aiMaterial& from, const std::filesystem::path& mesh_file) {
    aiString name;
    if ((from.GetTexture(aiTextureType_DIFFUSE, 0, &name) != AI_SUCCESS &&
            from.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != AI_SUCCESS) ||
        scene.GetEmbeddedTexture(name.C_Str()) != nullptr) {
        return {};
    }
    return (std::filesystem::absolute(mesh_file).parent_path() / name.C_Str()).string();
}

std::vector<MaterialSurface> surfaces_of(const aiScene& scene, const std::filesystem::path& file, MeshBuilder& mesh) {
    std::vector<MaterialSurface> surfaces;
    for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
        const aiMaterial& from = *scene.mMaterials[i];
        aiString name;
        from.Get(AI_MATKEY_NAME, name);
        models::Material material{.name = name.C_Str(), .picture = picture_file_of(scene, from, file)};
        aiColor3D colour;
        if (from.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == AI_SUCCESS) {
            const auto part = [](float value) {
                return std::isfinite(value) ? std::min(std::max(value, 0.0F), 1.0F) : 0.0F;
            };
            material.colour = glm::vec3(part(colour.r), part(colour.g), part(colour.b));
        }
        MaterialSurface surface;
        surface.picture = picture_of(scene, from, mesh);
        if (surface.picture != BakedPictures::none && material.colour == glm::vec3(0.0F)) {
            material.colour = glm::vec3(1.0F);
        }
        int two_sided = 0;
        surface.two_sided = from.Get(AI_MATKEY_TWOSIDED, two_sided) == AI_SUCCESS && two_sided != 0;
        surface.material = mesh.add_material(std::move(material));
        surfaces.push_back(surface);
    }
    return surfaces;
}

glm::dvec3 vector_of(const aiVector3D& from) { return {from.x, from.y, from.z}; }

void add_mesh(const aiMesh& from, const MaterialSurface& surface, MeshBuilder& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
    const auto first_normal = static_cast<std::uint32_t>(mesh.normal_count());
    for (unsigned v = 0; v < from.mNumVertices; ++v) {
        const glm::dvec3 place_m = vector_of(from.mVertices[v]);
        if (!(std::abs(place_m.x) + std::abs(place_m.y) + std::abs(place_m.z) < models::meshfile::max_coordinate)) {
            throw Error("expected finite places, got others");
        }
        mesh.add_vertex(place_m);
        if (from.HasNormals()) { mesh.add_normal(vector_of(from.mNormals[v])); }
    }
    mesh.set_two_sided(surface.two_sided);
    std::vector<CornerIndices> corners;
    for (unsigned f = 0; f < from.mNumFaces; ++f) {
        const aiFace& face = from.mFaces[f];
        if (face.mNumIndices < 3 || face.mNumIndices > models::meshfile::max_polygon_corners) { continue; }
        corners.clear();
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            const unsigned v = face.mIndices[k];
            CornerIndices corner{.vertex = first + v};
            corner.normal = from.HasNormals() ? first_normal + v : invalid_index;
            if (from.HasTextureCoords(0)) {
                const aiVector3D& place = from.mTextureCoords[0][v];
                corner.texture = mesh.add_texture_coordinates({place.x, place.y});
            }
            corners.push_back(corner);
        }
        mesh.add_polygon(corners, surface.material, from.HasTextureCoords(0) ? surface.picture : BakedPictures::none);
    }
}

} // namespace

void read_by_assimp(const std::filesystem::path& file, MeshBuilder& mesh) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(
        file.string(), aiProcess_PreTransformVertices | aiProcess_SortByPType | aiProcess_ValidateDataStructure);
    if (scene == nullptr) {
        if (std::string_view(importer.GetErrorString()) == std::bad_alloc().what()) { throw std::bad_alloc(); }
        throw_error_in(file, fmt::format("expected a mesh that Assimp can read, got '{}'", importer.GetErrorString()));
    }
    const std::vector<MaterialSurface> surfaces = surfaces_of(*scene, file, mesh);
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
        const aiMesh& from = *scene->mMeshes[i];
        add_mesh(from, from.mMaterialIndex < surfaces.size() ? surfaces[from.mMaterialIndex] : MaterialSurface(), mesh);
    }
}

} // namespace octant::ui::reader
