#pragma once

#include "ui/settings/settings.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::world {

/// A file and its time of writing: another time means other bytes.
struct FileMtime {
    std::filesystem::path file;
    std::filesystem::file_time_type modified;

    bool operator==(const FileMtime&) const = default;
};

/// Adds a file with its time of writing; of one whose time cannot be read, the least time.
void add_mtime(const std::filesystem::path& file, std::vector<FileMtime>& mtimes);

/// The files that a model's file names, directly or through others, and that are there; absolute, each once, in the
/// order in which they are met: materials and pictures of .obj files, pictures of .ac and .wrl files and of formats
/// that libraries read, buffers and pictures of .gltf files, and all that FlightGear's .xml files name. A file that
/// cannot be read is passed over: the model's loader reports it.
std::vector<std::filesystem::path> referenced_files(const std::filesystem::path& model);

/// The settings with every file in them by its absolute name, so that they mean the same in any folder.
settings::RunSettings with_absolute_paths(settings::RunSettings settings);

/// All files of this computer that the heights of a terrain come from; none for made ground. Throws Error where there
/// are none.
std::vector<std::filesystem::path> ground_files(const std::string& terrain);

/// Where a recording has a file that its run reads.
enum class FileLocation {
    /// A copy lies in the recording.
    Copied,
    /// The file lies in the program's own folder.
    BuiltIn,
    /// The file is too large to copy: a terrain, which is known by its hash.
    External
};

/// A file that a run reads.
struct InputFile {
    std::filesystem::path file;
    /// "inputs/my.obj" in the recording, "models/f15.obj" in the program's own folder, or the file's own name.
    std::string name;
    FileLocation location = FileLocation::Copied;
};

/// The files that runs read, painting orders apart: paths, aircraft with their materials, terrain and what lies on it.
/// Each once, in the order in which they are found; names of copies differ. Throws Error for files that are missing.
std::vector<InputFile> input_files(std::span<const settings::RunSettings> runs);

/// Calls `rename` with each text of the settings that names a path, an aircraft's shape, a terrain, its coordinate
/// system or a drape, built in or a file.
void rename_inputs(settings::RunSettings& settings, const std::function<void(std::string&)>& rename);

/// A hash of a file's content, as recordings have it. Throws Error.
std::string hash_of_file(const std::filesystem::path& file);

/// The name and a hash of the content of each of the files that a run reads. Throws Error.
std::vector<std::pair<std::string, std::string>> input_hashes(const settings::RunSettings& settings);

/// The settings as a recording in that folder has them: files by their names inside it, those outside by the way to
/// them from there. settings::read_settings finds them again.
settings::RunSettings settings_in_recording(const settings::RunSettings& settings, const std::filesystem::path& folder);

/// Reads what settings_in_recording() names inside the recording, and the painting orders that were used: names in the
/// recording and bytes. Throws Error.
std::vector<std::pair<std::string, std::string>> files_to_copy(
    const settings::RunSettings& settings, const std::vector<std::filesystem::path>& order_files);

} // namespace octant::ui::world
