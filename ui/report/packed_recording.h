#pragma once

#include "ui/base/data_files.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::report {

/// What came of packing.
struct PackResult {
    int files = 0;
    /// Names files that its run reads and that do not lie in it.
    std::vector<std::string> notes;
};

/// Writes a recording's folder as one zip file, whole or not at all. `with_terrain`: adds the files of terrain and
/// drape and their companions (x.hdr, x.prj); else only their hashes and paths are in the recording. Throws Error for a
/// folder that is no recording, and for a recording that is being written.
PackResult pack_recording(const std::filesystem::path& folder, const std::filesystem::path& zip, bool with_terrain);

/// A packed recording, unpacked into a temporary folder, which goes with this object. As long as it lives, messages
/// show the packed file's name in place of the folder.
class UnpackedRecording {
public:
    /// Throws Error for a file that is no packed recording or has anything else in it.
    explicit UnpackedRecording(const std::filesystem::path& zip);

    /// Named as the packed file, without its ending.
    const std::filesystem::path& folder() const { return folder_; }

private:
    base::TemporaryFolder parent_;
    std::filesystem::path folder_;
    base::PathAlias alias_;
};

/// The folder of a recording, packed or not.
struct RecordingFolder {
    std::filesystem::path path;
    /// Owns the folder of a packed recording, else null.
    std::shared_ptr<const UnpackedRecording> unpacked;
};

/// Unpacks a recording if it is a file. Throws Error as UnpackedRecording does.
RecordingFolder open_recording(const std::filesystem::path& folder_or_zip);

} // namespace octant::ui::report
