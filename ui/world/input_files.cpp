#include "ui/world/input_files.h"

#include "models/heights/map_inputs.h"
#include "sim/base/error.h"
#include "sim/base/file_status.h"
#include "sim/base/hash.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/order_cache_name.h"
#include "ui/settings/terrain_name.h"
#include "ui/world/referenced_files.h"
#include "visuals/groundfile/ground_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <span>

namespace octant::ui::world {

namespace {

namespace fs = std::filesystem;

/// Where a recording keeps copies of the files that its run read.
constexpr const char* inputs_folder = "inputs";

std::string absolute(const std::string& file) { return absolute_path(file).string(); }

std::string hash_of_file(const fs::path& file) {
    if (visuals::groundfile::is_ground_file(file)) {
        return fmt::format("{:016x}", visuals::groundfile::hash_of_ground(file));
    }
    std::ifstream in(file, std::ios::binary);
    if (!in || is_folder(file)) { throw_error_in(file, "expected a file that can be read, got none"); }
    Hash hash;
    std::vector<char> piece(std::size_t{1} << 20);
    while (in) {
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        hash.add(std::as_bytes(std::span(piece.data(), static_cast<std::size_t>(in.gcount()))));
    }
    return fmt::format("{:016x}", hash.value());
}

bool is_live(const settings::RunSettings& settings) { return settings.path.name == settings::live_path; }

bool is_folder_or_pattern(const std::string& name) {
    return models::heights::is_many(name) && !models::heights::is_subdataset_name(name);
}

void make_path_absolute(std::string& path, const std::string& aircraft) {
    if (base::path_file(path, aircraft) == path) { path = absolute(path); }
}

/// The ways from a model's folder to those of the files it names that lie there or below.
std::vector<fs::path> relative_paths_below(const fs::path& model, const std::vector<fs::path>& named) {
    const fs::path folder = fs::absolute(model).lexically_normal().parent_path();
    std::vector<fs::path> ways;
    for (const fs::path& file : named) {
        const fs::path way = file.lexically_relative(folder);
        if (!way.empty() && *way.begin() != "..") { ways.push_back(way); }
    }
    return ways;
}

/// Files in the order in which they are found, each once, with names that differ.
struct Collector {
    std::vector<InputFile> files;

    bool has(const fs::path& file) const { return std::ranges::find(files, file, &InputFile::file) != files.end(); }

    bool has_name(const std::string& name) const {
        return std::ranges::find(files, name, &InputFile::name) != files.end();
    }

    /// A folder in the recording in which nothing of the file's name and the others lies yet.
    fs::path folder_for(const fs::path& file, std::vector<fs::path> names) const {
        names.push_back(file.filename());
        fs::path folder = inputs_folder;
        const auto is_taken = [&](const fs::path& name) { return has_name((folder / name).string()); };
        for (int i = 2; std::ranges::any_of(names, is_taken); ++i) {
            folder = fs::path(inputs_folder) / std::to_string(i);
        }
        return folder;
    }

    /// Adds a file, with room for others beside it; false where it was there already.
    bool add(const fs::path& file, const std::vector<fs::path>& others = {}) {
        if (has(file)) { return false; }
        const fs::path own = base::data_folder();
        if (file.parent_path().parent_path() == own) {
            files.push_back({file, file.lexically_relative(own).string(), FileLocation::BuiltIn});
        } else {
            files.push_back({file, (folder_for(file, others) / file.filename()).string(), FileLocation::Copied});
        }
        return true;
    }

    void add_external(const fs::path& file) {
        if (!has(file)) { files.push_back({file, file.filename().string(), FileLocation::External}); }
    }

    /// An aircraft and the files that it names: those beside it or in folders below are kept with it.
    void add_model(const fs::path& file) {
        const std::vector<fs::path> named = referenced_files(file);
        const std::vector<fs::path> below = relative_paths_below(file, named);
        if (!add(file, below)) { return; }
        const InputFile model = files.back();
        for (const fs::path& way : below) {
            const std::string location = (fs::path(model.name).parent_path() / way).string();
            if (!has_name(location)) { files.push_back({file.parent_path() / way, location, model.location}); }
        }
        for (const fs::path& other : named) {
            if (std::ranges::none_of(below, [&](const fs::path& way) {
                    return (fs::absolute(file).parent_path() / way).lexically_normal() == other;
                })) {
                add_external(other);
            }
        }
    }
};

/// Whether the coordinate system of the ground's files stands in a file, as a .prj does.
bool names_system_file(const settings::RunSettings& settings) {
    return settings.path.terrain_system && is_file(*settings.path.terrain_system);
}

} // namespace

std::vector<fs::path> ground_files(const std::string& terrain) {
    if (settings::is_built_in_ground(terrain)) { return {}; }
    if (settings::is_imported_ground(terrain)) { return {terrain}; }
    std::vector<fs::path> files;
    for (const fs::path& map : models::heights::map_inputs({terrain})) {
        for (const fs::path& file : models::heights::referenced_files(map)) {
            if (is_file(file) && std::ranges::find(files, file) == files.end()) { files.push_back(file); }
        }
    }
    return files;
}

settings::RunSettings with_absolute_paths(settings::RunSettings settings) {
    // A name that is built in comes first everywhere, also where a file of that name lies about.
    const std::string pilot = settings::aircraft_shape(settings.path.aircraft.front());
    if (!is_live(settings)) { make_path_absolute(settings.path.name, pilot); }
    for (std::string& name : settings.path.aircraft) {
        settings::AircraftEntry flown = settings::parse_aircraft_entry(name);
        if (base::aircraft_file(flown.shape) == flown.shape) { flown.shape = absolute(flown.shape); }
        if (flown.path) { make_path_absolute(*flown.path, flown.shape); }
        name = settings::text_of(flown);
    }
    if (!settings::is_built_in_ground(settings.path.terrain) &&
        (is_file(settings.path.terrain) || is_folder_or_pattern(settings.path.terrain))) {
        settings.path.terrain = absolute(settings.path.terrain);
    }
    if (names_system_file(settings)) { settings.path.terrain_system = absolute(*settings.path.terrain_system); }
    if (settings.air.drape) { settings.air.drape = absolute(*settings.air.drape); }
    if (settings::is_order_cache_folder(settings.surface.order_cache)) {
        settings.surface.order_cache = absolute(settings.surface.order_cache);
    }
    return settings;
}

std::vector<InputFile> input_files(const settings::RunSettings& settings) {
    Collector found;
    if (!is_live(settings)) {
        const std::string pilot = settings::aircraft_shape(settings.path.aircraft.front());
        found.add(base::path_file(settings.path.name, pilot));
    }
    for (const std::string& name : settings.path.aircraft) {
        const settings::AircraftEntry flown = settings::parse_aircraft_entry(name);
        found.add_model(base::aircraft_file(flown.shape));
        if (flown.path) { found.add(base::path_file(*flown.path, flown.shape)); }
    }
    for (const fs::path& file : ground_files(settings.path.terrain)) { found.add_external(file); }
    if (names_system_file(settings)) { found.add(*settings.path.terrain_system); }
    if (settings.air.drape) { found.add_external(*settings.air.drape); }
    return std::move(found.files);
}

std::vector<std::pair<std::string, std::string>> input_hashes(const settings::RunSettings& settings) {
    std::vector<std::pair<std::string, std::string>> hashes;
    for (const InputFile& input : input_files(settings)) { hashes.emplace_back(input.name, hash_of_file(input.file)); }
    return hashes;
}

settings::RunSettings settings_in_recording(const settings::RunSettings& settings, const fs::path& folder) {
    const std::vector<InputFile> inputs = input_files(settings);
    const fs::path from = fs::absolute(folder).lexically_normal();
    for (const InputFile& input : inputs) {
        const fs::path way = absolute_path(input.file).lexically_relative(from / inputs_folder);
        if (input.location == FileLocation::External && !way.empty() && *way.begin() != "..") {
            throw Error(fmt::format("--record: expected another folder than that of the run's own '{}', got '{}'",
                printable(input.name), printable(folder.string())));
        }
    }
    const auto rename = [&](std::string& name) {
        const auto found =
            std::ranges::find_if(inputs, [&](const InputFile& input) { return input.file == fs::path(name); });
        if (found != inputs.end() && found->location == FileLocation::Copied) {
            name = found->name;
        } else if ((found != inputs.end() && found->location == FileLocation::External) ||
                   (found == inputs.end() && fs::path(name).is_absolute())) {
            name = fs::absolute(name).lexically_normal().lexically_proximate(from).string();
        }
    };
    settings::RunSettings renamed = settings;
    rename(renamed.path.name);
    for (std::string& name : renamed.path.aircraft) {
        settings::AircraftEntry flown = settings::parse_aircraft_entry(name);
        rename(flown.shape);
        if (flown.path) { rename(*flown.path); }
        name = settings::text_of(flown);
    }
    rename(renamed.path.terrain);
    if (names_system_file(settings)) { rename(*renamed.path.terrain_system); }
    if (renamed.air.drape) { rename(*renamed.air.drape); }
    if (settings::is_order_cache_folder(renamed.surface.order_cache)) {
        renamed.surface.order_cache = (fs::path(inputs_folder) / "orders").string();
    }
    return renamed;
}

CopiedFiles files_to_copy(const settings::RunSettings& settings, const std::vector<fs::path>& order_files) {
    constexpr std::size_t largest_bytes = std::size_t{1} << 30;
    CopiedFiles location;
    for (const InputFile& input : input_files(settings)) {
        if (input.location == FileLocation::Copied) {
            location.emplace_back(input.name, read_file(input.file, largest_bytes));
        }
    }
    for (const fs::path& file : order_files) {
        if (is_file(file)) { // one that could not be written was told
            location.emplace_back(
                (fs::path(inputs_folder) / "orders" / file.filename()).string(), read_file(file, largest_bytes));
        }
    }
    return location;
}

} // namespace octant::ui::world
