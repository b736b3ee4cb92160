#pragma once

#include "models/heights/height_field.h"
#include "ui/base/json_value.h"
#include "ui/commands/command.h"

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::commands {

// Commands below `octant terrain` that have a file of their own.

Command terrain_import_command();
Command terrain_mesh_command();
Command terrain_error_command();
Command terrain_query_command();
Command terrain_check_command();

/// Adds how far the system of a ground from files is from true at its corners, or what is taken for granted without
/// one, and how far the ground lies from the files, as far as either is known.
void add_accuracy(const std::optional<models::heights::CoordinateSystem>& system, const glm::dvec2& half_extent_m,
    const std::optional<models::heights::HeightDeviation>& deviation, base::JsonValue& results);

/// What notes say.
std::vector<std::string> note_texts(const std::vector<models::heights::MapNote>& notes);

/// Shows the figures of a file made by import, after checking all of it where `verify`. Throws Error for a damaged one.
void show_ground_file(const std::string& file, bool verify, bool json);

} // namespace octant::ui::commands
