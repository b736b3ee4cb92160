#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"
#include "tests/ui/flight/kept_world.h"
#include "ui/flight/id_comparison.h"
#include "ui/report/png_file.h"
#include "visuals/roads/road_network.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

using namespace octant;

namespace {

/// Beside a road of the made hills.
const std::vector<std::string> hills_road = {"straight", "--aircraft", "concave", "--terrain", "hills", "--view",
    "free", "--eye=-3900,-2900,245", "--look=-4500,-1000,225"};

ui::report::Picture picture_with(const std::vector<std::string>& options) {
    const std::filesystem::path folder = tests::empty_folder("roads");
    std::vector<std::string> arguments = hills_road;
    arguments.insert(arguments.begin(), "fly");
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), {"--size", "320x180", "--frames", "1", "--pictures", "1", "--quiet",
                                          "--no-scenery", "--record", folder.string()});
    const tests::ProgramRun run = tests::run_octant(arguments);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return ui::report::read_png(folder / "picture-00000.png");
}

int differing_pixels(const ui::report::Picture& a, const ui::report::Picture& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.bytes.size(); i += 3) {
        int most = 0;
        for (std::size_t part = i; part < i + 3; ++part) {
            most = std::max(most, std::abs(std::to_integer<int>(a.bytes[part]) - std::to_integer<int>(b.bytes[part])));
        }
        count += most > 20 ? 1 : 0;
    }
    return count;
}

} // namespace

TEST_CASE("roads are seen by each renderer, and not if they are not wanted") {
    for (const char* const renderer : {"raster", "gl"}) {
        INFO(renderer);
        const ui::report::Picture with = picture_with({"--renderer", renderer});
        const ui::report::Picture without = picture_with({"--renderer", renderer, "--show", "no-roads"});
        // A road 7 m wide crosses the picture some 100 to 200 m before the eye.
        CHECK(differing_pixels(with, without) > 300);
        CHECK(differing_pixels(with, without) < 6000);
    }
}

TEST_CASE("ground with roads is painted in order as the depth buffer shows it") {
    for (const char* const terrain : {"hills", "canyon"}) {
        ui::settings::RunSettings settings = ui::settings::measurement_settings();
        settings.path.name = "straight";
        settings.path.aircraft = {"500md"};
        settings.path.terrain = terrain;
        settings.view.size_px = {320, 240};
        settings.ground.triangles = 10000;
        settings.ground.near_detail = true;
        settings.ground.scenery = true;
        settings.ground.roads = true;
        const auto& ground = tests::kept_world(settings).scene.ground;
        const auto roads = ground->road_network();
        REQUIRE(roads);
        settings.view.kind = visuals::scene::View::Free;
        for (std::size_t i = 0; i < 8; ++i) {
            const visuals::roads::RoadSection& section = roads->sections()[i * roads->sections().size() / 8];
            const glm::dvec2 from_m = section.levels[0].front().at_m + glm::dvec2(30.0, 10.0);
            const glm::dvec2 to_m = section.levels[0].back().at_m;
            const double ground_m = ground->height_at(from_m.x, from_m.y).value();
            settings.view.eye_m = {from_m.x, from_m.y, ground_m + 12.0 + 15.0 * double(i * i)};
            settings.view.look_m = {to_m.x, to_m.y, ground->height_at(to_m.x, to_m.y).value()};
            const auto [painted, by_depth] = ui::flight::comparison_settings(settings);
            const ui::flight::IdComparison result = ui::flight::compare_with_depth_buffer(
                settings, {tests::kept_world(painted), tests::kept_world(by_depth)}, 400, [](int, int) {});
            INFO(terrain << " piece " << i);
            CHECK(result.frames > 0);
            CHECK(result.unordered == 0);
            CHECK(result.wrong == 0);
        }
    }
}

TEST_CASE("pictures with roads are the same for any number of threads") {
    std::vector<std::string> arguments = hills_road;
    arguments.insert(arguments.end(), {"--size", "160x90", "--frames", "4", "--rate", "1", "--renderer", "raster"});
    std::string first;
    for (const char* const threads : {"1", "2", "5"}) {
        std::vector<std::string> own = arguments;
        own.insert(own.end(), {"--raster-threads", threads});
        const std::string hash = tests::results_of_run("fly", own)["picture_hash"].text();
        first = first.empty() ? hash : first;
        CHECK(hash == first);
    }
}
