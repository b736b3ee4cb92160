#pragma once

#include "models/texture.h"

#include <string>
#include <string_view>

namespace octant::models::meshfile {

/// Whether bytes begin as those of a DDS file (DirectDraw Surface).
bool is_dds(std::string_view bytes);

/// The finest level of a DDS file: BC1 to BC5 (DXT1 to DXT5, ATI1, ATI2), also by their numbers in a DX10 header, and
/// pixels of 8 to 32 bits that are not compressed; of several faces or layers the first one. `name` is for messages.
/// Throws Error "name: expected ..., got ..." for other formats, sides above 16,384 texels and fewer bytes than the
/// size needs.
TextureLevel dds_level(const std::string& name, std::string_view bytes);

} // namespace octant::models::meshfile
