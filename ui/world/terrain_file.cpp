#include "ui/world/terrain_file.h"

#include "models/heights/height_field_import.h"
#include "models/heights/map_inputs.h"
#include "sim/base/error.h"
#include "ui/world/ground_cache.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::world {

models::heights::HeightField
load_height_field(const std::string& name_or_file, const models::heights::ImportOptions& options) {
    models::heights::check_coordinate_system(options);
    if (auto made = built_in_ground(name_or_file)) {
        return std::move(*made);
    }
    std::error_code ignored;
    const bool is_file = name_or_file.find('/') != std::string::npos ||
                         name_or_file.find('.') != std::string::npos ||
                         std::filesystem::exists(name_or_file, ignored) ||
                         models::heights::is_many(name_or_file);
    if (!is_file) {
        throw Error(fmt::format(
            "terrain: expected hills, canyon or a file, got '{}'", printable(name_or_file)));
    }
    models::heights::HeightField field =
        models::heights::read_height_field(models::heights::map_inputs({name_or_file}), options);
    if (models::heights::is_many(name_or_file)) {
        field.name = std::filesystem::path(name_or_file).filename().string();
    }
    return field;
}

std::optional<std::string> few_samples_note(
    const std::string& name,
    const glm::ivec2& samples,
    int asked_triangles,
    const std::string& option) {
    const std::int64_t most = std::int64_t{2} * (samples.x - 1) * (samples.y - 1);
    if (most >= asked_triangles) {
        return std::nullopt;
    }
    return fmt::format(
        "{}: {} x {} samples make at most {} triangles, and {} are asked for: {}",
        name,
        samples.x,
        samples.y,
        most,
        asked_triangles,
        option);
}

std::optional<std::string>
low_eye_note(const glm::dvec3& eye_m, const std::optional<double>& ground_m) {
    if (!ground_m || eye_m.z >= *ground_m) {
        return std::nullopt;
    }
    constexpr double clear_m = 2.0;
    return fmt::format(
        "--eye {0:g},{1:g},{2:g} lies {3:.1f} m under the ground, which is {4:.1f} m high there: "
        "--eye "
        "{0:g},{1:g},{5:.0f} lies above it",
        eye_m.x,
        eye_m.y,
        eye_m.z,
        *ground_m - eye_m.z,
        *ground_m,
        std::ceil(*ground_m + clear_m));
}

models::heights::ImportOptions import_options(const settings::PathSettings& settings) {
    return {
        settings.terrain_spacing_m,
        settings.terrain_height_scale,
        settings.terrain_system,
        settings.terrain_voids,
        settings.terrain_band};
}

} // namespace octant::ui::world
