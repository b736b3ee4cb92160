#include "ui/base/data_files.h"

#include "sim/base/error.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace octant::ui::base {

namespace {

namespace fs = std::filesystem;

bool holds_data(const fs::path& folder) {
    std::error_code ignored;
    return fs::is_regular_file(folder / "models" / "f15.obj", ignored) &&
           fs::is_directory(folder / "flightpaths", ignored);
}

bool looks_like_file(const std::string& name) {
    std::error_code ignored;
    return name.find('/') != std::string::npos || name.find('.') != std::string::npos ||
           fs::is_regular_file(name, ignored);
}

bool among(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

fs::path data_folder() {
    std::vector<fs::path> places;
    if (const char* named = std::getenv("OCTANT_DATA"); named != nullptr && *named != '\0') {
        places.emplace_back(named);
    }
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    places.push_back(program.parent_path().parent_path() / "share" / "octant");
    places.emplace_back(OCTANT_SOURCE_DIR);
    for (const fs::path& place : places) {
        if (holds_data(place)) {
            return place;
        }
    }
    std::vector<std::string> names;
    std::transform(places.begin(), places.end(), std::back_inserter(names), [](const fs::path& p) {
        return p.string();
    });
    throw Error(fmt::format(
        "expected the program's models and paths in one of {}; set OCTANT_DATA to their folder",
        fmt::join(names, ", ")));
}

fs::path aircraft_file(const std::string& name_or_file) {
    static const std::vector<std::string> names = {"f15", "500md", "concave"};
    if (among(names, name_or_file)) {
        return data_folder() / "models" / (name_or_file + ".obj");
    }
    if (looks_like_file(name_or_file)) {
        return name_or_file;
    }
    throw Error(fmt::format(
        "aircraft: expected {} or an OBJ file, got '{}'",
        fmt::join(names, ", "),
        printable(name_or_file)));
}

std::vector<std::string> built_in_paths() {
    return {"straight", "jinking", "pop-up", "turn"};
}

fs::path path_file(const std::string& name_or_file, const std::string& aircraft) {
    if (among(built_in_paths(), name_or_file)) {
        const std::string flown_by = aircraft == "500md" ? "500md" : "f15";
        return data_folder() / "flightpaths" / fmt::format("{}-{}.toml", flown_by, name_or_file);
    }
    if (looks_like_file(name_or_file)) {
        return name_or_file;
    }
    throw Error(fmt::format(
        "path: expected {}, a .toml or a .csv file, got '{}'",
        fmt::join(built_in_paths(), ", "),
        printable(name_or_file)));
}

} // namespace octant::ui::base
