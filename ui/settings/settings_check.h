#pragma once

#include "ui/settings/settings.h"
#include "visuals/scene/settings.h"

#include <string>

namespace octant::ui::settings {

// Checks of settings that need nothing else, such as the world that is loaded for them.

/// Throws Error where settings contradict each other or a number is not one of those that its setting takes. Reads the
/// first bytes of a terrain file.
void check_settings(const RunSettings& settings);

/// Throws Error for eye points that the view does not take. check_settings() includes it.
void check_eye_point(const visuals::scene::ViewSettings& view);

/// Whether a name stands for a ground of the program's own, also where a file of that name exists.
bool is_built_in_ground(const std::string& name);

/// Whether a name is that of a file of imported ground. Reads the first bytes of the file.
bool is_imported_ground(const std::string& name_or_file);

/// Whether this built-in ground consists of polygons or of nothing: it has no levels of detail.
bool has_no_detail_levels(const std::string& terrain);

} // namespace octant::ui::settings
