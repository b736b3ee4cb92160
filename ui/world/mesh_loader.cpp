#include "ui/world/mesh_loader.h"

#include "models/meshfile/mesh_file.h"
#include "models/polygons/mesh_polygons.h"
#include "models/polygons/polygon_model.h"
#include "models/procedural/background60.h"
#include "models/procedural/globe.h"
#include "models/procedural/machined_part.h"
#include "models/procedural/procedural_models.h"
#include "sim/base/file_status.h"
#include "ui/base/data_files.h"
#include "ui/world/library_mesh.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>

namespace octant::ui::world {

std::string built_in_mesh_names() {
    return fmt::format("globe, torus, machined-part, {}", fmt::join(base::built_in_models, ", "));
}

models::TriangleMesh load_mesh(const std::string& name_or_file, const models::meshfile::ReadOptions& options) {
    if (!path_exists(name_or_file)) {
        if (name_or_file == "globe") { return models::procedural::globe(); }
        if (name_or_file == "machined-part") { return models::procedural::machined_part(); }
        if (name_or_file == "torus") { return models::polygons::mesh_from_polygons(models::procedural::torus()); }
        if (std::ranges::find(base::built_in_models, name_or_file) != base::built_in_models.end()) {
            return models::meshfile::read_mesh(base::aircraft_file(name_or_file), options);
        }
    }
    return is_library_file(name_or_file) ? read_library_mesh(name_or_file, options)
                                         : models::meshfile::read_mesh(name_or_file, options);
}

} // namespace octant::ui::world
