#include "ui/world/terrain_file.h"

#include "models/heights/height_field_import.h"
#include "models/heights/map_inputs.h"
#include "models/procedural/procedural_terrain.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/user_folders.h"
#include "visuals/ordercache/binary_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace octant::ui::world {

// A kept file is: signature, version, columns, rows, spacing, heights, and a checksum of all bytes before it.

namespace fs = std::filesystem;
using models::heights::HeightField;
using visuals::ordercache::BinaryReader;
using visuals::ordercache::BinaryWriter;

namespace {

constexpr std::array<std::string_view, 2> built_in{"hills", "canyon"};
/// "octheigh" as a little-endian machine writes it; another machine's files read as another kind.
constexpr std::uint64_t height_signature = 0x686769656874636fULL;

std::string height_bytes(const HeightField& field) {
    std::vector<float> heights_m;
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) { heights_m.push_back(field.height_m(column, row)); }
    }
    BinaryWriter out;
    out.number(height_signature);
    out.number(models::procedural::procedural_version);
    out.number(field.columns());
    out.number(field.rows());
    out.number(field.spacing_m());
    out.array(heights_m);
    out.number(checksum_of(out.bytes()));
    return out.bytes();
}

/// Nothing where the bytes are no kept heights. Throws Error where they end too soon.
std::optional<HeightField> field_of(std::string_view bytes) {
    BinaryReader in(bytes);
    if (in.number<std::uint64_t>() != height_signature ||
        in.number<std::uint32_t>() != models::procedural::procedural_version) {
        return std::nullopt;
    }
    const int columns = in.number<int>();
    const int rows = in.number<int>();
    const double spacing_m = in.number<double>();
    std::vector<float> heights_m = in.array<float>();
    const std::string_view summed = bytes.substr(0, bytes.size() - in.bytes_left());
    const auto sum = in.number<std::uint64_t>();
    const models::procedural::ProceduralTerrainOptions defaults;
    const auto side = static_cast<std::size_t>(defaults.size);
    const bool is_field = columns == defaults.size && rows == defaults.size && spacing_m == defaults.spacing_m &&
                          heights_m.size() == side * side &&
                          std::ranges::all_of(heights_m, [](float m) { return std::isfinite(m); });
    if (sum != checksum_of(summed) || in.bytes_left() > 0 || !is_field) { return std::nullopt; }
    return HeightField(columns, rows, spacing_m, std::move(heights_m));
}

/// Nothing where there is no file that can be used.
std::optional<HeightField> read_cached_field(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) { return std::nullopt; }
    try {
        return field_of(read_file(file));
    } catch (const Error&) { return std::nullopt; }
}

void write_cached_field(const fs::path& file, const HeightField& field) {
    std::error_code failed;
    fs::create_directories(file.parent_path(), failed);
    if (failed) { return; }
    try {
        write_file(file, height_bytes(field));
    } catch (const Error&) { // Made anew the next time.
    }
}

} // namespace

std::optional<HeightField> built_in_ground(std::string_view name) {
    if (std::ranges::find(built_in, name) == built_in.end()) { return std::nullopt; }
    const fs::path cache = base::cache_folder();
    const fs::path file = cache / "ground" / fmt::format("{}.heights", name);
    std::optional<HeightField> field = cache.empty() ? std::nullopt : read_cached_field(file);
    if (!field) {
        field = models::procedural::procedural_terrain(name);
        if (!cache.empty()) { write_cached_field(file, *field); }
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

std::optional<std::string> low_eye_note(const glm::dvec3& eye_m, const std::optional<double>& ground_m) {
    if (!ground_m || eye_m.z >= *ground_m) { return std::nullopt; }
    constexpr double clear_m = 2.0;
    return fmt::format("--eye {0:g},{1:g},{2:g} lies {3:.1f} m under the ground, which is {4:.1f} m high there: "
                       "--eye "
                       "{0:g},{1:g},{5:.0f} lies above it",
        eye_m.x, eye_m.y, eye_m.z, *ground_m - eye_m.z, *ground_m, std::ceil(*ground_m + clear_m));
}

models::heights::ImportOptions import_options(const settings::PathSettings& settings) {
    return {settings.terrain_spacing_m, settings.terrain_height_scale, settings.terrain_system, settings.terrain_voids,
        settings.terrain_band};
}

} // namespace octant::ui::world
