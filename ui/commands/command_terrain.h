#pragma once

#include "ui/commands/option.h"
#include "ui/settings/settings.h"
#include "ui/terrain/ground_view.h"

#include <vector>

namespace octant::ui::commands {

// Rows that commands about one mesh of a terrain share. Each adds to a command's table.

/// What map files do not say: --terrain-spacing, --height-scale, --terrain-system, --void and
/// --band. Every command that reads maps has them.
void add_file_options(std::vector<Option>& table, models::heights::ImportOptions& files);
void add_file_options(std::vector<Option>& table, settings::PathSettings& path);

/// The terrain, and what its files do not say.
void add_terrain_options(std::vector<Option>& table, terrain::GroundViewOptions& options);

/// Eye, look, size and field of view, and --curved.
void add_view_options(std::vector<Option>& table, terrain::GroundViewOptions& options);

/// What decides where the mesh is fine.
void add_mesh_options(std::vector<Option>& table, terrain::GroundMeshOptions& options);

/// How fine it is: --error-px, --triangles and --resolution-c.
void add_detail_options(std::vector<Option>& table, terrain::GroundMeshOptions& options);

Option curved_option(bool& curved);

} // namespace octant::ui::commands
