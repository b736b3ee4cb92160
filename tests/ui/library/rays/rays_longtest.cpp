#include "tests/ui/library/rays/views.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <unistd.h>

using namespace octant;
using namespace octant::tests;

namespace {

/// Checks 34 views of each world and prints a row of a table for each.
void check_all(const std::string& method) {
    const std::string folder =
        (std::filesystem::temp_directory_path() / ("octant-rays-" + method + std::to_string(getpid()))).string();
    std::filesystem::create_directories(folder);
    for (TriedWorld tried : tried_worlds(folder)) {
        if (method == "depth-buffer" && tried.name == "clouds") { continue; } // refused together
        tried.settings.settings.emplace_back("hidden-surface", method);
        const World world(tried.settings);
        const std::vector<Vec3> busy = busy_places(world);
        Findings all;
        constexpr std::size_t views = 34;
        for (std::size_t i = 0; i < views; ++i) {
            all.add(check_view(
                world, tried_view(world, tried, busy, i), folder + "/scene.obj", fmt::format("{} {}", tried.name, i)));
        }
        fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} of {} | {:.0e} | {:.3f} | {} of {} |\n", tried.name,
            method, all.pixels, all.beside, all.near_edges, all.wrong_class + all.wrong_object,
            all.wrong_depth + all.wrong_cloud, all.wrong_normal, all.wrong_flow, all.flows, all.largest_depth_error,
            all.largest_flow_error_px, all.wrong_boxes, all.boxes);
        for (const std::string& example : all.examples) { UNSCOPED_INFO(example); }
        CHECK(all.wrong() == 0);
        CHECK(all.beside + all.near_edges < all.pixels / 500);
        CHECK(all.unknown_flows < all.pixels / 1000);
        CHECK(all.of_class[static_cast<std::size_t>(SurfaceClass::Aircraft)] > all.pixels / 100);
    }
    std::filesystem::remove_all(folder);
}

} // namespace

TEST_CASE("truth of 204 views is that of rays, with aircraft in painting order") { check_all("octant"); }

TEST_CASE("truth of 170 views is that of rays, with aircraft by depth buffer") { check_all("depth-buffer"); }
