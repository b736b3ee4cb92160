#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octant::ui::report {

/// What came of packing.
struct PackResult {
    int files = 0;
    std::vector<std::string> notes; ///< files that its run reads and that do not lie in it
};

/// Writes a recording's folder as one zip file, whole or not at all. Terrain and what lies on it come with it, and with
/// the files of their name beside them, if `with_terrain`; else they are known by their hashes and the way to them.
/// Throws Error for what is no recording and for one that is being written.
PackResult pack_recording(const std::filesystem::path& folder, const std::filesystem::path& zip, bool with_terrain);

/// The folder of a recording that is a folder or was packed. A packed one is unpacked into a folder of its own, which
/// lives until the program ends; messages call that by the packed file's name (base::set_path_alias). Throws Error for
/// a file that is no packed recording or has anything else in it.
std::filesystem::path recording_folder(const std::filesystem::path& folder_or_zip);

/// Removes what recording_folder() unpacked, before the program is ended by a signal.
void remove_unpacked();

/// The same for a recording's run.json, its folder or its packed file; other files stay.
std::filesystem::path run_file_of(const std::filesystem::path& path);

} // namespace octant::ui::report
