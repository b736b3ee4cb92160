#include "models/heights/runway_strip.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"
#include "tests/ui/flight/small_ground.h"
#include "ui/flight/id_comparison.h"
#include "ui/report/png_file.h"
#include "ui/world/world.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <vector>

using namespace octant;

namespace {

/// Over ground that is gentle enough for a runway.
std::vector<std::string> flight() {
    return {"straight", "--aircraft", "concave", "--terrain", tests::small_map(), "--no-near-detail"};
}

ui::settings::RunSettings settings_of_flight() {
    ui::settings::RunSettings settings = ui::settings::measurement_settings();
    settings.path.name = "straight";
    settings.path.aircraft = {"500md"};
    settings.path.terrain = "hills";
    settings.path.place = "3178,3140";
    settings.path.heading_deg = 70.0;
    settings.ground.airfield = true;
    return settings;
}

/// Where the runway of flight() lies.
const models::heights::RunwayStrip& runway() {
    static const ui::world::World world = [] {
        ui::settings::RunSettings settings = ui::settings::measurement_settings();
        settings.path.name = "straight";
        settings.path.aircraft = {"concave"};
        settings.path.terrain = tests::small_map();
        settings.ground.airfield = true;
        return ui::world::load_world(settings);
    }();
    return *world.scene.ground->runway();
}

/// "x,y,z" of a place so far along the runway and above it.
std::string above(double along_m, double up_m) {
    const glm::dvec2 at_m = runway().place({along_m, 0.0});
    return fmt::format("{:.3f},{:.3f},{:.3f}", at_m.x, at_m.y, runway().plane_m(at_m) + up_m);
}

struct Seen {
    int asphalt = 0;
    int paint = 0;
};

/// What a picture of it shows from above its threshold, by these options.
Seen seen(std::vector<std::string> options) {
    const std::filesystem::path folder = tests::empty_folder("airfield");
    std::vector<std::string> arguments = flight();
    arguments.insert(arguments.begin(), "fly");
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(
        arguments.end(), {"--view", "free", "--eye", above(-150.0, 60.0), "--look", above(250.0, 0.0), "--size",
                             "320x240", "--samples", "1", "--visibility", "0", "--frames", "1", "--pictures", "1",
                             "--show", "no-roads", "--quiet", "--record", folder.string()});
    const tests::ProgramRun run = tests::run_octant(arguments);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const ui::report::Picture picture = ui::report::read_png(folder / "picture-00000.png");
    Seen counted;
    constexpr std::size_t above_runway = std::size_t{3} * 320 * 85; // rows that show bright sky, too
    for (std::size_t pixel = above_runway; pixel < picture.bytes.size(); pixel += 3) {
        const auto [least, most] = std::minmax({std::to_integer<int>(picture.bytes[pixel]),
            std::to_integer<int>(picture.bytes[pixel + 1]), std::to_integer<int>(picture.bytes[pixel + 2])});
        counted.asphalt += most - least < 20 && most > 40 && most < 120 ? 1 : 0;
        counted.paint += most - least < 30 && least > 150 ? 1 : 0;
    }
    return counted;
}

} // namespace

TEST_CASE("a runway with markings is seen by each renderer, on textured ground too, and only if "
          "asked for") {
    // Its corners lie 157 and 1,937 m before the eye and 68 below and 34 pixels above the middle of the picture, where
    // 290 pixels are a radian: a trapezoid 83 and 7 pixels wide and 103 high.
    constexpr double runway_px = 4600.0;
    const Seen none = seen({});
    CHECK(none.asphalt + none.paint < runway_px / 50.0);
    for (const char* const renderer : {"raster", "gl"}) {
        for (const char* const shading : {"vertex", "texture"}) {
            for (const char* const surface : {"octant", "depth-buffer"}) {
                INFO(renderer << ' ' << shading << ' ' << surface);
                const Seen there = seen({"--show", "airfield", "--renderer", renderer, "--ground-look",
                    std::string("shading=") + shading, "--hidden-surface", surface});
                CHECK(there.asphalt + there.paint == Approx(runway_px).epsilon(0.03));
                CHECK(there.paint > runway_px / 8.0);
                CHECK(there.paint < runway_px / 4.0);
            }
        }
    }
}

TEST_CASE("pictures with a runway are the same for any number of threads") {
    std::vector<std::string> arguments = flight();
    arguments.insert(arguments.end(),
        {"--show", "airfield", "--size", "160x90", "--frames", "6", "--rate", "1", "--renderer", "raster"});
    std::string first;
    for (const char* const threads : {"1", "2", "5"}) {
        std::vector<std::string> own = arguments;
        own.insert(own.end(), {"--raster-threads", threads});
        const std::string hash = tests::results_of_run("fly", own)["picture_hash"].text();
        first = first.empty() ? hash : first;
        CHECK(hash == first);
    }
}

TEST_CASE("ground with a runway is painted in order as the depth buffer shows it") {
    ui::settings::RunSettings settings = settings_of_flight();
    settings.ground.triangles = 8000;
    settings.view.size_px = {320, 240};
    settings.view.kind = visuals::scene::View::Chase;
    const ui::flight::ComparisonWorlds worlds = ui::flight::load_comparison_worlds(settings);
    for (const auto& [renderer, every] :
        {std::pair(ui::settings::RendererKind::Raster, 10), std::pair(ui::settings::RendererKind::Gl, 60)}) {
        settings.drawing.renderer = renderer;
        const ui::flight::IdComparison result =
            ui::flight::compare_with_depth_buffer(settings, worlds, every, [](int, int) {});
        INFO("every " << every);
        CHECK(result.frames > 5);
        CHECK(result.unordered == 0);
        CHECK(result.differing < result.frames); // but for rounding
        CHECK(result.wrong == 0);
    }
}

TEST_CASE("an airfield that cannot lie anywhere near is refused in one line") {
    tests::check_refused("fly", {"straight", "--terrain", "none", "--show", "airfield"},
        "--show airfield: expected ground that can be levelled, got 'none'");
    tests::check_refused("fly",
        {"straight", "--terrain", tests::small_map(), "--ground-look", "water-level=9000", "--show", "airfield"},
        "--show airfield: expected ground within 6 km of the path");
}
