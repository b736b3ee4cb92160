// Writes a glTF file whose meshes Draco has packed as a plain one: the same JSON, with all buffers and pictures inside
// and the accessors of packed primitives filled in.
#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/reader/library_readers.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <draco/compression/decode.h>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace octant::ui::reader {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t largest_bytes = std::size_t{1} << 28U;
constexpr const char* draco_name = "KHR_draco_mesh_compression";

class DracoUnpacking {
public:
    explicit DracoUnpacking(const fs::path& file) : file_(file), content_(read_file(file, largest_bytes)) {
        if (!content_.starts_with("glTF")) {
            json_ = Json::parse(content_);
            return;
        }
        BinaryReader in(content_, file);
        in.take_bytes(12, "a header");
        while (in.bytes_left() > 0) {
            const auto bytes = in.take<std::uint32_t>("a chunk's length");
            const auto kind = in.take<std::uint32_t>("a chunk's kind");
            const std::string_view chunk = in.take_bytes(bytes, "a chunk");
            if (json_.is_null()) {
                json_ = Json::parse(chunk);
            } else if (kind == binary_chunk) {
                binary_ = chunk;
                break;
            }
        }
    }

    std::string unpacked() {
        for (std::size_t i = 0; i < list("buffers").size(); ++i) { load_buffer(i); }
        for (Json& view : list("bufferViews")) { move_view(view); }
        for (Json& image : list("images")) { take_in(image); }
        for (Json& mesh : list("meshes")) {
            for (Json& primitive : mesh.at("primitives")) { unpack(primitive); }
        }
        for (const char* name : {"extensionsRequired", "extensionsUsed"}) {
            Json& names = list(name);
            names.erase(std::remove(names.begin(), names.end(), Json(draco_name)), names.end());
            if (names.empty()) { json_.erase(name); }
        }
        return glb();
    }

private:
    static constexpr std::uint32_t json_chunk = 0x4e4f534a;
    static constexpr std::uint32_t binary_chunk = 0x004e4942;

    Json& list(const char* name) {
        Json& found = json_[name];
        if (found.is_null()) { found = Json::array(); }
        if (!found.is_array()) { throw_error_in(file_, fmt::format("{}: expected a list, got another value", name)); }
        return found;
    }

    /// The bytes of a URI: data, or a file in the folder of this one.
    std::string bytes_of(const std::string& uri) const {
        if (uri.starts_with("data:")) {
            const std::size_t comma = uri.find(";base64,");
            const auto bytes = comma == uri.npos ? std::nullopt : from_base64(uri.substr(comma + 8));
            if (!bytes) { throw_error_in(file_, "expected base64 data, got other data"); }
            return *bytes;
        }
        const fs::path name = uri;
        if (name.is_absolute() || std::ranges::find(name, fs::path("..")) != name.end()) {
            throw_error_in(file_, "expected a buffer in the folder of this file, got " + in_quotes(uri));
        }
        return read_file(file_.parent_path() / name, largest_bytes);
    }

    void load_buffer(std::size_t index) {
        const Json& buffer = list("buffers").at(index);
        const bool has_uri = buffer.contains("uri");
        starts_.push_back(out_.size());
        const std::string bytes =
            has_uri ? bytes_of(buffer.at("uri").get<std::string>()) : std::string(index == 0 ? binary_ : "");
        sizes_.push_back(bytes.size());
        append(bytes);
    }

    std::size_t append(std::string_view bytes) {
        const std::size_t at = out_.size();
        if (bytes.size() > 4 * largest_bytes - at) {
            throw_error_in(file_, fmt::format("expected at most {} unpacked bytes, got more", 4 * largest_bytes));
        }
        out_ += bytes;
        out_.resize((out_.size() + 3) / 4 * 4, '\0');
        return at;
    }

    /// Into the one buffer that is written.
    void move_view(Json& view) {
        move_range(view);
        for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
            if (view.contains("extensions") && view["extensions"].contains(name)) {
                move_range(view["extensions"][name]);
            }
        }
    }

    void move_range(Json& range) {
        const auto buffer = range.at("buffer").get<std::size_t>();
        const auto offset = range.value("byteOffset", std::size_t{0});
        const auto length = range.at("byteLength").get<std::size_t>();
        const bool is_fallback = sizes_.at(buffer) == 0; // of meshopt, which has the bytes elsewhere
        if (!is_fallback && (offset > sizes_[buffer] || length > sizes_[buffer] - offset)) {
            throw_error_in(file_, "expected views inside their buffers, got one that leaves its own");
        }
        range["byteOffset"] = is_fallback ? 0 : starts_[buffer] + offset;
        range["byteLength"] = is_fallback ? 0 : length;
        range["buffer"] = 0;
    }

    std::size_t add_view(std::string_view bytes) {
        const std::size_t at = append(bytes);
        list("bufferViews").push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", bytes.size()}});
        return list("bufferViews").size() - 1;
    }

    /// Pictures beside the file; what is missing stays named, and the reader notes it.
    void take_in(Json& image) {
        if (!image.contains("uri")) { return; }
        const auto uri = image["uri"].get<std::string>();
        std::error_code ignored;
        if (uri.starts_with("data:") || !fs::is_regular_file(file_.parent_path() / uri, ignored)) { return; }
        const std::string bytes = bytes_of(uri);
        image.erase("uri");
        image["bufferView"] = add_view(bytes);
        image["mimeType"] = bytes.starts_with("\x89PNG") ? "image/png" : "image/jpeg";
    }

    void unpack(Json& primitive) {
        if (!primitive.contains("extensions") || !primitive["extensions"].contains(draco_name)) { return; }
        const Json packed = primitive["extensions"][draco_name];
        const std::unique_ptr<draco::Mesh> mesh = decoded(packed.at("bufferView").get<std::size_t>());
        std::string corners;
        for (std::uint32_t face = 0; face < mesh->num_faces(); ++face) {
            for (const auto& point : mesh->face(draco::FaceIndex(face))) {
                const std::uint32_t value = point.value();
                corners.append(reinterpret_cast<const char*>(&value), sizeof value);
            }
        }
        fill(primitive.at("indices").get<std::size_t>(), std::size_t{3} * mesh->num_faces(), corners);
        list("accessors").at(primitive.at("indices").get<std::size_t>())["componentType"] = unsigned_int;
        for (const auto& [name, id] : packed.at("attributes").items()) {
            const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id.get<std::uint32_t>());
            if (attribute == nullptr || !primitive.at("attributes").contains(name)) { continue; }
            fill_attribute(primitive["attributes"][name].get<std::size_t>(), *mesh, *attribute);
        }
        primitive["extensions"].erase(draco_name);
        primitive["mode"] = 4;
    }

    std::unique_ptr<draco::Mesh> decoded(std::size_t view_index) {
        const Json& view = list("bufferViews").at(view_index);
        draco::DecoderBuffer bytes;
        bytes.Init(out_.data() + view.at("byteOffset").get<std::size_t>(), view.at("byteLength").get<std::size_t>());
        draco::Decoder decoder;
        auto mesh = decoder.DecodeMeshFromBuffer(&bytes);
        if (!mesh.ok()) {
            throw_error_in(file_, fmt::format("bufferViews[{}]: expected a mesh packed by Draco, got '{}'", view_index,
                                      printable(mesh.status().error_msg_string())));
        }
        return std::move(mesh).value();
    }

    void fill(std::size_t accessor_index, std::size_t count, std::string_view bytes) {
        const std::size_t view = add_view(bytes);
        Json& accessor = list("accessors").at(accessor_index);
        accessor["bufferView"] = view;
        accessor["byteOffset"] = 0;
        accessor["count"] = count;
    }

    static constexpr int unsigned_int = 5125;

    void fill_attribute(std::size_t accessor, const draco::Mesh& mesh, const draco::PointAttribute& attribute) {
        const auto component = list("accessors").at(accessor).at("componentType").get<int>();
        const auto kind = list("accessors").at(accessor).at("type").get<std::string>();
        const int parts = kind == "SCALAR" ? 1 : kind == "VEC2" ? 2 : kind == "VEC3" ? 3 : 4;
        std::string bytes;
        switch (component) {
        case 5120:
            bytes = values<std::int8_t>(mesh, attribute, parts);
            break;
        case 5121:
            bytes = values<std::uint8_t>(mesh, attribute, parts);
            break;
        case 5122:
            bytes = values<std::int16_t>(mesh, attribute, parts);
            break;
        case 5123:
            bytes = values<std::uint16_t>(mesh, attribute, parts);
            break;
        case unsigned_int:
            bytes = values<std::uint32_t>(mesh, attribute, parts);
            break;
        default:
            bytes = values<float>(mesh, attribute, parts);
        }
        fill(accessor, mesh.num_points(), bytes);
    }

    template <typename Number>
    std::string values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int parts) const {
        std::string bytes;
        std::vector<Number> one(static_cast<std::size_t>(parts));
        for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
            const auto index = attribute.mapped_index(draco::PointIndex(point));
            if (!attribute.ConvertValue<Number>(index, static_cast<std::int8_t>(parts), one.data())) {
                throw_error_in(file_, "expected attributes that fit their accessors, got others");
            }
            bytes.append(reinterpret_cast<const char*>(one.data()), one.size() * sizeof(Number));
        }
        return bytes;
    }

    std::string glb() {
        json_["buffers"] = Json::array({{{"byteLength", out_.size()}}});
        std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        BinaryWriter out;
        out.put_bytes("glTF");
        out.put(std::uint32_t{2});
        out.put(static_cast<std::uint32_t>(28 + text.size() + out_.size()));
        out.put(static_cast<std::uint32_t>(text.size()));
        out.put(json_chunk);
        out.put_bytes(text);
        out.put(static_cast<std::uint32_t>(out_.size()));
        out.put(binary_chunk);
        out.put_bytes(out_);
        return out.take();
    }

    fs::path file_;
    std::string content_;
    Json json_;
    std::string_view binary_;
    std::string out_;                 ///< the buffer that is written
    std::vector<std::size_t> starts_; ///< of the file's buffers in it
    std::vector<std::size_t> sizes_;
};

} // namespace

void unpack_draco(const fs::path& file, const fs::path& out) {
    try {
        write_file(out, DracoUnpacking(file).unpacked());
    } catch (const Json::exception& fault) {
        throw_error_in(file, fmt::format("expected glTF, got '{}'", printable(fault.what())));
    }
}

} // namespace octant::ui::reader
