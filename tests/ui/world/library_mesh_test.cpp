#include "tests/scratch.h"
#include "ui/world/mesh_loader.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

using namespace octant;
using namespace octant::ui::world;
using Catch::Contains;

TEST_CASE("a file too large for a library is refused at once, whichever library it is") {
    constexpr std::uintmax_t mebibyte = std::uintmax_t{1} << 20U;
    for (const char* name : {"large.dae", "large.osg"}) {
        const std::filesystem::path file = tests::scratch_folder() / name;
        std::ofstream(file).close();
        std::filesystem::resize_file(file, 1025 * mebibyte); // a hole: it takes no space on the disk
        CHECK(is_library_file(file));
        CHECK_THROWS_WITH(
            read_library_mesh(file), Contains(std::string(name) + ": expected at most 1073741824 bytes, got more"));
        std::filesystem::remove(file);
        CHECK_THROWS_WITH(read_library_mesh(file), Contains("expected a file that can be read, got none"));
    }
    CHECK_FALSE(is_library_file("own.obj"));
}
