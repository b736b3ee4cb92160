#include "models/procedural/procedural_terrain.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/world/user_cache.h"
#include "ui/world/scene_ground.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>

using namespace octant;
using models::heights::HeightField;
using ui::world::built_in_ground;
namespace fs = std::filesystem;

namespace {

bool is_same(const HeightField& a, const HeightField& b) {
    bool same = a.columns() == b.columns() && a.rows() == b.rows() && a.spacing_m() == b.spacing_m() &&
                a.name == b.name && !a.place && !b.place && !a.system && !b.system &&
                a.filled_voids == b.filled_voids && a.lowest_m() == b.lowest_m() && a.highest_m() == b.highest_m();
    for (int row = 0; same && row < a.rows(); ++row) {
        for (int column = 0; column < a.columns(); ++column) {
            same = same && a.height_m(column, row) == b.height_m(column, row);
        }
    }
    return same;
}

} // namespace

TEST_CASE("built-in ground is the same made, read from the cache, and where the file is damaged") {
    const fs::path folder = tests::empty_folder("kept-ground");
    const tests::UserCache cache(folder);
    const fs::path file = folder / "octant" / "ground" / "hills.heights";
    const HeightField made = *models::procedural::procedural_terrain("hills");
    CHECK(is_same(*built_in_ground("hills"), made));
    REQUIRE(fs::exists(file));
    const std::string kept = read_file(file);
    CHECK(is_same(*built_in_ground("hills"), made));

    std::string damaged = kept;
    damaged[kept.size() / 2] = static_cast<char>(damaged[kept.size() / 2] ^ 1);
    std::string long_side = kept; // its checksum is wrong as well
    long_side[48] = '\x7f';
    for (const std::string& bytes : {damaged, long_side, kept.substr(0, kept.size() - 1)}) {
        write_file(file, bytes);
        CHECK(is_same(*built_in_ground("hills"), made));
        CHECK(read_file(file) == kept);
    }
}

TEST_CASE("built-in ground needs no cache, and other names are none") {
    const fs::path folder = tests::empty_folder("kept-ground-in-the-way");
    write_file(folder / "octant", "a file where the folder would be");
    const tests::UserCache cache(folder);
    CHECK(is_same(*built_in_ground("canyon"), *models::procedural::procedural_terrain("canyon")));
    CHECK_FALSE(built_in_ground("valley").has_value());
}
