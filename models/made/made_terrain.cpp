#include "models/made/made_terrain.h"

namespace octant::models::made {

std::optional<heights::HeightField>
made_terrain(std::string_view name, const MadeOptions& options) {
    if (name == "hills") {
        return made_hills(options);
    }
    if (name == "canyon") {
        return made_canyon(options);
    }
    return std::nullopt;
}

} // namespace octant::models::made
