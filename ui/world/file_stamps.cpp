#include "ui/world/file_stamps.h"

#include <system_error>

namespace octant::ui::world {

void add_stamp(const std::filesystem::path& file, std::vector<FileStamp>& stamps) {
    std::error_code unknown;
    stamps.push_back({file, std::filesystem::last_write_time(file, unknown)});
}

} // namespace octant::ui::world
