#include "ui/world/height_loader.h"

#include "models/heights/height_source.h"
#include "models/heights/map_inputs.h"
#include "models/procedural/procedural_terrain.h"
#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace octant::ui::world {

namespace fs = std::filesystem;
using models::heights::HeightField;

// Built-in heights are cached. A file in the cache is: signature, version, columns, rows, spacing, heights, and a
// checksum of all bytes before it.

namespace {

constexpr std::array<std::string_view, 2> built_in{"hills", "canyon"};

std::string height_bytes(const HeightField& field) {
    std::vector<float> heights_m;
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) { heights_m.push_back(field.height_m(column, row)); }
    }
    BinaryWriter out;
    out.put(field.columns());
    out.put(field.rows());
    out.put(field.spacing_m());
    out.put_list(heights_m);
    return out.take();
}

/// Throws Error unless these are the heights of a built-in ground.
HeightField take_heights(BinaryReader& in) {
    const int columns = in.take<int>();
    const int rows = in.take<int>();
    const double spacing_m = in.take<double>();
    std::vector<float> heights_m = in.take_list<float>("heights");
    const models::procedural::ProceduralTerrainOptions defaults;
    const auto side = static_cast<std::size_t>(defaults.size);
    in.check(columns == defaults.size && rows == defaults.size && spacing_m == defaults.spacing_m &&
                 heights_m.size() == side * side &&
                 std::ranges::all_of(heights_m, [](float m) { return std::isfinite(m); }),
        "heights of a built-in ground");
    return HeightField(columns, rows, spacing_m, std::move(heights_m));
}

} // namespace

std::optional<HeightField> built_in_ground(std::string_view name) {
    if (std::ranges::find(built_in, name) == built_in.end()) { return std::nullopt; }
    const bool has_cache = !base::cache_folder().empty();
    const fs::path folder = base::cache_folder() / "ground";
    const CacheFile cache{.cache = "ground cache",
        .file = folder / fmt::format("{}.heights", name),
        .kind = {.content = "heights", .signature = "octheigh", .version = models::procedural::procedural_version},
        .key = name};
    std::vector<std::string> unused_notes; // The heights are made again in a second.
    std::optional<HeightField> field;
    if (has_cache) { field = read_cache(cache, take_heights, unused_notes); }
    if (!field) {
        field = models::procedural::procedural_terrain(name);
        if (has_cache) {
            std::error_code ignored;
            fs::create_directories(folder, ignored);
            write_cache(cache, height_bytes(*field), unused_notes);
        }
    }
    field->name = name;
    return field;
}

models::heights::HeightField load_height_field(
    const std::string& name_or_file, const models::heights::ImportOptions& options) {
    models::heights::check_coordinate_system(options);
    if (auto made = built_in_ground(name_or_file)) { return std::move(*made); }
    std::error_code ignored;
    const bool is_file = name_or_file.find('/') != std::string::npos || name_or_file.find('.') != std::string::npos ||
                         std::filesystem::exists(name_or_file, ignored) || models::heights::is_many(name_or_file);
    if (!is_file) {
        throw Error(fmt::format("terrain: expected hills, canyon or a file, got '{}'", printable(name_or_file)));
    }
    models::heights::HeightField field =
        models::heights::read_height_field(models::heights::map_inputs({name_or_file}), options);
    if (models::heights::is_many(name_or_file)) {
        field.name = std::filesystem::path(name_or_file).filename().string();
    }
    return field;
}

std::optional<std::string> few_samples_note(
    const std::string& name, const glm::ivec2& samples, int asked_triangles, const std::string& option) {
    const std::int64_t most = std::int64_t{2} * (samples.x - 1) * (samples.y - 1);
    if (most >= asked_triangles) { return std::nullopt; }
    return fmt::format("{}: {} x {} samples make at most {} triangles, and {} are asked for: {}", name, samples.x,
        samples.y, most, asked_triangles, option);
}

models::heights::ImportOptions import_options(const settings::PathSettings& settings) {
    return {settings.terrain_spacing_m, settings.terrain_height_scale, settings.terrain_system, settings.terrain_voids,
        settings.terrain_band};
}

TerrainSources terrain_sources(const settings::PathSettings& settings) {
    TerrainSources inputs{.terrain = settings.terrain, .options = import_options(settings), .files = {}};
    for (const std::filesystem::path& file : ground_files(settings.terrain)) { add_mtime(file, inputs.files); }
    std::error_code none;
    const std::optional<std::string>& system = inputs.options.system;
    if (system && std::filesystem::is_regular_file(*system, none)) { add_mtime(*system, inputs.files); }
    return inputs;
}

} // namespace octant::ui::world
