#pragma once

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

namespace octant::tests {

/// A real file such as "terrain/N51E000.hgt" from the folder $OCTANT_SHARED_DATA, else from ../shared/data beside the
/// source. Prints "SKIPPED: why" if it is missing.
inline std::optional<std::filesystem::path> real_file(const std::string& name) {
    const char* const given = std::getenv("OCTANT_SHARED_DATA");
    const std::filesystem::path file =
        std::filesystem::path(given != nullptr ? given : OCTANT_SOURCE_DIR "/../shared/data") / name;
    if (std::filesystem::exists(file)) { return file; }
    std::cout << "SKIPPED: no " << file << '\n';
    return std::nullopt;
}

} // namespace octant::tests
