#pragma once

#include <filesystem>
#include <vector>

namespace octant::ui::world {

/// A file as it was at some time: another time of writing means other bytes.
struct FileMtime {
    std::filesystem::path file;
    std::filesystem::file_time_type modified;

    bool operator==(const FileMtime&) const = default;
};

/// Adds the stamp of a file as it is now; of one that cannot be looked at, the oldest that there is.
void add_mtime(const std::filesystem::path& file, std::vector<FileMtime>& mtimes);

} // namespace octant::ui::world
