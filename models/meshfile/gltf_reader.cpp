#include "models/material.h"
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/mesh_join.h"
#include "models/meshfile/meshopt_decoder.h"
#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

using Json = nlohmann::json;

constexpr std::size_t largest_gltf_bytes = std::size_t{1} << 28U;
constexpr std::size_t largest_buffers_bytes = std::size_t{1} << 30U;
constexpr int max_json_depth = 64;
constexpr std::uint32_t glb_magic = 0x46546c67;
constexpr std::uint32_t json_chunk = 0x4e4f534a;
constexpr std::uint32_t binary_chunk = 0x004e4942;

std::size_t bytes_of(int component) { return component <= 5121 ? 1 : (component <= 5123 ? 2 : 4); }

std::string shown(const Json& value) { return in_quotes(value.dump(-1, ' ', true, Json::error_handler_t::replace)); }

/// A relative path that does not leave its folder.
bool stays_inside(const std::filesystem::path& path) {
    return !path.empty() && path.is_relative() && path.string().find('\\') == std::string::npos &&
           path.string().find(':') == std::string::npos &&
           std::ranges::find(path, std::filesystem::path("..")) == path.end();
}

/// The numbers of a glTF accessor. Keeps a view of the file.
class GltfAccessor {
public:
    GltfAccessor() = default;

    std::size_t count() const { return count_; }

    int parts() const { return parts_; }

    int component() const { return component_; }

    /// Component `part` of entry `entry`; normalized integers as 0..1.
    double at(std::size_t entry, int part) const {
        const std::size_t byte = entry * stride_ + static_cast<std::size_t>(part) * bytes_of(component_);
        const char* const from = bytes_.data() + byte;
        switch (component_) {
        case 5120:
            return is_normalized_ ? std::max(value_at<std::int8_t>(from) / 127.0, -1.0) : value_at<std::int8_t>(from);
        case 5121:
            return value_at<std::uint8_t>(from) / (is_normalized_ ? 255.0 : 1.0);
        case 5122:
            return is_normalized_ ? std::max(value_at<std::int16_t>(from) / 32767.0, -1.0)
                                  : value_at<std::int16_t>(from);
        case 5123:
            return value_at<std::uint16_t>(from) / (is_normalized_ ? 65535.0 : 1.0);
        case 5125:
            return value_at<std::uint32_t>(from);
        default:
            return static_cast<double>(value_at<float>(from));
        }
    }

    /// An entry as an integer.
    std::uint32_t unsigned_at(std::size_t entry) const { return static_cast<std::uint32_t>(at(entry, 0)); }

private:
    friend class GltfData;

    std::string_view bytes_; ///< from the first entry on
    std::size_t stride_ = 0;
    std::size_t count_ = 0;
    int parts_ = 1;
    int component_ = 5126; ///< glTF's component type
    bool is_normalized_ = false;
};

/// The JSON and the buffers of a .gltf or .glb file. Every access is checked; faults throw Error "file:
/// meshes[0].primitives: expected ..., got ...".
class GltfData {
public:
    explicit GltfData(const std::filesystem::path& path) : path_(path), file_(read_file(path, largest_gltf_bytes)) {
        if (file_.starts_with("glTF")) {
            read_binary(file_);
        } else {
            read_json(file_, 0);
        }
        if (!root_.is_object()) { throw_error_in(path_, "expected a JSON object, got " + shown(root_)); }
        const Json& asset = root_.contains("asset") ? root_["asset"] : root_;
        const Json version = asset.is_object() ? asset.value("version", Json()) : Json();
        if (!version.is_string() || !version.get_ref<const std::string&>().starts_with("2.")) {
            refuse("asset.version", "2.0", version.is_null() ? "none" : shown(version));
        }
        buffers_.resize(count_of("buffers"));
    }

    const Json& root() const { return root_; }

    [[noreturn]] void refuse(const std::string& where, const std::string& expected, const std::string& got) const {
        throw_error_in(path_, fmt::format("{}: expected {}, got {}", where, expected, got));
    }

    /// Entry `index` of a top-level list; it must be an object.
    const Json& entry(const char* name, std::size_t index) const {
        const Json& found = list(root_, name, "")[index];
        if (!found.is_object()) { refuse(fmt::format("{}[{}]", name, index), "an object", shown(found)); }
        return found;
    }

    std::size_t count_of(const char* name) const { return list(root_, name, "").size(); }

    /// A member that must be an integer below `limit`; nothing if it is missing.
    std::optional<std::size_t> index(
        const Json& object, const char* name, std::size_t limit, const std::string& where) const {
        const auto found = object.find(name);
        if (found == object.end()) { return std::nullopt; }
        if (!found->is_number_unsigned() || found->get<std::uint64_t>() >= limit) {
            refuse(where + "." + name, fmt::format("a whole number below {}", limit), shown(*found));
        }
        return found->get<std::size_t>();
    }

    /// The list of this name; empty if it is missing.
    const Json& list(const Json& object, const char* name, const std::string& where) const {
        static const Json none = Json::array();
        const auto found = object.find(name);
        if (found == object.end()) { return none; }
        if (!found->is_array()) { refuse(where.empty() ? name : where + "." + name, "a list", shown(*found)); }
        return *found;
    }

    /// A list of numbers with the size of `otherwise`, which is the default.
    std::vector<double> numbers(
        const Json& object, const char* name, std::vector<double> otherwise, const std::string& where) const {
        const Json& found = list(object, name, where);
        if (object.find(name) == object.end()) { return otherwise; }
        if (found.size() != otherwise.size() ||
            !std::ranges::all_of(found, [](const Json& value) { return value.is_number(); })) {
            refuse(where + "." + name, fmt::format("{} numbers", otherwise.size()), shown(found));
        }
        return found.get<std::vector<double>>();
    }

    /// The accessor with this index, completely inside its buffer.
    GltfAccessor accessor(std::size_t index) {
        const std::string where = fmt::format("accessors[{}]", index);
        const Json& json = entry("accessors", index);
        if (json.contains("sparse")) { refuse(where, "an accessor that is not sparse", "a sparse one"); }
        constexpr std::size_t any = std::size_t{1} << 40U;
        GltfAccessor made;
        const auto component = this->index(json, "componentType", 5127, where).value_or(0);
        if (component < 5120 || component == 5124) {
            refuse(where, "a componentType of 5120 to 5126", std::to_string(component));
        }
        made.component_ = static_cast<int>(component);
        const Json type = json.value("type", Json());
        const std::string kind = type.is_string() ? type.get<std::string>() : "";
        made.parts_ = kind == "SCALAR" ? 1 : kind == "VEC2" ? 2 : kind == "VEC3" ? 3 : 4;
        if (made.parts_ == 4 && kind != "VEC4") { refuse(where + ".type", "SCALAR, VEC2, VEC3 or VEC4", shown(type)); }
        made.is_normalized_ = json.contains("normalized") && json["normalized"] == Json(true);
        made.count_ = this->index(json, "count", any, where).value_or(0);
        const auto view_index = this->index(json, "bufferView", count_of("bufferViews"), where);
        if (!view_index) { refuse(where, "a bufferView", "none"); }
        const std::string_view bytes = view(*view_index, made.stride_);
        const std::size_t entry_bytes = bytes_of(made.component_) * static_cast<std::size_t>(made.parts_);
        made.stride_ = made.stride_ == 0 ? entry_bytes : made.stride_;
        const std::size_t first = this->index(json, "byteOffset", any, where).value_or(0);
        if (made.stride_ < entry_bytes || made.count_ == 0 || first > bytes.size() ||
            made.count_ > (bytes.size() - first + made.stride_ - entry_bytes) / made.stride_) {
            refuse(where, fmt::format("1 or more entries that fit the {} bytes of the view", bytes.size()),
                fmt::format("{} from byte {}, {} apart", made.count_, first, made.stride_));
        }
        made.bytes_ = bytes.substr(first);
        return made;
    }

    /// The encoded bytes of an image, from a buffer view or a URI.
    std::string image_bytes(std::size_t index) {
        const std::string where = fmt::format("images[{}]", index);
        const Json& json = entry("images", index);
        if (const auto view_index = this->index(json, "bufferView", count_of("bufferViews"), where)) {
            std::size_t stride = 0;
            return std::string(view(*view_index, stride));
        }
        return buffer_bytes(json, where);
    }

private:
    void read_json(std::string_view text, std::size_t first_byte) {
        const auto shallow = [&](int depth, Json::parse_event_t /*event*/, Json& /*parsed*/) {
            if (depth > max_json_depth) {
                throw_error_in(path_, fmt::format("expected JSON at most {} deep, got more", max_json_depth));
            }
            return true;
        };
        try {
            root_ = Json::parse(text, shallow);
        } catch (const Json::parse_error& fault) {
            const std::size_t byte = std::min(std::max<std::size_t>(fault.byte, 1) - 1, text.size());
            const std::string_view got = text.substr(byte, 20);
            const std::string what = "expected JSON, got " + (got.empty() ? "the end of the text" : in_quotes(got));
            if (first_byte > 0) { throw_error_in(path_, fmt::format("at byte {}: {}", first_byte + byte, what)); }
            throw_error_at(path_, static_cast<int>(std::ranges::count(text.substr(0, byte), '\n')) + 1, what);
        } catch (const Json::exception&) { // a number that no type holds
            throw_error_in(path_, "expected JSON, got a value out of range");
        }
    }

    /// Header, a JSON chunk and perhaps a binary one; further chunks say nothing about meshes.
    void read_binary(std::string_view bytes) {
        BinaryReader reader(bytes, path_);
        static_assert(glb_magic != json_chunk);
        reader.take_bytes(4, "a magic number");
        const auto version = reader.take<std::uint32_t>("a version");
        if (version != 2) { reader.refuse_at(4, "version 2", std::to_string(version)); }
        const auto length = reader.take<std::uint32_t>("a length");
        if (length != bytes.size()) {
            reader.refuse_at(8, fmt::format("a length of {}", bytes.size()), std::to_string(length));
        }
        for (int chunk = 0; chunk == 0 || reader.bytes_left() > 0; ++chunk) {
            const auto chunk_bytes = reader.take<std::uint32_t>("a chunk's length");
            const auto kind = reader.take<std::uint32_t>("a chunk's kind");
            const std::size_t at = reader.at();
            const std::string_view content = reader.take_bytes(chunk_bytes, "a chunk");
            if (chunk == 0 && kind != json_chunk) {
                reader.refuse_at(at - 4, "a JSON chunk first", fmt::format("kind {:#x}", kind));
            }
            if (chunk == 0) {
                read_json(content, at);
            } else if (kind == binary_chunk && !binary_) {
                binary_ = content;
            }
        }
    }

    std::string_view buffer(std::size_t index) {
        const std::string where = fmt::format("buffers[{}]", index);
        const Json& json = entry("buffers", index);
        if (!json.contains("uri") && index == 0 && binary_) { return *binary_; }
        std::optional<std::string>& bytes = buffers_[index];
        if (!bytes) {
            bytes = buffer_bytes(json, where);
            loaded_bytes_ += bytes->size();
            if (loaded_bytes_ > largest_buffers_bytes) {
                refuse(where, fmt::format("buffers of at most {} bytes", largest_buffers_bytes), "more");
            }
        }
        return *bytes;
    }

    std::string buffer_bytes(const Json& buffer, const std::string& where) const {
        const auto uri = buffer.find("uri");
        if (uri == buffer.end() || !uri->is_string()) {
            refuse(where + ".uri", "an address", uri == buffer.end() ? "none" : shown(*uri));
        }
        const std::string_view text = uri->get_ref<const std::string&>();
        if (text.starts_with("data:")) {
            const std::size_t comma = text.find(";base64,");
            const auto bytes = comma == text.npos ? std::nullopt : from_base64(text.substr(comma + 8));
            if (!bytes) { refuse(where + ".uri", "base64 data", in_quotes(text)); }
            return *bytes;
        }
        const auto name = without_percents(text);
        if (!name || !stays_inside(*name)) {
            refuse(where + ".uri", "a file in the folder of this one", in_quotes(text));
        }
        const std::filesystem::path file = path_.parent_path() / *name;
        if (std::error_code ignored; !std::filesystem::exists(file, ignored)) {
            refuse(where + ".uri", "a file that lies beside this one", in_quotes(text));
        }
        return read_file(file, largest_gltf_bytes);
    }

    std::string_view view(std::size_t index, std::size_t& stride) {
        const Json& json = entry("bufferViews", index);
        if (const Json* packed = packed_view(json)) { return unpacked_view(index, *packed, stride); }
        return bytes_in_buffer(json, fmt::format("bufferViews[{}]", index), stride);
    }

    std::string_view bytes_in_buffer(const Json& json, const std::string& where, std::size_t& stride) {
        const auto buffer_index = this->index(json, "buffer", buffers_.size(), where);
        if (!buffer_index) { refuse(where, "a buffer", "none"); }
        const std::string_view bytes = buffer(*buffer_index);
        const std::size_t first = this->index(json, "byteOffset", bytes.size() + 1, where).value_or(0);
        const auto length = this->index(json, "byteLength", bytes.size() - first + 1, where);
        if (!length) { refuse(where, "a byteLength", "none"); }
        stride = this->index(json, "byteStride", 257, where).value_or(0);
        return bytes.substr(first, *length);
    }

    /// A view as EXT_meshopt_compression packs it; null where it does not.
    const Json* packed_view(const Json& view) const {
        const auto extensions = view.find("extensions");
        if (extensions == view.end() || !extensions->is_object()) { return nullptr; }
        for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
            const auto found = extensions->find(name);
            if (found != extensions->end() && found->is_object()) { return &*found; }
        }
        return nullptr;
    }

    std::string_view unpacked_view(std::size_t index, const Json& packed, std::size_t& stride) {
        const std::string where = fmt::format("bufferViews[{}]", index);
        std::size_t ignored = 0;
        const std::string_view bytes = bytes_in_buffer(packed, where, ignored);
        constexpr std::size_t any = std::size_t{1} << 32U;
        MeshoptView view;
        view.count = this->index(packed, "count", any, where).value_or(0);
        view.stride = this->index(packed, "byteStride", 257, where).value_or(0);
        const Json mode = packed.value("mode", Json());
        const Json filter = packed.value("filter", Json("NONE"));
        if (mode != "ATTRIBUTES" && mode != "TRIANGLES" && mode != "INDICES") {
            refuse(where + ".mode", "ATTRIBUTES, TRIANGLES or INDICES", shown(mode));
        }
        if (filter != "NONE" && filter != "OCTAHEDRAL" && filter != "EXPONENTIAL") {
            refuse(where + ".filter", "NONE, OCTAHEDRAL or EXPONENTIAL", shown(filter));
        }
        using enum MeshoptView::Mode;
        view.mode = mode == "ATTRIBUTES" ? Attributes : mode == "TRIANGLES" ? Triangles : Indices;
        view.filter = filter == "NONE"         ? MeshoptView::Filter::None
                      : filter == "OCTAHEDRAL" ? MeshoptView::Filter::Octahedral
                                               : MeshoptView::Filter::Exponential;
        stride = view.stride;
        std::string& unpacked = unpacked_[index];
        if (unpacked.empty()) {
            try {
                unpacked = meshopt_unpacked(bytes, view);
            } catch (const Error& fault) { throw_error_in(path_, fmt::format("{}: {}", where, fault.what())); }
            loaded_bytes_ += unpacked.size();
            if (loaded_bytes_ > largest_buffers_bytes) {
                refuse(where, fmt::format("buffers of at most {} bytes", largest_buffers_bytes), "more");
            }
        }
        return unpacked;
    }

    std::filesystem::path path_;
    std::string file_;
    Json root_;
    std::optional<std::string_view> binary_; ///< the second chunk of a .glb
    std::vector<std::optional<std::string>> buffers_;
    std::map<std::size_t, std::string> unpacked_; ///< views that were packed
    std::size_t loaded_bytes_ = 0;
};

/// A mesh of a glTF file, by its number, where a node shows it.
struct PlacedMesh {
    std::size_t mesh = 0;
    AffineTransform placement;
};

constexpr int max_gltf_node_depth = 200;

class SceneWalk {
public:
    explicit SceneWalk(const GltfData& data) : data_(data), met_(data.count_of("nodes"), false) {}

    std::vector<PlacedMesh> walk() {
        for (const std::size_t root : roots()) { take_node(root, {}, 0); }
        for (std::size_t mesh = 0; met_.empty() && mesh < data_.count_of("meshes"); ++mesh) {
            placed_.push_back({mesh, {}});
        }
        return std::move(placed_);
    }

private:
    std::vector<std::size_t> roots() const {
        const std::size_t scenes = data_.count_of("scenes");
        const std::size_t scene = data_.index(data_.root(), "scene", scenes, "file").value_or(0);
        if (scenes > 0) { return node_list(data_.entry("scenes", scene), "nodes", fmt::format("scenes[{}]", scene)); }
        std::vector<bool> is_child(met_.size(), false);
        for (std::size_t node = 0; node < met_.size(); ++node) {
            for (const std::size_t child : children(node)) { is_child[child] = true; }
        }
        std::vector<std::size_t> found;
        for (std::size_t node = 0; node < met_.size(); ++node) {
            if (!is_child[node]) { found.push_back(node); }
        }
        return found;
    }

    std::vector<std::size_t> node_list(const Json& object, const char* name, const std::string& where) const {
        std::vector<std::size_t> found;
        for (const Json& node : data_.list(object, name, where)) {
            if (!node.is_number_unsigned() || node.get<std::uint64_t>() >= met_.size()) {
                data_.refuse(where + "." + name, fmt::format("nodes below {}", met_.size()),
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
        if (met_[index]) { data_.refuse(where, "a node with one parent", "one that is met again"); }
        if (depth > max_gltf_node_depth) {
            data_.refuse(where, fmt::format("nodes at most {} deep", max_gltf_node_depth), "a deeper one");
        }
        met_[index] = true;
        const Json& node = data_.entry("nodes", index);
        const AffineTransform placement = parent.of(own(node, where));
        if (const auto mesh = data_.index(node, "mesh", data_.count_of("meshes"), where)) {
            placed_.push_back({*mesh, placement});
        }
        for (const std::size_t child : children(index)) { take_node(child, placement, depth + 1); }
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
            if (length2 > 0.0) { image += 2.0 / length2 * glm::cross(v, glm::cross(v, image) + q[3] * image); }
            made.turn[axis] = image * scale[static_cast<std::size_t>(axis)];
        }
        made.shift_m = {shift[0], shift[1], shift[2]};
        return made;
    }

    const GltfData& data_;
    std::vector<bool> met_; ///< nodes
    std::vector<PlacedMesh> placed_;
};

/// What the default scene shows, else the first one, else the nodes that are nobody's child, else (a file without
/// nodes) all meshes as they are. Throws Error for nodes that are met twice.
std::vector<PlacedMesh> placed_meshes(const GltfData& data) { return SceneWalk(data).walk(); }

/// A member that is an object; null where it is not there.
const Json* object_in(const Json& json, const char* name) {
    const auto found = json.find(name);
    return found != json.end() && found->is_object() ? &*found : nullptr;
}

/// An extension of an object; null where it has none.
const Json* extension_in(const Json& json, const char* name) {
    const Json* extensions = object_in(json, "extensions");
    return extensions != nullptr ? object_in(*extensions, name) : nullptr;
}

/// A material's baseColorTexture, else its diffuseTexture of KHR_materials_pbrSpecularGlossiness; null where it has
/// none.
const Json* base_texture(GltfData& data, std::size_t material) {
    const Json& json = data.entry("materials", material);
    const Json* rough = object_in(json, "pbrMetallicRoughness");
    const Json* base = rough != nullptr ? object_in(*rough, "baseColorTexture") : nullptr;
    const Json* glossy = extension_in(json, "KHR_materials_pbrSpecularGlossiness");
    return base == nullptr && glossy != nullptr ? object_in(*glossy, "diffuseTexture") : base;
}

/// The image that a reference to a texture shows, also one of a format that an extension adds.
std::optional<std::size_t> image_of(GltfData& data, const Json* reference, const std::string& where) {
    const auto number =
        reference == nullptr ? std::nullopt : data.index(*reference, "index", data.count_of("textures"), where);
    if (!number) { return std::nullopt; }
    const Json& texture = data.entry("textures", *number);
    const std::size_t images = data.count_of("images");
    for (const char* name : {"EXT_texture_webp", "MSFT_texture_dds"}) {
        if (const Json* extension = extension_in(texture, name); extension != nullptr) {
            return data.index(*extension, "source", images, where);
        }
    }
    return data.index(texture, "source", images, where);
}

std::optional<std::size_t> image_of(GltfData& data, std::size_t material) {
    return image_of(data, base_texture(data, material), fmt::format("materials[{}]", material));
}

/// The file of an image outside the glTF file, as named there; nothing for one inside.
std::optional<std::string> image_file(GltfData& data, std::size_t image) {
    const Json uri = data.entry("images", image).value("uri", Json());
    if (!uri.is_string() || uri.get_ref<const std::string&>().starts_with("data:")) { return std::nullopt; }
    return without_percents(uri.get_ref<const std::string&>()).value_or(uri.get<std::string>());
}

/// The number of an image among `pictures`, read once. What cannot be read is noted and left out.
std::uint32_t picture_number(GltfData& data, std::size_t image, BakedPictures& pictures) {
    if (const auto file = image_file(data, image)) { return pictures.picture(*file); }
    return pictures.picture(fmt::format("images[{}]", image), data.image_bytes(image));
}

TextureWrap wrap_of(GltfData& data, const Json* sampler, const char* name) {
    constexpr std::size_t clamp = 33071;
    constexpr std::size_t mirror = 33648;
    const auto number = sampler == nullptr ? std::nullopt : data.index(*sampler, name, mirror + 1, "samplers");
    return number == clamp ? TextureWrap::Clamp : number == mirror ? TextureWrap::Mirror : TextureWrap::Repeat;
}

/// A material's base colour picture, and how it lies on surfaces.
PolygonPicture polygon_picture(GltfData& data, std::size_t material, BakedPictures& pictures) {
    PolygonPicture made;
    const auto image = image_of(data, material);
    if (!image) { return made; }
    const std::string where = fmt::format("materials[{}]", material);
    made.picture = picture_number(data, *image, pictures);
    const auto number = data.index(*base_texture(data, material), "index", data.count_of("textures"), where);
    const auto sampler =
        data.index(data.entry("textures", number.value_or(0)), "sampler", data.count_of("samplers"), where);
    const Json* sampling = sampler ? &data.entry("samplers", *sampler) : nullptr;
    made.wrap_u = wrap_of(data, sampling, "wrapS");
    made.wrap_v = wrap_of(data, sampling, "wrapT");
    const Json& json = data.entry("materials", material);
    const Json mode = json.value("alphaMode", Json());
    made.alpha = mode == "MASK" ? TextureAlpha::Mask : mode == "BLEND" ? TextureAlpha::Blend : TextureAlpha::Opaque;
    const Json cutoff = json.value("alphaCutoff", Json());
    if (mode == "MASK" && cutoff.is_number()) {
        made.threshold = static_cast<float>(std::clamp(cutoff.get<double>(), 0.0, 1.0));
    }
    return made;
}

/// Names a material's pictures in `made`: the file, or the bytes in the file at `path`.
void take_picture(GltfData& data, std::size_t material, const std::filesystem::path& path, Material& made) {
    const auto glow = image_of(data, object_in(data.entry("materials", material), "emissiveTexture"), "materials");
    if (glow) {
        const auto file = image_file(data, *glow);
        made.emissive_picture = file ? picture_file(path, *file).string() : fmt::format("picture-{}", *glow);
    }
    const auto image = image_of(data, material);
    if (!image) { return; }
    if (const auto file = image_file(data, *image)) {
        made.picture = picture_file(path, *file).string();
        return;
    }
    made.picture = fmt::format("picture-{}", *image);
    made.picture_bytes = std::make_shared<const std::string>(data.image_bytes(*image));
}

/// Where KHR_texture_transform moves texture coordinates, which count v downwards.
struct TextureMove {
    glm::dvec2 across{1.0, 0.0}; ///< where u leads
    glm::dvec2 down{0.0, 1.0};   ///< where v leads
    glm::dvec2 shift{0.0};

    bool operator==(const TextureMove&) const = default;
};

TextureMove texture_move(GltfData& data, const Json* base) {
    TextureMove made;
    const Json* json = base == nullptr ? nullptr : extension_in(*base, "KHR_texture_transform");
    if (json == nullptr) { return made; }
    const std::vector<double> shift = data.numbers(*json, "offset", {0.0, 0.0}, "KHR_texture_transform");
    const std::vector<double> scale = data.numbers(*json, "scale", {1.0, 1.0}, "KHR_texture_transform");
    const Json turn = json->value("rotation", Json(0.0));
    const double angle_rad = turn.is_number() ? turn.get<double>() : 0.0;
    made.across = scale[0] * glm::dvec2(std::cos(angle_rad), -std::sin(angle_rad));
    made.down = scale[1] * glm::dvec2(std::sin(angle_rad), std::cos(angle_rad));
    made.shift = {shift[0], shift[1]};
    return made;
}

/// The accessor of a primitive's texture coordinates: those of its material's base colour picture, the first ones where
/// there is none; nothing where the primitive has none.
std::optional<std::size_t> texture_accessor(
    GltfData& data, std::optional<std::size_t> material, const Json& attributes) {
    constexpr std::size_t max_sets = 8;
    const Json* base = material ? base_texture(data, *material) : nullptr;
    const Json* moved = base == nullptr ? nullptr : extension_in(*base, "KHR_texture_transform");
    const Json* naming = moved != nullptr && moved->contains("texCoord") ? moved : base;
    const std::size_t set = naming == nullptr ? 0 : data.index(*naming, "texCoord", max_sets, "materials").value_or(0);
    return data.index(attributes, fmt::format("TEXCOORD_{}", set).c_str(), data.count_of("accessors"), "attributes");
}

constexpr std::size_t max_gltf_numbers = std::size_t{1} << 27U; ///< of corners and vertices
constexpr std::string_view draco_extension = "KHR_draco_mesh_compression";

/// Floats, and the whole numbers of KHR_mesh_quantization.
constexpr std::array<int, 5> place_components{5126, 5120, 5121, 5122, 5123};

class GltfReading {
public:
    GltfReading(const std::filesystem::path& path, const ReadOptions& options)
        : path_(path), data_(path), mesh_(path, options), materials_(data_.count_of("materials"), invalid_index) {}

    /// What the file holds, to be finished.
    MeshBuilder read() {
        refuse_packed_meshes();
        for (const PlacedMesh& placed : placed_meshes(data_)) { take_mesh(placed.mesh, placed.placement); }
        if (skipped_ > 0) {
            mesh_.add_note(fmt::format("{}: {} primitives of points and lines are not read", path_.string(), skipped_));
        }
        if (!not_read_.empty()) {
            mesh_.add_note(
                fmt::format("{}: attributes that are not read: {}", path_.string(), fmt::join(not_read_, ", ")));
        }
        if (uneven_tints_ > 0) {
            mesh_.add_note(fmt::format("{}: {} surfaces with a picture have colours of vertices that vary: drawn in "
                                       "the mean of each",
                path_.string(), uneven_tints_));
        }
        return std::move(mesh_);
    }

private:
    /// Draco meshes are unpacked before by octant-read-mesh.
    void refuse_packed_meshes() const {
        for (const Json& name : data_.list(data_.root(), "extensionsRequired", "")) {
            if (name.is_string() && name.get_ref<const std::string&>() == draco_extension) {
                data_.refuse("extensionsRequired",
                    "accessors that Draco does not pack (gltf-transform copy IN.glb OUT.glb or Blender unpacks them)",
                    std::string(draco_extension));
            }
        }
    }

    void take_mesh(std::size_t index, const AffineTransform& placement) {
        const std::string where = fmt::format("meshes[{}].primitives", index);
        vertices_.clear();
        normals_.clear();
        texture_coordinates_.clear();
        for (const Json& primitive : data_.list(data_.entry("meshes", index), "primitives", where)) {
            if (!primitive.is_object()) { data_.refuse(where, "objects", "something else"); }
            take_primitive(primitive, placement, where);
        }
    }

    void take_primitive(const Json& primitive, const AffineTransform& placement, const std::string& where) {
        const std::size_t mode = data_.index(primitive, "mode", 7, where).value_or(4);
        if (mode < 4) {
            ++skipped_;
            return;
        }
        const auto attributes = primitive.find("attributes");
        if (attributes == primitive.end() || !attributes->is_object()) { data_.refuse(where, "attributes", "none"); }
        const std::size_t accessors = data_.count_of("accessors");
        const auto position = data_.index(*attributes, "POSITION", accessors, where);
        if (!position) { data_.refuse(where, "a POSITION", "none"); }
        const auto colour = data_.index(*attributes, "COLOR_0", accessors, where);
        const auto normal = data_.index(*attributes, "NORMAL", accessors, where);
        const auto material = data_.index(primitive, "material", materials_.size(), where);
        const PolygonPicture picture =
            material && mesh_.uses_pictures() ? polygon_picture(data_, *material, mesh_.pictures()) : PolygonPicture();
        const bool is_tint = colour && picture.picture != BakedPictures::none; // a picture times COLOR_0
        const auto [first_vertex, count] =
            vertices(*position, is_tint ? accessors : colour.value_or(accessors), placement, where);
        std::uint32_t first_normal = invalid_index;
        mesh_.set_smoothing({Smoothing::flat}); // as the specification wants it where normals are missing
        if (normal) { first_normal = normals(*normal, count, placement, where); }
        std::vector<std::uint32_t> corners = corner_list(primitive, count, where);
        const std::uint32_t used = is_tint    ? tinted_material(*material, *colour, count, where)
                                   : material ? used_material(*material)
                                              : invalid_index;
        const std::uint32_t first_texture = texture_coordinates(material, *attributes, count);
        const auto texture = texture_accessor(data_, material, *attributes);
        for (const auto& [name, number] : attributes->items()) {
            if (name != "POSITION" && name != "COLOR_0" && name != "NORMAL" && number != texture) {
                not_read_.insert(printable(name));
            }
        }
        const auto add = [&, first = first_vertex](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            const auto corner = [&](std::uint32_t vertex) {
                return CornerIndices{first + vertex,
                    first_normal == invalid_index ? invalid_index : first_normal + vertex,
                    first_texture == invalid_index ? invalid_index : first_texture + vertex};
            };
            std::array<CornerIndices, 3> triangle{corner(a), corner(b), corner(c)};
            if (placement.mirrors()) { std::swap(triangle[1], triangle[2]); }
            mesh_.add_polygon(triangle, used, first_texture == invalid_index ? PolygonPicture() : picture);
        };
        add_triangles(mode, corners, add, where);
    }

    /// Mode 4 is triangles, 5 a strip, 6 a fan.
    template <typename Add>
    void add_triangles(
        std::size_t mode, const std::vector<std::uint32_t>& corners, const Add& add, const std::string& where) const {
        if (corners.size() < 3 || (mode == 4 && corners.size() % 3 != 0)) {
            data_.refuse(where, "corners of whole triangles", std::to_string(corners.size()));
        }
        for (std::size_t i = 0; mode == 4 && i < corners.size(); i += 3) {
            add(corners[i], corners[i + 1], corners[i + 2]);
        }
        for (std::size_t i = 0; mode == 5 && i + 2 < corners.size(); ++i) {
            add(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
        }
        for (std::size_t i = 1; mode == 6 && i + 1 < corners.size(); ++i) {
            add(corners[0], corners[i], corners[i + 1]);
        }
    }

    /// Entries of a mesh count each time that a node shows it.
    void count_numbers(std::size_t count, const std::string& where) {
        numbers_ += count;
        if (numbers_ > max_gltf_numbers) {
            data_.refuse(where, fmt::format("at most {} corners and vertices", max_gltf_numbers), "more");
        }
    }

    /// Primitives of one mesh that have the same places and colours share their vertices.
    std::pair<std::uint32_t, std::size_t> vertices(
        std::size_t position, std::size_t colour, const AffineTransform& placement, const std::string& where) {
        const auto known = vertices_.find({position, colour});
        if (known != vertices_.end()) { return known->second; }
        const GltfAccessor places = data_.accessor(position);
        if (places.parts() != 3 || std::ranges::find(place_components, places.component()) == place_components.end()) {
            data_.refuse(where, "a POSITION of three floats or short numbers", "another type");
        }
        count_numbers(places.count(), where);
        const auto first = static_cast<std::uint32_t>(mesh_.vertex_count());
        for (std::size_t i = 0; i < places.count(); ++i) {
            const auto place_m = placement.point_m({places.at(i, 0), places.at(i, 1), places.at(i, 2)});
            if (!place_m) {
                data_.refuse(where, "finite places within bounds",
                    fmt::format("{} {} {}", places.at(i, 0), places.at(i, 1), places.at(i, 2)));
            }
            mesh_.add_vertex(*place_m);
        }
        if (colour < data_.count_of("accessors")) {
            take_colours(colours_of(colour, places.count(), where), first, where);
        }
        const std::pair made(first, places.count());
        vertices_.emplace(std::pair(position, colour), made);
        return made;
    }

    void check_colour(const glm::dvec3& colour, const std::string& where) const {
        if (const auto fault = colour_fault(colour)) {
            data_.refuse(where, "a colour of 0 to 1", fmt::format("{}", *fault));
        }
    }

    /// Refuses colours that are not one for each of `count` places.
    GltfAccessor colours_of(std::size_t index, std::size_t count, const std::string& where) {
        const GltfAccessor colours = data_.accessor(index);
        if (colours.parts() < 3 || colours.count() != count) {
            data_.refuse(where, fmt::format("a COLOR_0 of 3 or 4 numbers for each of {} places", count),
                fmt::format("{} of {}", colours.count(), colours.parts()));
        }
        return colours;
    }

    void take_colours(const GltfAccessor& colours, std::uint32_t first, const std::string& where) {
        for (std::size_t i = 0; i < colours.count(); ++i) {
            const glm::dvec3 colour(colours.at(i, 0), colours.at(i, 1), colours.at(i, 2));
            check_colour(colour, where);
            mesh_.set_colour(first + static_cast<std::uint32_t>(i), glm::vec3(srgb_from_linear(colour)));
        }
    }

    /// What colours of vertices are to a picture.
    struct Tint {
        glm::dvec3 mean{1.0}; ///< linear in light
        bool is_uneven = false;
    };

    /// Of the colours of an accessor, which are read once.
    const Tint& tint_of(std::size_t index, std::size_t count, const std::string& where) {
        const GltfAccessor list = colours_of(index, count, where);
        const auto [known, is_new] = tints_.try_emplace(index);
        if (!is_new || count == 0) { return known->second; }
        count_numbers(count, where);
        glm::dvec3 sum(0.0);
        glm::dvec3 least(1.0);
        glm::dvec3 most(0.0);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 colour(list.at(i, 0), list.at(i, 1), list.at(i, 2));
            check_colour(colour, where);
            sum += colour;
            least = glm::min(least, colour);
            most = glm::max(most, colour);
        }
        constexpr double even = 1.0 / 64.0;
        known->second = {sum / static_cast<double>(count),
            most.x - least.x > even || most.y - least.y > even || most.z - least.z > even};
        return known->second;
    }

    /// A material times the mean of colours of vertices, one for each of `count` places: pictures are drawn in one
    /// tint.
    std::uint32_t tinted_material(std::size_t index, std::size_t colours, std::size_t count, const std::string& where) {
        const std::uint32_t own = used_material(index);
        const Tint& tint = tint_of(colours, count, where);
        const auto [known, is_new] = tinted_.try_emplace({index, colours}, own);
        if (!is_new) { return known->second; }
        if (tint.is_uneven) { ++uneven_tints_; }
        if (tint.mean == glm::dvec3(1.0)) { return own; }
        Material tinted = mesh_.material(own);
        tinted.colour = glm::vec3(srgb_from_linear(linear_from_srgb(glm::dvec3(tinted.colour)) * tint.mean));
        known->second = mesh_.add_material(std::move(tinted));
        return known->second;
    }

    std::uint32_t normals(
        std::size_t index, std::size_t count, const AffineTransform& placement, const std::string& where) {
        const auto known = normals_.find(index);
        if (known != normals_.end() && known->second.second == count) { return known->second.first; }
        const GltfAccessor list = data_.accessor(index);
        if (list.parts() != 3 || list.count() != count) {
            data_.refuse(where, fmt::format("a NORMAL of three numbers for each of {} places", count),
                fmt::format("{} of {}", list.count(), list.parts()));
        }
        const auto first = static_cast<std::uint32_t>(mesh_.normal_count());
        for (std::size_t i = 0; i < count; ++i) {
            mesh_.add_normal(placement.normal({list.at(i, 0), list.at(i, 1), list.at(i, 2)}));
        }
        count_numbers(count, where);
        normals_[index] = {first, count};
        return first;
    }

    /// The first of the texture coordinates of a primitive's vertices; invalid_index where it has none.
    std::uint32_t texture_coordinates(std::optional<std::size_t> material, const Json& attributes, std::size_t count) {
        const auto index = texture_accessor(data_, material, attributes);
        if (!index) { return invalid_index; }
        const TextureMove move = texture_move(data_, material ? base_texture(data_, *material) : nullptr);
        for (const PlacedTexture& known : texture_coordinates_) {
            if (known.accessor == *index && known.move == move && known.count == count) { return known.first; }
        }
        const GltfAccessor list = data_.accessor(*index);
        if (list.parts() != 2 || list.count() != count) { return invalid_index; }
        const auto first = static_cast<std::uint32_t>(mesh_.texture_coordinates_count());
        for (std::size_t i = 0; i < count; ++i) { // glTF counts v downwards
            if (move == TextureMove()) {
                mesh_.add_texture_coordinates(
                    {static_cast<float>(list.at(i, 0)), 1.0F - static_cast<float>(list.at(i, 1))});
                continue;
            }
            const glm::dvec2 place = list.at(i, 0) * move.across + list.at(i, 1) * move.down + move.shift;
            mesh_.add_texture_coordinates({static_cast<float>(place.x), static_cast<float>(1.0 - place.y)});
        }
        texture_coordinates_.push_back({*index, move, first, count});
        return first;
    }

    std::vector<std::uint32_t> corner_list(const Json& primitive, std::size_t count, const std::string& where) {
        std::vector<std::uint32_t> corners;
        const auto index = data_.index(primitive, "indices", data_.count_of("accessors"), where);
        if (!index) {
            count_numbers(count, where);
            for (std::uint32_t i = 0; i < count; ++i) { corners.push_back(i); }
            return corners;
        }
        const GltfAccessor indices = data_.accessor(*index);
        const int type = indices.component();
        if (indices.parts() != 1 || (type != 5121 && type != 5123 && type != 5125)) {
            data_.refuse(where, "indices of whole numbers", "another type");
        }
        count_numbers(indices.count(), where);
        for (std::size_t i = 0; i < indices.count(); ++i) {
            corners.push_back(indices.unsigned_at(i));
            if (corners.back() >= count) {
                data_.refuse(where, fmt::format("indices below {}", count), std::to_string(corners.back()));
            }
        }
        return corners;
    }

    /// Materials come in the order of their first primitive.
    void count_undrawn(const Json& material) {
        constexpr std::array<std::pair<const char*, const char*>, 2> beside{
            {{"normalTexture", "normals"}, {"emissiveTexture", "glow"}}};
        for (const auto& [key, kind] : beside) {
            if (material.contains(key)) { mesh_.add_undrawn_picture(kind); }
        }
        const auto rough = material.find("pbrMetallicRoughness");
        if (rough != material.end() && rough->is_object() && rough->contains("metallicRoughnessTexture")) {
            mesh_.add_undrawn_picture("metal and roughness");
        }
    }

    std::uint32_t used_material(std::size_t index) {
        if (materials_[index] != invalid_index) { return materials_[index]; }
        const std::string where = fmt::format("materials[{}]", index);
        const Json& json = data_.entry("materials", index);
        const Json name = json.value("name", Json());
        Material made{.name = name.is_string() ? name.get<std::string>() : fmt::format("material {}", index)};
        made.colour = glm::vec3(1.0F); // as glTF has it
        count_undrawn(json);
        const auto rough = json.find("pbrMetallicRoughness");
        if (rough != json.end() && rough->is_object()) {
            const auto c = data_.numbers(*rough, "baseColorFactor", {1.0, 1.0, 1.0, 1.0}, where);
            const glm::dvec3 colour(c[0], c[1], c[2]);
            check_colour(colour, where);
            made.colour = glm::vec3(srgb_from_linear(colour));
            if (json.value("alphaMode", Json()) == "BLEND") {
                made.opacity = static_cast<float>(std::clamp(c[3], 0.0, 1.0));
            }
        }
        if (const Json* glossy = extension_in(json, "KHR_materials_pbrSpecularGlossiness");
            glossy != nullptr && rough == json.end()) {
            const auto c = data_.numbers(*glossy, "diffuseFactor", {1.0, 1.0, 1.0, 1.0}, where);
            check_colour({c[0], c[1], c[2]}, where);
            made.colour = glm::vec3(srgb_from_linear({c[0], c[1], c[2]}));
        }
        take_picture(data_, index, path_, made);
        return materials_[index] = mesh_.add_material(std::move(made));
    }

    /// Texture coordinates that were added, by where they come from.
    struct PlacedTexture {
        std::size_t accessor = 0;
        TextureMove move;
        std::uint32_t first = 0;
        std::size_t count = 0;
    };

    std::filesystem::path path_;
    GltfData data_;
    MeshBuilder mesh_;
    std::vector<std::uint32_t> materials_;                                ///< of the file, as materials of the mesh
    std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> tinted_; ///< by material and COLOR_0
    std::map<std::size_t, Tint> tints_;                                   ///< by COLOR_0
    std::map<std::pair<std::size_t, std::size_t>, std::pair<std::uint32_t, std::size_t>> vertices_;
    std::map<std::size_t, std::pair<std::uint32_t, std::size_t>> normals_;
    std::vector<PlacedTexture> texture_coordinates_; ///< of the mesh at hand
    std::size_t numbers_ = 0;
    std::size_t skipped_ = 0;
    std::size_t uneven_tints_ = 0;
    std::set<std::string> not_read_; ///< attributes
};

} // namespace

MeshBuilder read_gltf(const std::filesystem::path& path, const ReadOptions& options) {
    return GltfReading(path, options).read();
}

} // namespace octant::models::meshfile
