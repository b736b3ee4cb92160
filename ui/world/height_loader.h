#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"
#include "ui/settings/settings.h"
#include "ui/world/input_files.h"

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::world {

/// Built-in ground by name, "hills" or "canyon", as models::procedural::procedural_terrain makes it; nothing for
/// another name. It is cached in the user's cache folder; a damaged or outdated file is replaced, an unusable cache is
/// ignored.
std::optional<models::heights::HeightField> built_in_ground(std::string_view name);

/// A height field by name: hills, canyon, or maps that GDAL reads, as models::heights::map_inputs takes them. Throws
/// Error for a name that is neither, listing the built-in ones.
models::heights::HeightField load_height_field(
    const std::string& name_or_file, const models::heights::ImportOptions& options);

/// A note where more triangles are asked for than the samples of a ground make; nothing where they suffice. `option`:
/// what to change.
std::optional<std::string> few_samples_note(
    const std::string& name, const glm::ivec2& samples, int asked_triangles, const std::string& option);

/// The import options of the settings, for what a file does not say itself.
models::heights::ImportOptions import_options(const settings::PathSettings& settings);

/// Inputs of the heights of a ground: equal inputs give equal heights.
struct TerrainSources {
    /// As PathSettings has them.
    std::string terrain;
    models::heights::ImportOptions options;
    /// All files that the heights and their system come from; none for made ground.
    std::vector<FileMtime> files;

    bool operator==(const TerrainSources&) const = default;
};

/// Throws Error where there are no such files.
TerrainSources terrain_sources(const settings::PathSettings& settings);

} // namespace octant::ui::world
