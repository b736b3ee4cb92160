#pragma once

#include "models/meshfile/baked_pictures.h"
#include "models/meshfile/gltf_data.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace octant::models::meshfile {

/// A material's base colour picture: its number, and which of a primitive's lists of places is its.
struct GltfPicture {
    std::uint32_t number = BakedPictures::none;
    std::string places; ///< "TEXCOORD_0"
};

/// Reads the picture of a material, once. What cannot be read is noted and left out.
GltfPicture picture_of_material(GltfData& data, std::size_t material, BakedPictures& pictures);

/// A primitive's places on its picture, one a vertex; empty where it has none of `count`.
std::vector<glm::vec2> places_on_picture(
    GltfData& data, const Json& attributes, const GltfPicture& picture, std::size_t count);

} // namespace octant::models::meshfile
