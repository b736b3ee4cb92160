#include "sim/base/file_status.h"

#include <system_error>

namespace octant {

namespace fs = std::filesystem;

namespace {

/// None where the system cannot tell.
fs::file_type type_of(const fs::path& path) {
    std::error_code fault;
    const fs::file_type type = fs::status(path, fault).type();
    return fault ? fs::file_type::none : type;
}

} // namespace

bool path_exists(const fs::path& path) {
    const fs::file_type type = type_of(path);
    return type != fs::file_type::none && type != fs::file_type::not_found;
}

bool is_folder(const fs::path& path) { return type_of(path) == fs::file_type::directory; }

bool is_file(const fs::path& path) { return type_of(path) == fs::file_type::regular; }

bool is_same_file(const fs::path& a, const fs::path& b) {
    if (a.empty() || b.empty()) { return false; }
    std::error_code fault;
    if (fs::equivalent(a, b, fault)) { return true; }
    const fs::path whole_a = fs::weakly_canonical(a, fault);
    if (fault) { return false; }
    const fs::path whole_b = fs::weakly_canonical(b, fault);
    return !fault && whole_a == whole_b;
}

fs::path absolute_path(const fs::path& path) {
    std::error_code fault;
    const fs::path whole = fs::absolute(path, fault);
    return fault ? path : whole.lexically_normal();
}

} // namespace octant
