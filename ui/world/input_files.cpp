#include "ui/world/input_files.h"

#include "models/heights/map_inputs.h"
#include "models/meshfile/flightgear_xml.h"
#include "models/meshfile/mesh_join.h"
#include "models/meshfile/picture_path.h"
#include "models/polygons/obj_reader.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"
#include "ui/base/data_files.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/settings.h"
#include "ui/settings/settings_check.h"
#include "ui/world/mesh_loader.h"
#include "visuals/groundfile/ground_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace octant::ui::world {

namespace fs = std::filesystem;

void add_mtime(const std::filesystem::path& file, std::vector<FileMtime>& mtimes) {
    std::error_code unknown;
    mtimes.push_back({file, std::filesystem::last_write_time(file, unknown)});
}

namespace {

constexpr std::size_t largest_model_bytes = std::size_t{1} << 30U;
constexpr std::size_t max_files = 2'000;

constexpr std::array<std::string_view, 12> picture_endings{
    ".png", ".jpg", ".jpeg", ".tga", ".bmp", ".dds", ".rgb", ".rgba", ".sgi", ".gif", ".webp", ".tif"};

bool is_picture(const fs::path& file) {
    return std::ranges::find(picture_endings, extension_of(file)) != picture_endings.end();
}

bool is_in_file_names(char c) {
    constexpr std::string_view others = "\"<>|*?=";
    return static_cast<unsigned char>(c) >= 0x20 && others.find(c) == others.npos;
}

/// Follows names from file to file.
class ReferenceCollector {
public:
    /// `pictures`: where those of an .ac file are looked for first; empty: beside it alone.
    void add_references(const fs::path& file, const fs::path& pictures = {}) {
        try {
            const std::string ending = extension_of(file);
            if (ending == ".ac") {
                add_ac3d_references(file, pictures);
            } else if (ending == ".obj") {
                add_obj_references(file);
            } else if (ending == ".acf") {
                add_xplane_references(file);
            } else if (ending == ".dnm") {
                add_ysflight_references(file);
            } else if (ending == ".mtl") {
                add_material_references(file);
            } else if (ending == ".gltf") {
                add_gltf_references(file);
            } else if (ending == ".wrl" || is_library_file(file)) {
                add_picture_names(file);
            } else if (ending == ".xml") {
                add_xml_references(file, models::meshfile::read_xml(file));
            }
        } catch (const Error&) { // the loader reports it
        }
    }

    std::vector<fs::path> files;

private:
    static std::string text_of(const fs::path& file) { return read_text_file(file, largest_model_bytes); }

    bool add(const fs::path& named) {
        std::error_code ignored;
        if (named.empty() || files.size() >= max_files || !fs::is_regular_file(named, ignored)) { return false; }
        const fs::path file = fs::absolute(named).lexically_normal();
        if (std::ranges::find(files, file) == files.end()) {
            files.push_back(file);
            add_references(file);
        }
        return true;
    }

    /// Looks for a picture as the readers of models/meshfile do.
    void add_picture(const fs::path& file, const std::string& name, const fs::path& pictures = {}) {
        if (!name.empty()) { add(models::meshfile::picture_file(file, name, pictures)); }
    }

    void add_ac3d_references(const fs::path& file, const fs::path& pictures) {
        const std::string text = text_of(file);
        TextScanner lines(file, text);
        while (lines.next_line()) {
            if (!lines.skip("texture")) { continue; }
            std::string name(lines.rest_of_line());
            std::erase(name, '"');
            add_picture(file, name, pictures);
        }
    }

    /// Pictures that a file of any format names somewhere: all texts that end as the names of pictures do and lead to
    /// one.
    void add_picture_names(const fs::path& file) {
        constexpr std::size_t longest_name = 260;
        const std::string text = text_of(file);
        const std::string lower = models::meshfile::lower_case(text);
        for (const std::string_view ending : picture_endings) {
            for (std::size_t at = lower.find(ending); at != lower.npos; at = lower.find(ending, at + 1)) {
                const std::size_t end = at + ending.size();
                std::size_t begin = at;
                while (begin > 0 && at - begin < longest_name && is_in_file_names(text[begin - 1])) { --begin; }
                const std::string name = text.substr(begin, end - begin);
                add_picture(file, models::meshfile::without_percents(name).value_or(name));
            }
        }
    }

    void add_obj_references(const fs::path& file) {
        TextScanner text = TextScanner::of_file(file);
        while (text.next_line()) {
            if (text.skip("TEXTURE")) { add_picture(file, std::string(text.rest_of_line())); } // of X-Plane's objects
            if (!text.skip("mtllib")) { continue; }
            for (const std::string_view word : text.words()) { add(file.parent_path() / std::string(word)); }
            add(file.parent_path() / std::string(text.rest_of_line())); // one name with blanks
        }
    }

    /// The objects of an X-Plane aircraft, each in a line P _obja/NUMBER/_v10_att_file_stl FILE.
    void add_xplane_references(const fs::path& file) {
        TextScanner text = TextScanner::of_file(file);
        while (text.next_line()) {
            if (text.skip("P") && text.word_or_end().ends_with("/_v10_att_file_stl")) {
                add((file.parent_path() / "objects" / text.rest_of_line()).lexically_normal());
            }
        }
    }

    void add_ysflight_references(const fs::path& file) {
        TextScanner text = TextScanner::of_file(file);
        while (text.next_line()) {
            if (!text.skip("FIL")) { continue; }
            std::string name(text.rest_of_line());
            std::erase(name, '"');
            add(file.parent_path() / fs::path(name).filename());
        }
    }

    void add_material_references(const fs::path& file) {
        const models::polygons::MtlFile read = models::polygons::read_mtl(file);
        for (const auto& [material, picture] : read.pictures) { add_picture(file, picture.file); }
        for (const auto& [material, picture] : read.emissive_pictures) { add_picture(file, picture); }
    }

    /// All that stands behind "uri", but data that stand there themselves.
    void add_gltf_references(const fs::path& file) {
        constexpr std::string_view key = "\"uri\"";
        const std::string text = text_of(file);
        for (std::size_t at = text.find(key); at != text.npos; at = text.find(key, at)) {
            at += key.size();
            const std::size_t open = text.find('"', at);
            const std::size_t close = open == text.npos ? open : text.find('"', open + 1);
            if (close == text.npos) { return; }
            if (text.compare(open + 1, 5, "data:") == 0) { continue; }
            const std::string name = text.substr(open + 1, close - open - 1);
            add_picture(file, models::meshfile::without_percents(name).value_or(name));
        }
    }

    void add_xml_references(const fs::path& file, const models::meshfile::XmlElement& element) {
        if (!element.include.empty()) { add(models::meshfile::flightgear_file(file, element.include)); }
        const fs::path pictures =
            models::meshfile::flightgear_pictures(file, std::string(element.text_of("texture-path")));
        for (const models::meshfile::XmlElement& child : element.children) {
            if (child.name == "path") {
                const fs::path named = models::meshfile::flightgear_file(file, child.text);
                add(named);
                if (!pictures.empty() && extension_of(named) == ".ac") { add_references(named, pictures); }
            } else if (child.name == "texture" && child.children.empty()) {
                add_picture(file, child.text);
            }
            add_xml_references(file, child);
        }
    }
};

} // namespace

std::vector<fs::path> referenced_files(const fs::path& model) {
    ReferenceCollector collector;
    collector.add_references(model);
    std::erase(collector.files, fs::absolute(model).lexically_normal());
    return std::move(collector.files);
}

namespace {

/// Where a recording keeps copies of the files that its run read.
constexpr const char* inputs_folder = "inputs";

std::string absolute(const std::string& file) { return absolute_path(file).string(); }

bool is_live(const settings::RunSettings& settings) { return settings.path.name == settings::live_path; }

bool is_folder_or_pattern(const std::string& name) {
    return models::heights::is_many(name) && !models::heights::is_subdataset_name(name);
}

void make_path_absolute(std::string& path, const std::string& aircraft) {
    if (base::path_file(path, aircraft) == path) { path = absolute(path); }
}

/// Relative paths, from a model's folder, of the files it names that are in that folder or below.
std::vector<fs::path> relative_paths_below(const fs::path& model, const std::vector<fs::path>& named) {
    const fs::path folder = fs::absolute(model).lexically_normal().parent_path();
    std::vector<fs::path> paths;
    for (const fs::path& file : named) {
        fs::path path = file.lexically_relative(folder);
        if (!path.empty() && *path.begin() != "..") { paths.push_back(std::move(path)); }
    }
    return paths;
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
            const bool is_below = std::ranges::any_of(below, [&](const fs::path& way) {
                return (fs::absolute(file).parent_path() / way).lexically_normal() == other;
            });
            // Readers find a picture beside the model by its name alone.
            const std::string beside = (fs::path(model.name).parent_path() / other.filename()).string();
            if (!is_below && is_picture(other) && model.location == FileLocation::Copied && !has_name(beside)) {
                files.push_back({other, beside, FileLocation::Copied});
            } else if (!is_below) {
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
    for (std::string& track : settings.path.tracks) { track = absolute(track); }
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

std::vector<InputFile> input_files(std::span<const settings::RunSettings> runs) {
    Collector found;
    for (const settings::RunSettings& settings : runs) {
        if (!is_live(settings)) {
            const std::string pilot = settings::aircraft_shape(settings.path.aircraft.front());
            found.add(base::path_file(settings.path.name, pilot));
        }
        for (const std::string& name : settings.path.aircraft) {
            const settings::AircraftEntry flown = settings::parse_aircraft_entry(name);
            found.add_model(base::aircraft_file(flown.shape));
            if (flown.path) { found.add(base::path_file(*flown.path, flown.shape)); }
        }
        for (const std::string& track : settings.path.tracks) { found.add(track); }
        for (const fs::path& file : ground_files(settings.path.terrain)) { found.add_external(file); }
        if (names_system_file(settings)) { found.add(*settings.path.terrain_system); }
        if (settings.air.drape) { found.add_external(*settings.air.drape); }
    }
    return std::move(found.files);
}

void rename_inputs(settings::RunSettings& settings, const std::function<void(std::string&)>& rename) {
    rename(settings.path.name);
    for (std::string& name : settings.path.aircraft) {
        settings::AircraftEntry flown = settings::parse_aircraft_entry(name);
        rename(flown.shape);
        if (flown.path) { rename(*flown.path); }
        name = settings::text_of(flown);
    }
    for (std::string& track : settings.path.tracks) { rename(track); }
    rename(settings.path.terrain);
    if (names_system_file(settings)) { rename(*settings.path.terrain_system); }
    if (settings.air.drape) { rename(*settings.air.drape); }
}

std::vector<std::pair<std::string, std::string>> input_hashes(const settings::RunSettings& settings) {
    std::vector<std::pair<std::string, std::string>> hashes;
    for (const InputFile& input : input_files(std::span(&settings, 1))) {
        hashes.emplace_back(input.name, hash_of_file(input.file));
    }
    return hashes;
}

settings::RunSettings settings_in_recording(const settings::RunSettings& settings, const fs::path& folder) {
    const std::vector<InputFile> inputs = input_files(std::span(&settings, 1));
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
    rename_inputs(renamed, rename);
    if (settings::is_order_cache_folder(renamed.surface.order_cache)) {
        renamed.surface.order_cache = (fs::path(inputs_folder) / "orders").string();
    }
    return renamed;
}

std::vector<std::pair<std::string, std::string>> files_to_copy(
    const settings::RunSettings& settings, const std::vector<fs::path>& order_files) {
    constexpr std::size_t largest_bytes = std::size_t{1} << 30;
    std::vector<std::pair<std::string, std::string>> copied;
    for (const InputFile& input : input_files(std::span(&settings, 1))) {
        if (input.location == FileLocation::Copied) {
            copied.emplace_back(input.name, read_file(input.file, largest_bytes));
        }
    }
    for (const fs::path& file : order_files) {
        if (is_file(file)) { // one that could not be written was reported
            copied.emplace_back(
                (fs::path(inputs_folder) / "orders" / file.filename()).string(), read_file(file, largest_bytes));
        }
    }
    return copied;
}

} // namespace octant::ui::world
