#include "ui/settings/terrain_name.h"

#include "ui/settings/path_fields.h"
#include "visuals/groundfile/ground_file.h"

#include <algorithm>

namespace octant::ui::settings {

bool is_built_in_ground(const std::string& name) {
    return std::ranges::find(built_in_terrains, name) != built_in_terrains.end();
}

bool is_imported_ground(const std::string& name_or_file) {
    return !is_built_in_ground(name_or_file) && visuals::groundfile::is_ground_file(name_or_file);
}

bool has_no_detail_levels(const std::string& terrain) { return terrain == "background60" || terrain == "none"; }

} // namespace octant::ui::settings
