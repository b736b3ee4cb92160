#include "ui/world/mesh_input.h"

#include "models/made/made_globe.h"
#include "models/made/made_part.h"
#include "models/made/made_up.h"
#include "models/meshfile/mesh_file.h"
#include "models/polygons/mesh_polygons.h"
#include "ui/base/data_files.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace octant::ui::world {

models::TriangleMesh read_mesh_input(const std::string& name_or_file) {
    constexpr std::array<std::string_view, 3> shipped{"f15", "500md", "concave"};
    if (!std::filesystem::exists(name_or_file)) {
        if (name_or_file == "globe") {
            return models::made::globe();
        }
        if (name_or_file == "machined-part") {
            return models::made::machined_part();
        }
        if (name_or_file == "torus") {
            return models::polygons::as_triangles(models::made::torus());
        }
        if (std::ranges::find(shipped, name_or_file) != shipped.end()) {
            return models::meshfile::read_mesh(base::aircraft_file(name_or_file));
        }
    }
    return models::meshfile::read_mesh(name_or_file);
}

} // namespace octant::ui::world
