#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"
#include "ui/settings/settings.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace octant::ui::world {

/// Built-in ground by name, "hills" or "canyon", as models::procedural::procedural_terrain makes it; nothing for
/// another name. It is kept in the user's cache, and read from there in a twentieth of the time. A file that is damaged
/// or of another version is replaced; a cache that cannot be made, read or written is done without.
std::optional<models::heights::HeightField> built_in_ground(std::string_view name);

/// A height field by name: hills, canyon, or maps that GDAL reads, as models::heights::map_inputs takes them. Throws
/// Error for a name that is neither, listing the built-in ones.
models::heights::HeightField load_height_field(
    const std::string& name_or_file, const models::heights::ImportOptions& options);

/// What a person should be told who asks for more triangles than the samples of a ground make; nothing where they
/// suffice. `option`: one that cures it.
std::optional<std::string> few_samples_note(
    const std::string& name, const glm::ivec2& samples, int asked_triangles, const std::string& option);

/// What a person should be told whose eye point lies under the ground, which is so high there; nothing where it does
/// not.
std::optional<std::string> low_eye_note(const glm::dvec3& eye_m, const std::optional<double>& ground_m);

/// What settings say of files that do not say it themselves.
models::heights::ImportOptions import_options(const settings::PathSettings& settings);

} // namespace octant::ui::world
