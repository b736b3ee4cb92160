#include "ui/world/file_mtimes.h"

#include <system_error>

namespace octant::ui::world {

void add_mtime(const std::filesystem::path& file, std::vector<FileMtime>& mtimes) {
    std::error_code unknown;
    mtimes.push_back({file, std::filesystem::last_write_time(file, unknown)});
}

} // namespace octant::ui::world
