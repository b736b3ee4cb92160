#pragma once

#include "models/heights/height_field.h"

#include <optional>
#include <string_view>

namespace octant::ui::world {

/// Built-in ground by name, "hills" or "canyon", as models::procedural::procedural_terrain makes it; nothing
/// for another name. It is kept in the user's cache, and read from there in a twentieth of the
/// time. A file that is damaged or of another version is replaced; a cache that cannot be made,
/// read or written is done without.
std::optional<models::heights::HeightField> built_in_ground(std::string_view name);

} // namespace octant::ui::world
