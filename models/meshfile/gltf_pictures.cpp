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

} // namespace

GltfPicture picture_of_material(GltfData& data, std::size_t material, BakedPictures& pictures) {
    const std::string where = fmt::format("materials[{}]", material);
    const Json* rough = object_in(data.entry("materials", material), "pbrMetallicRoughness");
    const Json* base = rough != nullptr ? object_in(*rough, "baseColorTexture") : nullptr;
    if (base == nullptr) {
        return {};
    }
    const auto texture = data.index(*base, "index", data.count_of("textures"), where);
    if (!texture) {
        return {};
    }
    const auto image =
        data.index(data.entry("textures", *texture), "source", data.count_of("images"), where);
    if (!image) {
        return {};
    }
    constexpr std::size_t most_sets = 8;
    const std::size_t set = data.index(*base, "texCoord", most_sets, where).value_or(0);
    const std::string name = fmt::format("images[{}]", *image);
    return {pictures.picture(name, data.image_bytes(*image)), fmt::format("TEXCOORD_{}", set)};
}

std::vector<glm::vec2> places_on_picture(
    GltfData& data, const Json& attributes, const GltfPicture& picture, std::size_t count) {
    std::vector<glm::vec2> places;
    if (picture.number == BakedPictures::none) {
        return places;
    }
    const auto index =
        data.index(attributes, picture.places.c_str(), data.count_of("accessors"), "attributes");
    if (!index) {
        return places;
    }
    const GltfNumbers numbers = data.accessor(*index);
    if (numbers.parts() != 2 || numbers.count() != count) {
        return places;
    }
    for (std::size_t i = 0; i < count; ++i) {
        places.emplace_back(
            static_cast<float>(numbers.at(i, 0)), static_cast<float>(numbers.at(i, 1)));
    }
    return places;
}

} // namespace octant::models::meshfile
