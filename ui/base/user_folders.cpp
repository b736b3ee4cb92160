// As the XDG Base Directory Specification has it: a variable that is no absolute path is ignored.
#include "ui/base/user_folders.h"

#include <cstdlib>

namespace octant::ui::base {

namespace fs = std::filesystem;

namespace {

fs::path user_folder(const char* variable, const char* below_home) {
    const char* const own = std::getenv(variable);
    if (own != nullptr && fs::path(own).is_absolute()) { return fs::path(own) / "octant"; }
    const char* const home = std::getenv("HOME");
    return home == nullptr || *home == '\0' ? fs::path() : fs::path(home) / below_home / "octant";
}

} // namespace

fs::path configuration_folder() { return user_folder("XDG_CONFIG_HOME", ".config"); }

fs::path cache_folder() { return user_folder("XDG_CACHE_HOME", ".cache"); }

} // namespace octant::ui::base
