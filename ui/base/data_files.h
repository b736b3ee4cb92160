#pragma once

#include "sim/aircraft_kind.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace octant::ui::base {

/// A shape without a type of its own: the example object of the 1989 paper.
inline constexpr std::string_view example_model = "concave";

/// Names of the built-in models of polygons: those of the known aircraft, then the typeless one.
inline constexpr auto built_in_models = [] {
    std::array<std::string_view, sim::aircraft_table.size() + 1> names{};
    std::ranges::transform(sim::aircraft_table, names.begin(), &sim::AircraftKind::name);
    names.back() = example_model;
    return names;
}();

/// Built-in paths, of which each known aircraft has its own or another's, in the order of the 1989 paper.
inline constexpr std::array<std::string_view, 4> built_in_paths{"straight", "jinking", "pop-up", "turn"};

/// Where the program's own models and paths lie: OCTANT_DATA when set, else the installed prefix of the program, or of
/// the shared library that this is part of, else the source tree it was built from. Throws Error when none of them has
/// them, naming the places.
std::filesystem::path data_folder();

/// File of an aircraft: a name of built_in_models or a file. Throws Error for a name that is neither, listing the
/// built-in ones.
std::filesystem::path aircraft_file(const std::string& name_or_file);

/// The aircraft whose flight model and built-in paths a model flies with: its own, or, for the typeless model and
/// files, of which no more than the shape is known, the F-15's. Throws Error as aircraft_file.
const sim::AircraftKind& aircraft_kind_of(const std::string& name_or_file);

/// File of a path for an aircraft: a name of built_in_paths or a file. Throws Error as aircraft_file.
std::filesystem::path path_file(const std::string& name_or_file, const std::string& aircraft);

/// Where the program keeps what the user chose: $XDG_CONFIG_HOME/octant, else ~/.config/octant. Empty where the
/// environment names no home.
std::filesystem::path configuration_folder();

/// Where the program keeps what it can compute anew: $XDG_CACHE_HOME/octant, else ~/.cache/octant. Empty where the
/// environment names no home.
std::filesystem::path cache_folder();

/// A new empty folder below the system's folder for temporary files. It is removed with all that is in it.
class TemporaryFolder {
public:
    /// Throws Error.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    TemporaryFolder(TemporaryFolder&&) = delete;
    TemporaryFolder& operator=(TemporaryFolder&&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// As long as it lives, messages show `name` in place of `folder` and of the paths below it. A packed recording is
/// unpacked into a temporary folder; messages then name the packed file that the user gave.
class PathAlias {
public:
    PathAlias(const std::filesystem::path& folder, std::string name);
    ~PathAlias();
    PathAlias(const PathAlias&) = delete;
    PathAlias& operator=(const PathAlias&) = delete;
    PathAlias(PathAlias&&) = delete;
    PathAlias& operator=(PathAlias&&) = delete;

private:
    std::string folder_;
};

/// `text` with each aliased folder replaced by its name.
std::string with_path_aliases(std::string text);

/// Calls `function` and returns its result. The text of an Error that it throws gets with_path_aliases() here, because
/// the aliases may have ended where the Error is caught.
template <class Function>
auto with_named_errors(const Function& function) {
    try {
        return function();
    } catch (const Error& fault) { throw Error(with_path_aliases(fault.what())); }
}

} // namespace octant::ui::base
