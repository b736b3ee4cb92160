#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::meshfile {

using Json = nlohmann::json;

/// Numbers of a glTF accessor, in their file.
class GltfAccessor {
public:
    GltfAccessor() = default;

    std::size_t count() const { return count_; }

    int parts() const { return parts_; }

    int component() const { return component_; }

    /// Part `part` of entry `entry`; whole numbers that stand for 0..1 as such.
    double at(std::size_t entry, int part) const;

    /// An entry as a whole number.
    std::uint32_t unsigned_at(std::size_t entry) const;

private:
    friend class GltfData;

    std::string_view bytes_; ///< from the first entry on
    std::size_t stride_ = 0;
    std::size_t count_ = 0;
    int parts_ = 1;
    int component_ = 5126; ///< glTF's number of the type
    bool is_normalized_ = false;
};

/// The JSON part of a .gltf or .glb file and what its buffers hold. Every access is checked; faults throw Error "file:
/// meshes[0].primitives: expected ..., got ...".
class GltfData {
public:
    explicit GltfData(const std::filesystem::path& path);

    const Json& root() const { return root_; }

    [[noreturn]] void refuse(const std::string& where, const std::string& expected, const std::string& got) const;

    /// Entry `index` of a list at the top, which must be an object.
    const Json& entry(const char* list, std::size_t index) const;

    std::size_t count_of(const char* list) const;

    /// A member that must be a whole number below `limit`; nothing when it is missing.
    std::optional<std::size_t> index(
        const Json& object, const char* name, std::size_t limit, const std::string& where) const;

    /// The list of that name, empty when it is missing.
    const Json& list(const Json& object, const char* name, const std::string& where) const;

    /// As many numbers as `otherwise` has, which is given when the member is missing.
    std::vector<double> numbers(
        const Json& object, const char* name, std::vector<double> otherwise, const std::string& where) const;

    /// The accessor of that number, all of which lies in its buffer.
    GltfAccessor accessor(std::size_t index);

    /// The bytes of an image's file, from a view or its own address.
    std::string image_bytes(std::size_t index);

private:
    void read_json(std::string_view text, std::size_t first_byte);
    void read_binary(std::string_view bytes);
    std::string_view buffer(std::size_t index);
    std::string buffer_bytes(const Json& buffer, const std::string& where) const;
    std::string_view view(std::size_t index, std::size_t& stride);

    std::filesystem::path path_;
    std::string file_;
    Json root_;
    std::optional<std::string_view> binary_; ///< the second chunk of a .glb
    std::vector<std::optional<std::string>> buffers_;
    std::size_t loaded_bytes_ = 0;
};

} // namespace octant::models::meshfile
