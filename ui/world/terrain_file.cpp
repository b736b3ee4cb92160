#include "ui/world/terrain_file.h"

#include "models/heights/height_field_import.h"
#include "models/made/made_terrain.h"
#include "sim/base/error.h"
#include "visuals/terrain/ground_file.h"

#include <filesystem>
#include <fmt/format.h>

namespace octant::ui::world {

bool is_built_in_ground(const std::string& name) {
    return name == "hills" || name == "canyon" || name == "background60" || name == "none";
}

bool is_imported_ground(const std::string& name_or_file) {
    return !is_built_in_ground(name_or_file) && visuals::terrain::is_ground_file(name_or_file);
}

models::heights::HeightField load_height_field(const std::string& name_or_file, double spacing_m) {
    if (auto made = models::made::made_terrain(name_or_file, {})) {
        return std::move(*made);
    }
    std::error_code ignored;
    const bool is_file = name_or_file.find('/') != std::string::npos ||
                         name_or_file.find('.') != std::string::npos ||
                         std::filesystem::exists(name_or_file, ignored);
    if (!is_file) {
        throw Error(fmt::format(
            "terrain: expected hills, canyon or a file, got '{}'", printable(name_or_file)));
    }
    models::heights::ImportOptions options;
    options.spacing_m = spacing_m;
    return models::heights::read_height_field(name_or_file, options);
}

} // namespace octant::ui::world
