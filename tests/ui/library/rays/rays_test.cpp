#include "tests/ui/library/rays/views.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>
#include <unistd.h>

using namespace octant;
using namespace octant::tests;

TEST_CASE("truth and boxes of some views of each world are those of rays through the exported triangles") {
    const std::string folder =
        (std::filesystem::temp_directory_path() / ("octant-rays-" + std::to_string(getpid()))).string();
    std::filesystem::create_directories(folder);
    Findings all;
    for (const TriedWorld& tried : tried_worlds(folder)) {
        const World world(tried.settings);
        const std::vector<Vec3> busy = busy_places(world);
        for (std::size_t i = 0; i < 5; ++i) {
            all.add(check_view(
                world, tried_view(world, tried, busy, i), folder + "/scene.obj", tried.name + " " + std::to_string(i)));
        }
    }
    std::filesystem::remove_all(folder);
    for (const std::string& example : all.examples) { UNSCOPED_INFO(example); }
    CHECK(all.wrong() == 0);
    CHECK(all.beside + all.near_edges < all.pixels / 500);
    CHECK(all.unknown_flows < all.pixels / 1000);
    CHECK(all.flows > all.pixels / 2);
    CHECK(all.boxes >= 8);
    CHECK(all.of_class[static_cast<std::size_t>(SurfaceClass::Aircraft)] > 3000);
    CHECK(all.of_class[static_cast<std::size_t>(SurfaceClass::Water)] > 1000);
    CHECK(all.of_class[static_cast<std::size_t>(SurfaceClass::Road)] > 20);
    CHECK(all.of_class[static_cast<std::size_t>(SurfaceClass::Building)] > 100);
    CHECK(all.of_class[static_cast<std::size_t>(SurfaceClass::Tree)] > 300);
    CHECK(all.of_class[static_cast<std::size_t>(SurfaceClass::Cloud)] > 1000);
}
