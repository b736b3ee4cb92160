#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/reader/library_readers.h"

#include <glm/mat3x3.hpp>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <fmt/format.h>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::reader {

namespace {

using models::invalid_index;
using models::meshfile::AffineTransform;
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

/// A number that a file states about itself; nothing where there is none.
std::optional<double> stated(const aiScene& scene, const char* key) {
    if (scene.mMetaData == nullptr) { return std::nullopt; }
    double real = 0.0;
    float single = 0.0F;
    int whole = 0;
    if (scene.mMetaData->Get(key, real)) { return real; }
    if (scene.mMetaData->Get(key, single)) { return static_cast<double>(single); }
    if (scene.mMetaData->Get(key, whole)) { return static_cast<double>(whole); }
    return std::nullopt;
}

/// From the unit and the upward axis that an FBX file states to metres with y up. Assimp applies those of Collada
/// files, and other formats state none.
AffineTransform placement_of(const aiScene& scene) {
    constexpr double m_per_cm = 0.01;
    constexpr double largest = 1e9;
    const double scale = m_per_cm * stated(scene, "UnitScaleFactor").value_or(1.0 / m_per_cm);
    AffineTransform placement;
    const double up = stated(scene, "UpAxis").value_or(1.0);
    if (up == 2.0) { placement.turn = glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0); }
    if (up == 0.0) { placement.turn = glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1); }
    if (stated(scene, "UpAxisSign").value_or(1.0) < 0.0) { // half round about x
        placement.turn = glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, -1) * placement.turn;
    }
    if (scale > 1.0 / largest && scale < largest) { placement.turn *= scale; }
    return placement;
}

void add_mesh(const aiMesh& from, const MaterialSurface& surface, const AffineTransform& placement, MeshBuilder& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
    const auto first_normal = static_cast<std::uint32_t>(mesh.normal_count());
    for (unsigned v = 0; v < from.mNumVertices; ++v) {
        const glm::dvec3 place_m = placement.turn * vector_of(from.mVertices[v]);
        if (!(std::abs(place_m.x) + std::abs(place_m.y) + std::abs(place_m.z) < models::meshfile::max_coordinate)) {
            throw Error("expected finite places, got others");
        }
        mesh.add_vertex(place_m);
        if (from.HasNormals()) { mesh.add_normal(placement.turn * vector_of(from.mNormals[v])); }
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
    const AffineTransform placement = placement_of(*scene);
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
        const aiMesh& from = *scene->mMeshes[i];
        add_mesh(from, from.mMaterialIndex < surfaces.size() ? surfaces[from.mMaterialIndex] : MaterialSurface(),
            placement, mesh);
    }
}

} // namespace octant::ui::reader
