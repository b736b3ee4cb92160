#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"
#include "ui/settings/settings.h"

#include <string>

namespace octant::ui::world {

/// A height field by name: hills, canyon, or maps that GDAL reads, as models::heights::map_inputs
/// takes them. Throws Error for a name that is neither, listing the built-in ones.
models::heights::HeightField
load_height_field(const std::string& name_or_file, const models::heights::ImportOptions& options);

/// What settings say of files that do not say it themselves.
models::heights::ImportOptions import_options(const settings::PathSettings& settings);

} // namespace octant::ui::world
