#include "ui/mesh_input.h"

#include "models/made_globe.h"
#include "models/made_part.h"
#include "models/made_up.h"
#include "models/mesh_polygons.h"
#include "models/meshfile/mesh_file.h"
#include "ui/data_files.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace octant::ui {

models::TriangleMesh read_mesh_input(const std::string& name_or_file) {
    constexpr std::array<std::string_view, 3> shipped{"f15", "500md", "concave"};
    if (!std::filesystem::exists(name_or_file)) {
        if (name_or_file == "globe") {
            return models::globe();
        }
        if (name_or_file == "machined-part") {
            return models::machined_part();
        }
        if (name_or_file == "torus") {
            return models::as_triangles(models::torus());
        }
        if (std::ranges::find(shipped, name_or_file) != shipped.end()) {
            return models::meshfile::read_mesh(aircraft_file(name_or_file));
        }
    }
    return models::meshfile::read_mesh(name_or_file);
}

} // namespace octant::ui
