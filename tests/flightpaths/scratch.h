#pragma once

#include "sim/base/output_file.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace octant::tests {

/// A file with this text in a folder of this test program.
inline std::filesystem::path written(const std::string& name, std::string_view text) {
    write_file(scratch_folder() / name, text);
    return scratch_folder() / name;
}

inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

inline std::filesystem::path shipped(const std::string& name) {
    return std::filesystem::path(OCTANT_SOURCE_DIR) / "flightpaths" / (name + ".toml");
}

} // namespace octant::tests
