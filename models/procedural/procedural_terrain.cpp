#include "models/procedural/procedural_terrain.h"

namespace octant::models::procedural {

std::optional<heights::HeightField> procedural_terrain(std::string_view name, const ProceduralTerrainOptions& options) {
    if (name == "hills") { return procedural_hills(options); }
    if (name == "canyon") { return procedural_canyon(options); }
    return std::nullopt;
}

} // namespace octant::models::procedural
