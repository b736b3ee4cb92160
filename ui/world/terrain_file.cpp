#include "ui/world/terrain_file.h"

#include "models/heights/height_field_import.h"
#include "models/made/made_terrain.h"
#include "sim/base/error.h"

#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::world {

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
