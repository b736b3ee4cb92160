#include "models/meshfile/gltf_pictures.h"

#include "sim/base/error.h"

#include <fmt/format.h>

namespace octant::models::meshfile {

namespace {

/// A member that is an object; null where it is not there.
const Json* object_in(const Json& json, const char* name) {
    const auto found = json.find(name);
    return found != json.end() && found->is_object() ? &*found : nullptr;
}

/// A material's baseColorTexture; null where it has none.
const Json* base_texture(GltfData& data, std::size_t material) {
    const Json* rough = object_in(data.entry("materials", material), "pbrMetallicRoughness");
    return rough != nullptr ? object_in(*rough, "baseColorTexture") : nullptr;
}

std::optional<std::size_t> image_of(GltfData& data, std::size_t material) {
    const std::string where = fmt::format("materials[{}]", material);
    const Json* base = base_texture(data, material);
    const auto texture = base == nullptr
                             ? std::nullopt
                             : data.index(*base, "index", data.count_of("textures"), where);
    return texture ? data.index(
                         data.entry("textures", *texture), "source", data.count_of("images"), where)
                   : std::nullopt;
}

} // namespace

std::uint32_t baked_picture(GltfData& data, std::size_t material, BakedPictures& pictures) {
    const auto image = image_of(data, material);
    return image ? pictures.picture(fmt::format("images[{}]", *image), data.image_bytes(*image))
                 : BakedPictures::none;
}

void take_picture(
    GltfData& data, std::size_t material, const std::filesystem::path& path, Material& made) {
    const auto image = image_of(data, material);
    if (!image) {
        return;
    }
    const Json uri = data.entry("images", *image).value("uri", Json());
    if (uri.is_string() && !uri.get_ref<const std::string&>().starts_with("data:")) {
        made.picture = picture_file(path, uri.get<std::string>()).string();
        return;
    }
    made.picture = fmt::format("picture-{}", *image);
    made.picture_bytes = std::make_shared<const std::string>(data.image_bytes(*image));
}

std::optional<std::size_t>
texture_accessor(GltfData& data, std::optional<std::size_t> material, const Json& attributes) {
    constexpr std::size_t max_sets = 8;
    const Json* base = material ? base_texture(data, *material) : nullptr;
    const std::size_t set =
        base == nullptr ? 0 : data.index(*base, "texCoord", max_sets, "materials").value_or(0);
    return data.index(
        attributes,
        fmt::format("TEXCOORD_{}", set).c_str(),
        data.count_of("accessors"),
        "attributes");
}

} // namespace octant::models::meshfile
