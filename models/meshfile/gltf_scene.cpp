#include "models/meshfile/gltf_scene.h"

#include "models/meshfile/word_scanner.h"

#include <glm/geometric.hpp>

#include <fmt/format.h>
#include <utility>

namespace octant::models::meshfile {

namespace {

constexpr int max_gltf_node_depth = 200;

class SceneWalk {
public:
    explicit SceneWalk(const GltfData& data)
        : data_(data)
        , met_(data.count_of("nodes"), false) {}

    std::vector<PlacedMesh> walk() {
        for (const std::size_t root : roots()) {
            take_node(root, {}, 0);
        }
        for (std::size_t mesh = 0; met_.empty() && mesh < data_.count_of("meshes"); ++mesh) {
            placed_.push_back({mesh, {}});
        }
        return std::move(placed_);
    }

private:
    std::vector<std::size_t> roots() const {
        const std::size_t scenes = data_.count_of("scenes");
        const std::size_t scene = data_.index(data_.root(), "scene", scenes, "file").value_or(0);
        if (scenes > 0) {
            return node_list(
                data_.entry("scenes", scene), "nodes", fmt::format("scenes[{}]", scene));
        }
        std::vector<bool> is_child(met_.size(), false);
        for (std::size_t node = 0; node < met_.size(); ++node) {
            for (const std::size_t child : children(node)) {
                is_child[child] = true;
            }
        }
        std::vector<std::size_t> found;
        for (std::size_t node = 0; node < met_.size(); ++node) {
            if (!is_child[node]) {
                found.push_back(node);
            }
        }
        return found;
    }

    std::vector<std::size_t>
    node_list(const Json& object, const char* name, const std::string& where) const {
        std::vector<std::size_t> found;
        for (const Json& node : data_.list(object, name, where)) {
            if (!node.is_number_unsigned() || node.get<std::uint64_t>() >= met_.size()) {
                data_.refuse(
                    where + "." + name,
                    fmt::format("nodes below {}", met_.size()),
                    in_quotes(node.dump(-1, ' ', true, Json::error_handler_t::replace)));
            }
            found.push_back(node.get<std::size_t>());
        }
        return found;
    }

    std::vector<std::size_t> children(std::size_t node) const {
        return node_list(data_.entry("nodes", node), "children", fmt::format("nodes[{}]", node));
    }

    void take_node(std::size_t index, const AffineTransform& parent, int depth) {
        const std::string where = fmt::format("nodes[{}]", index);
        if (met_[index]) {
            data_.refuse(where, "a node with one parent", "one that is met again");
        }
        if (depth > max_gltf_node_depth) {
            data_.refuse(
                where, fmt::format("nodes at most {} deep", max_gltf_node_depth), "a deeper one");
        }
        met_[index] = true;
        const Json& node = data_.entry("nodes", index);
        const AffineTransform placement = parent.of(own(node, where));
        if (const auto mesh = data_.index(node, "mesh", data_.count_of("meshes"), where)) {
            placed_.push_back({*mesh, placement});
        }
        for (const std::size_t child : children(index)) {
            take_node(child, placement, depth + 1);
        }
    }

    AffineTransform own(const Json& node, const std::string& where) const {
        AffineTransform made;
        if (node.contains("matrix")) {
            const auto m = data_.numbers(node, "matrix", std::vector<double>(16), where);
            made.turn = {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]};
            made.shift_m = {m[12], m[13], m[14]};
            return made;
        }
        const auto shift = data_.numbers(node, "translation", {0.0, 0.0, 0.0}, where);
        const auto q = data_.numbers(node, "rotation", {0.0, 0.0, 0.0, 1.0}, where);
        const auto scale = data_.numbers(node, "scale", {1.0, 1.0, 1.0}, where);
        const glm::dvec3 v(q[0], q[1], q[2]);
        const double length2 = glm::dot(v, v) + q[3] * q[3];
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 image(0.0);
            image[axis] = 1.0;
            if (length2 > 0.0) {
                image += 2.0 / length2 * glm::cross(v, glm::cross(v, image) + q[3] * image);
            }
            made.turn[axis] = image * scale[static_cast<std::size_t>(axis)];
        }
        made.shift_m = {shift[0], shift[1], shift[2]};
        return made;
    }

    const GltfData& data_;
    std::vector<bool> met_; ///< nodes
    std::vector<PlacedMesh> placed_;
};

} // namespace

std::vector<PlacedMesh> placed_meshes(const GltfData& data) {
    return SceneWalk(data).walk();
}

} // namespace octant::models::meshfile
