#include "sim/base/output_file.h"
#include "ui/report/png_file.h"
#include "ui/session.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

using namespace octant;
using octant::visuals::scene::Settings;
using octant::visuals::scene::View;

namespace {

// The rasterizer is the same everywhere but its code is made for the processor it runs on: a
// rounding of a colour part or a pixel of an outline may differ, nothing else.
constexpr int most_part_difference = 3;
constexpr double most_outline_share = 0.002;

ui::report::Picture drawn(const Settings& settings) {
    ui::Session session(settings);
    for (int frame = 0; frame < session.frames(); ++frame) {
        session.draw(frame);
    }
    const auto& picture = session.picture();
    const auto bytes = std::as_bytes(std::span(picture.rgba));
    return ui::report::picture_from_png(
        "drawn", ui::report::png_bytes({picture.width, picture.height, 4, bytes}));
}

void check_against_golden(const std::string& name, const Settings& settings) {
    INFO(name);
    const auto golden = std::filesystem::path(OCTANT_SOURCE_DIR) / "tests/golden" / (name + ".png");
    const ui::report::Picture actual = drawn(settings);
    if (std::getenv("OCTANT_APPROVE") != nullptr) {
        ui::report::write_png(golden, actual.view());
        return;
    }
    const ui::report::Picture expected = ui::report::read_png(golden);
    REQUIRE(expected.bytes.size() == actual.bytes.size());
    ui::report::Picture difference = actual;
    std::size_t wrong_pixels = 0;
    for (std::size_t pixel = 0; pixel < actual.bytes.size() / 3; ++pixel) {
        int worst = 0;
        for (std::size_t part = 3 * pixel; part < 3 * pixel + 3; ++part) {
            const int off = std::abs(
                std::to_integer<int>(actual.bytes[part]) -
                std::to_integer<int>(expected.bytes[part]));
            difference.bytes[part] = static_cast<std::byte>(std::min(255, 16 * off));
            worst = std::max(worst, off);
        }
        wrong_pixels += worst > most_part_difference ? 1 : 0;
    }
    const double share =
        static_cast<double>(wrong_pixels) / (static_cast<double>(actual.bytes.size()) / 3.0);
    CHECK(share <= most_outline_share);
    if (share > most_outline_share) {
        const std::filesystem::path folder = OCTANT_BUILD_DIR;
        ui::report::write_png(folder / (name + "-actual.png"), actual.view());
        ui::report::write_png(folder / (name + "-diff.png"), difference.view());
    }
}

Settings
small(const std::string& path, const std::string& aircraft, const std::string& terrain, View view) {
    Settings settings;
    settings.path = path;
    settings.aircraft = {aircraft};
    settings.terrain = terrain;
    settings.view = view;
    settings.size_px = {240, 135};
    settings.triangles = 6000;
    settings.rate_hz = 0.25;
    settings.frames = 4;
    return settings;
}

} // namespace

// OCTANT_APPROVE=1 writes new golden pictures: look at them before they are committed.
TEST_CASE("pictures are those that were approved") {
    check_against_golden(
        "f15-jinking-canyon-chase", small("jinking", "f15", "canyon", View::Chase));
    check_against_golden(
        "f15-pop-up-hills-cockpit", small("pop-up", "f15", "hills", View::Cockpit));
    check_against_golden("500md-turn-canyon-orbit", small("turn", "500md", "canyon", View::Orbit));
    check_against_golden(
        "500md-straight-background60-chase",
        small("straight", "500md", "background60", View::Chase));
    check_against_golden(
        "500md-jinking-hills-cockpit", small("jinking", "500md", "hills", View::Cockpit));
    check_against_golden(
        "f15-straight-canyon-tower", small("straight", "f15", "canyon", View::Tower));
}
