#include "models/meshfile/picture_path.h"
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
using models::meshfile::CornerIndices;
using models::meshfile::MeshBuilder;
using models::meshfile::PolygonPicture;

struct MaterialSurface {
    std::uint32_t material = invalid_index;
    PolygonPicture picture;
    bool two_sided = false;
};

/// The name of a surface's picture; nothing where it has none.
std::optional<aiString> picture_name(const aiMaterial& from, aiTextureType kind) {
    aiString name;
    if (from.GetTexture(kind, 0, &name) != AI_SUCCESS) { return std::nullopt; }
    return name;
}

std::optional<aiString> picture_name(const aiMaterial& from) {
    const auto diffuse = picture_name(from, aiTextureType_DIFFUSE);
    return diffuse ? diffuse : picture_name(from, aiTextureType_BASE_COLOR);
}

models::TextureWrap wrap_of(const aiMaterial& from, const char* key, unsigned kind) {
    int mode = aiTextureMapMode_Wrap;
    from.Get(key, kind, 0, mode);
    return mode == aiTextureMapMode_Clamp    ? models::TextureWrap::Clamp
           : mode == aiTextureMapMode_Mirror ? models::TextureWrap::Mirror
                                             : models::TextureWrap::Repeat;
}

/// Loads a surface's embedded picture or picture file.
PolygonPicture picture_of(const aiScene& scene, const aiMaterial& from, MeshBuilder& mesh) {
    PolygonPicture made;
    const auto name = picture_name(from);
    if (!name || !mesh.uses_pictures()) { return made; }
    const auto kind = static_cast<unsigned>(
        picture_name(from, aiTextureType_DIFFUSE) ? aiTextureType_DIFFUSE : aiTextureType_BASE_COLOR);
    made.wrap_u = wrap_of(from, _AI_MATKEY_MAPPINGMODE_U_BASE, kind);
    made.wrap_v = wrap_of(from, _AI_MATKEY_MAPPINGMODE_V_BASE, kind);
    const aiTexture* inside = scene.GetEmbeddedTexture(name->C_Str());
    if (inside == nullptr) {
        made.picture = mesh.pictures().picture(name->C_Str());
    } else if (inside->mHeight == 0) { // else plain pixels: no format that an image reader knows
        made.picture = mesh.pictures().picture(
            name->C_Str(), std::string_view(reinterpret_cast<const char*>(inside->pcData), inside->mWidth));
    }
    return made;
}

/// Returns the path of a surface's picture file; empty if there is none or the picture is embedded.
std::string picture_file_of(
    const aiScene& scene, const aiMaterial& from, aiTextureType kind, const std::filesystem::path& mesh_file) {
    const auto name = kind == aiTextureType_DIFFUSE ? picture_name(from) : picture_name(from, kind);
    if (!name || scene.GetEmbeddedTexture(name->C_Str()) != nullptr) { return {}; }
    return models::meshfile::picture_file(std::filesystem::absolute(mesh_file), name->C_Str()).string();
}

std::vector<MaterialSurface> surfaces_of(const aiScene& scene, const std::filesystem::path& file, MeshBuilder& mesh) {
    std::vector<MaterialSurface> surfaces;
    for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
        const aiMaterial& from = *scene.mMaterials[i];
        aiString name;
        from.Get(AI_MATKEY_NAME, name);
        models::Material material{.name = name.C_Str(),
            .picture = picture_file_of(scene, from, aiTextureType_DIFFUSE, file),
            .emissive_picture = picture_file_of(scene, from, aiTextureType_EMISSIVE, file)};
        aiColor3D colour;
        if (from.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == AI_SUCCESS) {
            const auto part = [](float value) {
                return std::isfinite(value) ? std::min(std::max(value, 0.0F), 1.0F) : 0.0F;
            };
            material.colour = glm::vec3(part(colour.r), part(colour.g), part(colour.b));
        }
        float opacity = 1.0F; // some programs write 0 for what is opaque
        if (from.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS && opacity >= models::seen_from_opacity &&
            opacity < 1.0F) {
            material.opacity = opacity;
        }
        MaterialSurface surface;
        surface.picture = picture_of(scene, from, mesh);
        if (surface.picture.picture != PolygonPicture::none && material.colour == glm::vec3(0.0F)) {
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
        mesh.add_polygon(corners, surface.material, from.HasTextureCoords(0) ? surface.picture : PolygonPicture());
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
