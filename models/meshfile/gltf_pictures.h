#pragma once

#include "models/material.h"
#include "models/meshfile/baked_pictures.h"
#include "models/meshfile/gltf_data.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace octant::models::meshfile {

/// The number of a material's base colour picture among `pictures`, read once. What cannot be read
/// is noted and left out.
std::uint32_t baked_picture(GltfData& data, std::size_t material, BakedPictures& pictures);

/// Names a material's base colour picture in `made`: the file, or the bytes in the file at `path`.
void take_picture(
    GltfData& data, std::size_t material, const std::filesystem::path& path, Material& made);

/// The accessor of a primitive's texture coordinates: those of its material's base colour picture,
/// the first ones where there is none; nothing where the primitive has none.
std::optional<std::size_t>
texture_accessor(GltfData& data, std::optional<std::size_t> material, const Json& attributes);

} // namespace octant::models::meshfile
