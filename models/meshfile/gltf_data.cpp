#include "models/meshfile/gltf_data.h"

#include "models/meshfile/base64.h"
#include "models/meshfile/byte_reader.h"
#include "models/meshfile/word_scanner.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>

namespace octant::models::meshfile {

namespace {

constexpr std::size_t largest_gltf_bytes = std::size_t{1} << 28U;
constexpr std::size_t largest_buffers_bytes = std::size_t{1} << 30U;
constexpr int max_json_depth = 64;
constexpr std::uint32_t glb_magic = 0x46546c67;
constexpr std::uint32_t json_chunk = 0x4e4f534a;
constexpr std::uint32_t binary_chunk = 0x004e4942;

std::size_t bytes_of(int component) { return component <= 5121 ? 1 : (component <= 5123 ? 2 : 4); }

template <typename T>
T little_endian(std::string_view bytes, std::size_t at) {
    char own[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        const std::size_t from = std::endian::native == std::endian::little ? i : sizeof(T) - 1 - i;
        own[i] = bytes[at + from];
    }
    T value;
    std::memcpy(&value, own, sizeof(T));
    return value;
}

std::string shown(const Json& value) { return in_quotes(value.dump(-1, ' ', true, Json::error_handler_t::replace)); }

/// %20 and the like as the bytes they stand for; nothing when there is no such byte.
std::optional<std::string> without_percents(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            out += text[i];
            continue;
        }
        const std::string hex(text.substr(i + 1, 2));
        if (hex.size() != 2 || hex.find_first_not_of("0123456789abcdefABCDEF") != hex.npos || hex == "00") {
            return std::nullopt;
        }
        out += static_cast<char>(std::stoi(hex, nullptr, 16));
        i += 2;
    }
    return out;
}

/// A relative path that does not leave its folder.
bool stays_inside(const std::filesystem::path& path) {
    return !path.empty() && path.is_relative() && path.string().find('\\') == std::string::npos &&
           path.string().find(':') == std::string::npos &&
           std::ranges::find(path, std::filesystem::path("..")) == path.end();
}

} // namespace

double GltfAccessor::at(std::size_t entry, int part) const {
    const std::size_t byte = entry * stride_ + static_cast<std::size_t>(part) * bytes_of(component_);
    switch (component_) {
    case 5120:
        return is_normalized_ ? std::max(little_endian<std::int8_t>(bytes_, byte) / 127.0, -1.0)
                              : little_endian<std::int8_t>(bytes_, byte);
    case 5121:
        return little_endian<std::uint8_t>(bytes_, byte) / (is_normalized_ ? 255.0 : 1.0);
    case 5122:
        return is_normalized_ ? std::max(little_endian<std::int16_t>(bytes_, byte) / 32767.0, -1.0)
                              : little_endian<std::int16_t>(bytes_, byte);
    case 5123:
        return little_endian<std::uint16_t>(bytes_, byte) / (is_normalized_ ? 65535.0 : 1.0);
    case 5125:
        return little_endian<std::uint32_t>(bytes_, byte);
    default:
        return static_cast<double>(little_endian<float>(bytes_, byte));
    }
}

std::uint32_t GltfAccessor::unsigned_at(std::size_t entry) const { return static_cast<std::uint32_t>(at(entry, 0)); }

GltfData::GltfData(const std::filesystem::path& path) : path_(path), file_(read_file(path, largest_gltf_bytes)) {
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

/// Header, a JSON chunk and perhaps a binary one; further chunks say nothing about meshes.
void GltfData::read_binary(std::string_view bytes) {
    ByteReader reader(path_, bytes);
    static_assert(glb_magic != json_chunk);
    reader.take(4, "a magic number");
    const auto version = reader.number<std::uint32_t>("a version");
    if (version != 2) { reader.refuse_at(4, "version 2", std::to_string(version)); }
    const auto length = reader.number<std::uint32_t>("a length");
    if (length != bytes.size()) {
        reader.refuse_at(8, fmt::format("a length of {}", bytes.size()), std::to_string(length));
    }
    for (int chunk = 0; chunk == 0 || reader.bytes_left() > 0; ++chunk) {
        const auto chunk_bytes = reader.number<std::uint32_t>("a chunk's length");
        const auto kind = reader.number<std::uint32_t>("a chunk's kind");
        const std::size_t at = reader.at();
        const std::string_view content = reader.take(chunk_bytes, "a chunk");
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

void GltfData::read_json(std::string_view text, std::size_t first_byte) {
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

void GltfData::refuse(const std::string& where, const std::string& expected, const std::string& got) const {
    throw_error_in(path_, fmt::format("{}: expected {}, got {}", where, expected, got));
}

std::size_t GltfData::count_of(const char* name) const { return list(root_, name, "").size(); }

const Json& GltfData::entry(const char* name, std::size_t index) const {
    const Json& found = list(root_, name, "")[index];
    if (!found.is_object()) { refuse(fmt::format("{}[{}]", name, index), "an object", shown(found)); }
    return found;
}

std::optional<std::size_t> GltfData::index(
    const Json& object, const char* name, std::size_t limit, const std::string& where) const {
    const auto found = object.find(name);
    if (found == object.end()) { return std::nullopt; }
    if (!found->is_number_unsigned() || found->get<std::uint64_t>() >= limit) {
        refuse(where + "." + name, fmt::format("a whole number below {}", limit), shown(*found));
    }
    return found->get<std::size_t>();
}

const Json& GltfData::list(const Json& object, const char* name, const std::string& where) const {
    static const Json none = Json::array();
    const auto found = object.find(name);
    if (found == object.end()) { return none; }
    if (!found->is_array()) { refuse(where.empty() ? name : where + "." + name, "a list", shown(*found)); }
    return *found;
}

std::vector<double> GltfData::numbers(
    const Json& object, const char* name, std::vector<double> otherwise, const std::string& where) const {
    const Json& found = list(object, name, where);
    if (object.find(name) == object.end()) { return otherwise; }
    if (found.size() != otherwise.size() ||
        !std::ranges::all_of(found, [](const Json& value) { return value.is_number(); })) {
        refuse(where + "." + name, fmt::format("{} numbers", otherwise.size()), shown(found));
    }
    return found.get<std::vector<double>>();
}

GltfAccessor GltfData::accessor(std::size_t index) {
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

std::string GltfData::image_bytes(std::size_t index) {
    const std::string where = fmt::format("images[{}]", index);
    const Json& json = entry("images", index);
    if (const auto view_index = this->index(json, "bufferView", count_of("bufferViews"), where)) {
        std::size_t stride = 0;
        return std::string(view(*view_index, stride));
    }
    return buffer_bytes(json, where);
}

std::string_view GltfData::view(std::size_t index, std::size_t& stride) {
    const std::string where = fmt::format("bufferViews[{}]", index);
    const Json& json = entry("bufferViews", index);
    const auto buffer_index = this->index(json, "buffer", buffers_.size(), where);
    if (!buffer_index) { refuse(where, "a buffer", "none"); }
    const std::string_view bytes = buffer(*buffer_index);
    const std::size_t first = this->index(json, "byteOffset", bytes.size() + 1, where).value_or(0);
    const auto length = this->index(json, "byteLength", bytes.size() - first + 1, where);
    if (!length) { refuse(where, "a byteLength", "none"); }
    stride = this->index(json, "byteStride", 253, where).value_or(0);
    return bytes.substr(first, *length);
}

std::string_view GltfData::buffer(std::size_t index) {
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

std::string GltfData::buffer_bytes(const Json& buffer, const std::string& where) const {
    const auto uri = buffer.find("uri");
    if (uri == buffer.end() || !uri->is_string()) {
        refuse(where + ".uri", "an address", uri == buffer.end() ? "none" : shown(*uri));
    }
    const std::string_view text = uri->get_ref<const std::string&>();
    if (text.starts_with("data:")) {
        const std::size_t comma = text.find(";base64,");
        const auto bytes = comma == text.npos ? std::nullopt : base64_bytes(text.substr(comma + 8));
        if (!bytes) { refuse(where + ".uri", "base64 data", in_quotes(text)); }
        return *bytes;
    }
    const auto name = without_percents(text);
    if (!name || !stays_inside(*name)) { refuse(where + ".uri", "a file in the folder of this one", in_quotes(text)); }
    const std::filesystem::path file = path_.parent_path() / *name;
    if (std::error_code ignored; !std::filesystem::exists(file, ignored)) {
        refuse(where + ".uri", "a file that lies beside this one", in_quotes(text));
    }
    return read_file(file, largest_gltf_bytes);
}

} // namespace octant::models::meshfile
