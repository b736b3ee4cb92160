#include "ui/world/input_files.h"

#include "models/heights/map_inputs.h"
#include "models/heights/raster_file.h"
#include "sim/base/error.h"
#include "sim/base/file_status.h"
#include "sim/base/hash.h"
#include "ui/base/data_files.h"
#include "ui/settings/terrain_name.h"
#include "visuals/groundfile/ground_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <span>

namespace octant::ui::world {

namespace {

namespace fs = std::filesystem;

std::string absolute(const std::string& file) {
    return absolute_path(file).string();
}

std::string hash_of_file(const fs::path& file) {
    if (visuals::groundfile::is_ground_file(file)) {
        return fmt::format("{:016x}", visuals::groundfile::hash_of_ground(file));
    }
    std::ifstream in(file, std::ios::binary);
    if (!in || is_folder(file)) {
        error_in(file, "expected a file that can be read, got none");
    }
    Hash hash;
    std::vector<char> piece(std::size_t{1} << 20);
    while (in) {
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        hash.add(std::as_bytes(std::span(piece.data(), static_cast<std::size_t>(in.gcount()))));
    }
    return fmt::format("{:016x}", hash.value());
}

bool is_live(const settings::RunSettings& settings) {
    return settings.path.name == settings::live_path;
}

bool is_folder_or_pattern(const std::string& name) {
    return models::heights::is_many(name) && !models::heights::is_name_within_file(name);
}

/// All files of this computer that the heights of a terrain come from.
std::vector<fs::path> ground_files(const std::string& terrain) {
    if (settings::is_built_in_ground(terrain)) {
        return {};
    }
    if (settings::is_imported_ground(terrain)) {
        return {terrain};
    }
    std::vector<fs::path> files;
    for (const fs::path& map : models::heights::map_inputs({terrain})) {
        for (const fs::path& file : models::heights::files_behind(map)) {
            if (is_file(file) && std::ranges::find(files, file) == files.end()) {
                files.push_back(file);
            }
        }
    }
    return files;
}

} // namespace

settings::RunSettings with_absolute_files(settings::RunSettings settings) {
    // A name that is built in comes first everywhere, also where a file of that name lies about.
    const std::string pilot = settings.path.aircraft.front();
    if (!is_live(settings) && base::path_file(settings.path.name, pilot) == settings.path.name) {
        settings.path.name = absolute(settings.path.name);
    }
    for (std::string& name : settings.path.aircraft) {
        if (base::aircraft_file(name) == name) {
            name = absolute(name);
        }
    }
    if (!settings::is_built_in_ground(settings.path.terrain) &&
        (is_file(settings.path.terrain) || is_folder_or_pattern(settings.path.terrain))) {
        settings.path.terrain = absolute(settings.path.terrain);
    }
    if (settings.air.drape) {
        settings.air.drape = absolute(*settings.air.drape);
    }
    if (settings.surface.order_cache) {
        settings.surface.order_cache = absolute(*settings.surface.order_cache);
    }
    return settings;
}

std::vector<std::pair<std::string, std::string>>
input_hashes(const settings::RunSettings& settings) {
    std::vector<fs::path> files;
    if (!is_live(settings)) {
        files.push_back(base::path_file(settings.path.name, settings.path.aircraft.front()));
    }
    for (const std::string& name : settings.path.aircraft) {
        files.push_back(base::aircraft_file(name));
        const fs::path materials = fs::path(files.back()).replace_extension(".mtl");
        if (is_file(materials)) {
            files.push_back(materials);
        }
    }
    const std::vector<fs::path> ground = ground_files(settings.path.terrain);
    files.insert(files.end(), ground.begin(), ground.end());
    if (settings.air.drape) {
        files.emplace_back(*settings.air.drape);
    }
    std::vector<std::pair<std::string, std::string>> hashes;
    for (const fs::path& file : files) {
        hashes.emplace_back(file.string(), hash_of_file(file));
    }
    return hashes;
}

} // namespace octant::ui::world
