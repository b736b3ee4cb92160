#include "ui/base/data_files.h"

#include "sim/base/error.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <link.h>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::base {

namespace fs = std::filesystem;

namespace {

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

/// A program in PREFIX/bin, or the library in PREFIX/lib or PREFIX/lib/x86_64-linux-gnu.
constexpr std::size_t most_places = 3;

/// The program, or the shared library where this code is part of that.
fs::path file_of_this_code() {
    Dl_info info{};
    void* found = nullptr;
    const bool is_known =
        dladdr1(reinterpret_cast<const void*>(&file_of_this_code), &info, &found, RTLD_DL_LINKMAP) != 0;
    const std::string_view library = is_known ? static_cast<const link_map*>(found)->l_name : "";
    std::error_code ignored;
    return library.empty() ? fs::read_symlink("/proc/self/exe", ignored) : fs::canonical(library, ignored);
}

[[noreturn]] void throw_unknown_aircraft(const std::string& name) {
    throw Error(fmt::format(
        "aircraft: expected {} or an OBJ file, got '{}'", fmt::join(built_in_models, ", "), printable(name)));
}

} // namespace

fs::path data_folder() {
    std::vector<fs::path> candidates;
    if (const char* named = std::getenv("OCTANT_DATA"); named != nullptr && *named != '\0') {
        candidates.emplace_back(named);
    }
    const fs::path own_folder = file_of_this_code().parent_path();
    for (fs::path above = own_folder.parent_path(); above != above.parent_path() && candidates.size() < most_places;
         above = above.parent_path()) {
        candidates.push_back(above / "share" / "octant");
    }
    candidates.emplace_back(OCTANT_SOURCE_DIR);
    for (const fs::path& place : candidates) {
        if (holds_data(place)) { return place; }
    }
    std::vector<std::string> names;
    for (const fs::path& place : candidates) { names.push_back(place.string()); }
    throw Error(fmt::format("expected the program's models and paths in one of {}; set OCTANT_DATA to their folder",
        fmt::join(names, ", ")));
}

fs::path aircraft_file(const std::string& name_or_file) {
    const fs::path models = "models";
    if (const sim::AircraftKind* kind = sim::find_aircraft_kind(name_or_file)) {
        return data_folder() / models / kind->model_file;
    }
    if (name_or_file == example_model) { return data_folder() / models / fmt::format("{}.obj", example_model); }
    if (looks_like_file(name_or_file)) { return name_or_file; }
    throw_unknown_aircraft(name_or_file);
}

const sim::AircraftKind& aircraft_kind_of(const std::string& name_or_file) {
    if (const sim::AircraftKind* kind = sim::find_aircraft_kind(name_or_file)) { return *kind; }
    if (name_or_file != example_model && !looks_like_file(name_or_file)) { throw_unknown_aircraft(name_or_file); }
    return sim::aircraft_kind("f15");
}

fs::path path_file(const std::string& name_or_file, const std::string& aircraft) {
    if (std::ranges::find(built_in_paths, name_or_file) != built_in_paths.end()) {
        const sim::AircraftKind& kind = aircraft_kind_of(aircraft);
        const std::string_view whose = kind.simple_type_name.empty() ? kind.name : kind.simple_type_name;
        return data_folder() / "flightpaths" / fmt::format("{}-{}.toml", whose, name_or_file);
    }
    if (looks_like_file(name_or_file)) { return name_or_file; }
    throw Error(fmt::format("path: expected {}, a .toml, .csv, .igc, .gpx or .acmi file, got '{}'",
        fmt::join(built_in_paths, ", "), printable(name_or_file)));
}

namespace {

/// Follows the XDG Base Directory Specification: a variable that is not an absolute path is ignored.
fs::path user_folder(const char* variable, const char* below_home) {
    const char* const own = std::getenv(variable);
    if (own != nullptr && fs::path(own).is_absolute()) { return fs::path(own) / "octant"; }
    const char* const home = std::getenv("HOME");
    return home == nullptr || *home == '\0' ? fs::path() : fs::path(home) / below_home / "octant";
}

/// The names of all PathAlias that live, by their folders.
struct PathAliases {
    std::mutex mutex;
    std::map<std::string, std::string> names;
};

PathAliases& path_aliases() {
    static PathAliases aliases;
    return aliases;
}

} // namespace

fs::path configuration_folder() { return user_folder("XDG_CONFIG_HOME", ".config"); }

fs::path cache_folder() { return user_folder("XDG_CACHE_HOME", ".cache"); }

TemporaryFolder::TemporaryFolder() {
    std::error_code ignored;
    const fs::path parent = fs::temp_directory_path(ignored);
    std::string name = ((parent.empty() ? "/tmp" : parent) / "octant-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
        throw_error_in(name, fmt::format("expected a place for a folder, got: {}", std::strerror(errno)));
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

PathAlias::PathAlias(const fs::path& folder, std::string name) : folder_(folder.string()) {
    const std::lock_guard lock(path_aliases().mutex);
    path_aliases().names.insert_or_assign(folder_, std::move(name));
}

PathAlias::~PathAlias() {
    const std::lock_guard lock(path_aliases().mutex);
    path_aliases().names.erase(folder_);
}

std::string with_path_aliases(std::string text) {
    const std::lock_guard lock(path_aliases().mutex);
    for (const auto& [folder, name] : path_aliases().names) {
        for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at + name.size())) {
            text.replace(at, folder.size(), name);
        }
    }
    return text;
}

} // namespace octant::ui::base
