#pragma once

#include <string>

namespace octant::ui::settings {

/// Whether a name stands for a ground of the program's own, also where a file of that name exists.
bool is_built_in_ground(const std::string& name);

/// Whether a name is that of a file of imported ground. Reads the first bytes of the file.
bool is_imported_ground(const std::string& name_or_file);

/// Whether this built-in ground consists of polygons or of nothing: it has no levels of detail.
bool has_no_detail_levels(const std::string& terrain);

} // namespace octant::ui::settings
