#include "models/display_colour.h"
#include "models/meshfile/base64.h"
#include "models/meshfile/byte_writer.h"
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"

#include <glm/common.hpp>

#include <map>
#include <nlohmann/json.hpp>
#include <tuple>
#include <vector>

namespace octant::models::meshfile {

namespace {

using Json = nlohmann::ordered_json;

constexpr int float_type = 5126;
constexpr int index_type = 5125;

/// A mesh whose vertices have one normal each: the first keeps the vertex, others get copies.
struct Split {
    std::vector<std::uint32_t> vertices; ///< of the mesh, for each one here
    std::vector<std::uint32_t> normals;  ///< likewise; empty without
    std::vector<Triangle> triangles;
};

Split split_by_normals(const TriangleMesh& mesh) {
    Split split;
    for (std::uint32_t v = 0; v < mesh.vertices_m.size(); ++v) {
        split.vertices.push_back(v);
    }
    split.triangles = mesh.triangles;
    if (mesh.normals.empty()) {
        return split;
    }
    split.normals.assign(mesh.vertices_m.size(), no_index);
    std::map<std::tuple<std::uint32_t, float, float, float>, std::uint32_t> known;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.triangles[t][k];
            const std::uint32_t normal = mesh.corner_normals[t][k];
            const glm::vec3& n = mesh.normals[normal];
            const auto [at, is_new] = known.try_emplace({vertex, n.x, n.y, n.z}, vertex);
            if (is_new && split.normals[vertex] == no_index) {
                split.normals[vertex] = normal;
            } else if (is_new) {
                at->second = static_cast<std::uint32_t>(split.vertices.size());
                split.vertices.push_back(vertex);
                split.normals.push_back(normal);
            }
            split.triangles[t][k] = at->second;
        }
    }
    return split;
}

class GltfWriting {
public:
    explicit GltfWriting(const TriangleMesh& mesh)
        : mesh_(mesh)
        , split_(split_by_normals(mesh)) {
        json_["asset"] = {{"version", "2.0"}};
        json_["scene"] = 0;
        json_["scenes"] = Json::array({{{"nodes", {0}}}});
        json_["nodes"] = Json::array({{{"mesh", 0}}});
        add_vertices();
        if (mesh.materials.empty()) {
            add_primitive(no_index);
        }
        for (std::uint32_t material = 0; material < mesh.materials.size(); ++material) {
            add_primitive(material);
            const glm::dvec3 c = linear_from_display(glm::dvec3(mesh.materials[material].colour));
            json_["materials"].push_back(
                {{"name", mesh.materials[material].name},
                 {"pbrMetallicRoughness",
                  {{"baseColorFactor", {c.x, c.y, c.z, 1.0}}, {"metallicFactor", 0.0F}}}});
        }
        json_["meshes"] = Json::array({{{"primitives", primitives_}}});
        json_["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    }

    Json& json() { return json_; }

    const std::string& bytes() const { return bytes_; }

private:
    /// Gives the accessor's number; its numbers stand from `first` to the end of the bytes.
    std::size_t
    add_accessor(std::size_t first, std::size_t count, int component, const char* type) {
        json_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", first}, {"byteLength", bytes_.size() - first}});
        json_["accessors"].push_back(
            {{"bufferView", json_["bufferViews"].size() - 1},
             {"componentType", component},
             {"count", count},
             {"type", type}});
        return json_["accessors"].size() - 1;
    }

    void append_vector(const glm::vec3& vector) {
        append_number(bytes_, vector.x);
        append_number(bytes_, vector.y);
        append_number(bytes_, vector.z);
    }

    void add_vertices() {
        const std::size_t count = split_.vertices.size();
        glm::vec3 least(0.0F);
        glm::vec3 most(0.0F);
        for (std::size_t v = 0; v < count; ++v) {
            const glm::vec3 place_m(mesh_.vertices_m[split_.vertices[v]]);
            least = v == 0 ? place_m : glm::min(least, place_m);
            most = v == 0 ? place_m : glm::max(most, place_m);
            append_vector(place_m);
        }
        const std::size_t places = add_accessor(0, count, float_type, "VEC3");
        json_["accessors"][places]["min"] = {least.x, least.y, least.z};
        json_["accessors"][places]["max"] = {most.x, most.y, most.z};
        attributes_["POSITION"] = places;
        if (!mesh_.normals.empty()) {
            const std::size_t first = bytes_.size();
            for (const std::uint32_t normal : split_.normals) {
                append_vector(
                    normal == no_index ? glm::vec3(0.0F, 0.0F, 1.0F) : mesh_.normals[normal]);
            }
            attributes_["NORMAL"] = add_accessor(first, count, float_type, "VEC3");
        }
        if (!mesh_.colours.empty()) {
            const std::size_t first = bytes_.size();
            for (const std::uint32_t vertex : split_.vertices) {
                append_vector(glm::vec3(linear_from_display(glm::dvec3(mesh_.colours[vertex]))));
            }
            attributes_["COLOR_0"] = add_accessor(first, count, float_type, "VEC3");
        }
    }

    void add_primitive(std::uint32_t material) {
        const std::size_t first = bytes_.size();
        for (std::size_t t = 0; t < split_.triangles.size(); ++t) {
            if (material == no_index || mesh_.triangle_materials[t] == material) {
                for (const std::uint32_t vertex : split_.triangles[t]) {
                    append_number(bytes_, vertex);
                }
            }
        }
        if (bytes_.size() == first) {
            return; // glTF has no empty lists
        }
        Json primitive{{"attributes", attributes_}};
        primitive["indices"] =
            add_accessor(first, (bytes_.size() - first) / 4, index_type, "SCALAR");
        if (material != no_index) {
            primitive["material"] = material;
        }
        primitives_.push_back(primitive);
    }

    const TriangleMesh& mesh_;
    Split split_;
    std::string bytes_;
    Json json_;
    Json attributes_;
    Json primitives_ = Json::array();
};

std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::string gltf_text(const TriangleMesh& mesh) {
    GltfWriting writing(mesh);
    writing.json()["buffers"][0]["uri"] =
        "data:application/octet-stream;base64," + base64_text(writing.bytes());
    return text_of(writing.json()) + "\n";
}

std::string glb_bytes(const TriangleMesh& mesh) {
    GltfWriting writing(mesh);
    std::string json = text_of(writing.json());
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string& data = writing.bytes(); // whole words throughout
    std::string bytes = "glTF";
    append_number(bytes, std::uint32_t{2});
    append_number(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data.size()));
    append_number(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    append_number(bytes, static_cast<std::uint32_t>(data.size()));
    bytes += std::string("BIN\0", 4) + data;
    return bytes;
}

} // namespace octant::models::meshfile
