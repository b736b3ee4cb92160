#include "models/material.h"
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "sim/base/binary_file.h"

#include <glm/common.hpp>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>
#include <vector>

namespace octant::models::meshfile {

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int float_type = 5126;
constexpr int index_type = 5125;

/// A mesh whose vertices have one normal and one pair of texture coordinates each: the first keeps the vertex, others
/// get copies.
struct Split {
    std::vector<std::uint32_t> vertices; ///< of the mesh, for each one here
    std::vector<std::uint32_t> normals;  ///< likewise; empty without
    std::vector<std::uint32_t> textures; ///< likewise
    std::vector<Triangle> triangles;
};

Split split_by_corners(const TriangleMesh& mesh) {
    Split split;
    for (std::uint32_t v = 0; v < mesh.vertices_m.size(); ++v) { split.vertices.push_back(v); }
    split.triangles = mesh.triangles;
    const bool has_normals = !mesh.corner_normals.empty();
    const bool has_textures = !mesh.corner_texture_coordinates.empty();
    if (!has_normals && !has_textures) { return split; }
    split.normals.assign(has_normals ? mesh.vertices_m.size() : 0, invalid_index);
    split.textures.assign(has_textures ? mesh.vertices_m.size() : 0, invalid_index);
    std::vector<bool> is_taken(mesh.vertices_m.size(), false);
    using Key = std::tuple<std::uint32_t, float, float, float, float, float>;
    std::map<Key, std::uint32_t> known;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.triangles[t][k];
            const std::uint32_t normal = has_normals ? mesh.corner_normals[t][k] : invalid_index;
            const std::uint32_t texture = has_textures ? mesh.corner_texture_coordinates[t][k] : invalid_index;
            const glm::vec3 n = normal == invalid_index ? glm::vec3(0.0F) : mesh.normals[normal];
            const glm::vec2 place = texture == invalid_index ? glm::vec2(0.0F) : mesh.texture_coordinates[texture];
            const auto [at, is_new] = known.try_emplace({vertex, n.x, n.y, n.z, place.x, place.y}, vertex);
            if (is_new && is_taken[vertex]) {
                at->second = static_cast<std::uint32_t>(split.vertices.size());
                split.vertices.push_back(vertex);
                split.normals.resize(has_normals ? split.vertices.size() : 0);
                split.textures.resize(has_textures ? split.vertices.size() : 0);
            }
            if (is_new && has_normals) { split.normals[at->second] = normal; }
            if (is_new && has_textures) { split.textures[at->second] = texture; }
            is_taken[vertex] = true;
            split.triangles[t][k] = at->second;
        }
    }
    return split;
}

class GltfWriting {
public:
    explicit GltfWriting(const TriangleMesh& mesh)
        : mesh_(mesh), split_(split_by_corners(mesh)), origin_m_(gltf_origin_m(bounds_of(mesh))) {
        json_["asset"] = {{"version", "2.0"}};
        json_["scene"] = 0;
        json_["scenes"] = OrderedJson::array({{{"nodes", {0}}}});
        json_["nodes"] = OrderedJson::array({{{"mesh", 0}}});
        if (origin_m_ != glm::dvec3(0.0)) {
            json_["nodes"][0]["translation"] = {origin_m_.x, origin_m_.y, origin_m_.z};
        }
        add_vertices();
        if (mesh.materials.empty()) { add_primitive(invalid_index); }
        for (std::uint32_t material = 0; material < mesh.materials.size(); ++material) {
            add_primitive(material);
            add_material(mesh.materials[material]);
        }
        json_["meshes"] = OrderedJson::array({{{"primitives", primitives_}}});
        json_["buffers"] = OrderedJson::array({{{"byteLength", bytes_.size()}}});
    }

    OrderedJson& json() { return json_; }

    const std::string& bytes() const { return bytes_.bytes(); }

private:
    void add_material(const Material& material) {
        const glm::dvec3 c = linear_from_srgb(glm::dvec3(material.colour));
        json_["materials"].push_back(
            {{"name", material.name}, {"pbrMetallicRoughness", {{"baseColorFactor", {c.x, c.y, c.z, material.opacity}},
                                                                   {"metallicFactor", 0.0F}}}});
        if (material.opacity < 1.0F) { json_["materials"].back()["alphaMode"] = "BLEND"; }
        if (material.picture_bytes && is_gltf_picture(*material.picture_bytes)) {
            json_["materials"].back()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture_of(material)}};
        }
    }

    /// The number of the texture of a material's picture, written once.
    std::size_t texture_of(const Material& material) {
        const auto [at, is_new] = textures_.try_emplace(material.picture, textures_.size());
        if (is_new) {
            const std::string& picture = *material.picture_bytes;
            json_["bufferViews"].push_back(
                {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", picture.size()}});
            bytes_.put_bytes(picture);
            while (bytes_.size() % 4 != 0) { bytes_.put('\0'); }
            json_["images"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                {"mimeType", picture.starts_with("\x89PNG") ? "image/png" : "image/jpeg"}});
            json_["textures"].push_back({{"source", json_["images"].size() - 1}});
        }
        return at->second;
    }

    /// Gives the accessor's number; its numbers stand from `first` to the end of the bytes.
    std::size_t add_accessor(std::size_t first, std::size_t count, int component, const char* type) {
        json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", first}, {"byteLength", bytes_.size() - first}});
        json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1}, {"componentType", component},
            {"count", count}, {"type", type}});
        return json_["accessors"].size() - 1;
    }

    void add_vertices() {
        const std::size_t count = split_.vertices.size();
        glm::vec3 least(0.0F);
        glm::vec3 most(0.0F);
        for (std::size_t v = 0; v < count; ++v) {
            const glm::vec3 place_m(mesh_.vertices_m[split_.vertices[v]] - origin_m_);
            least = v == 0 ? place_m : glm::min(least, place_m);
            most = v == 0 ? place_m : glm::max(most, place_m);
            bytes_.put(place_m);
        }
        const std::size_t places = add_accessor(0, count, float_type, "VEC3");
        json_["accessors"][places]["min"] = {least.x, least.y, least.z};
        json_["accessors"][places]["max"] = {most.x, most.y, most.z};
        attributes_["POSITION"] = places;
        if (!mesh_.normals.empty()) {
            const std::size_t first = bytes_.size();
            for (const std::uint32_t normal : split_.normals) {
                bytes_.put(normal == invalid_index ? glm::vec3(0.0F, 0.0F, 1.0F) : mesh_.normals[normal]);
            }
            attributes_["NORMAL"] = add_accessor(first, count, float_type, "VEC3");
        }
        if (!split_.textures.empty()) {
            const std::size_t first = bytes_.size();
            for (const std::uint32_t texture : split_.textures) { // glTF counts v downwards
                const glm::vec2 place =
                    texture == invalid_index ? glm::vec2(0.0F, 1.0F) : mesh_.texture_coordinates[texture];
                bytes_.put(glm::vec2(place.x, 1.0F - place.y));
            }
            attributes_["TEXCOORD_0"] = add_accessor(first, count, float_type, "VEC2");
        }
        if (!mesh_.colours.empty()) {
            const std::size_t first = bytes_.size();
            for (const std::uint32_t vertex : split_.vertices) {
                bytes_.put(glm::vec3(linear_from_srgb(glm::dvec3(mesh_.colours[vertex]))));
            }
            attributes_["COLOR_0"] = add_accessor(first, count, float_type, "VEC3");
        }
    }

    void add_primitive(std::uint32_t material) {
        const std::size_t first = bytes_.size();
        for (std::size_t t = 0; t < split_.triangles.size(); ++t) {
            if (material == invalid_index || mesh_.triangle_materials[t] == material) {
                bytes_.put(split_.triangles[t]);
            }
        }
        if (bytes_.size() == first) {
            return; // glTF has no empty lists
        }
        OrderedJson primitive{{"attributes", attributes_}};
        primitive["indices"] = add_accessor(first, (bytes_.size() - first) / 4, index_type, "SCALAR");
        if (material != invalid_index) { primitive["material"] = material; }
        primitives_.push_back(primitive);
    }

    const TriangleMesh& mesh_;
    Split split_;
    glm::dvec3 origin_m_;
    std::map<std::string, std::size_t> textures_; ///< by their pictures
    BinaryWriter bytes_;
    OrderedJson json_;
    OrderedJson attributes_;
    OrderedJson primitives_ = OrderedJson::array();
};

std::string text_of(const OrderedJson& json) {
    return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

} // namespace

glm::dvec3 gltf_origin_m(const BoundingBox& bounds) {
    constexpr double far = 2.0; // times its own size
    const glm::dvec3 size_m = bounds.max_m - bounds.min_m;
    const glm::dvec3 middle_m = 0.5 * (bounds.min_m + bounds.max_m);
    const glm::dvec3 away_m = glm::abs(middle_m);
    const double largest_m = std::max({size_m.x, size_m.y, size_m.z});
    const bool is_far = std::max({away_m.x, away_m.y, away_m.z}) > far * largest_m;
    return is_far ? glm::dvec3(glm::vec3(middle_m)) : glm::dvec3(0.0);
}

bool is_gltf_picture(std::string_view bytes) {
    return bytes.starts_with("\x89PNG") || bytes.starts_with("\xff\xd8\xff");
}

std::string gltf_text(const TriangleMesh& mesh) {
    GltfWriting writing(mesh);
    writing.json()["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64_of(writing.bytes());
    return text_of(writing.json()) + "\n";
}

std::string glb_bytes(const TriangleMesh& mesh) {
    GltfWriting writing(mesh);
    std::string json = text_of(writing.json());
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string& data = writing.bytes(); // whole words throughout
    BinaryWriter out;
    out.put_bytes("glTF");
    out.put(std::uint32_t{2});
    out.put(static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data.size()));
    out.put(static_cast<std::uint32_t>(json.size()));
    out.put_bytes("JSON" + json);
    out.put(static_cast<std::uint32_t>(data.size()));
    out.put_bytes({"BIN\0", 4});
    out.put_bytes(data);
    return out.take();
}

} // namespace octant::models::meshfile
