#include "models/meshfile/mesh_file.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "tests/ui/flight/kept_world.h"
#include "ui/flight/session.h"
#include "ui/report/png_file.h"
#include "ui/studies/hybrid_shading/study_shading.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

using namespace octant;
using octant::visuals::scene::View;
using ui::settings::RunSettings;

namespace {

// The rasterizer is the same everywhere but its code is made for the processor it runs on: a rounding of a colour part
// or a pixel of an outline may differ, nothing else.
constexpr int max_part_difference = 3;
constexpr double max_outline_share = 0.002;
// The other renderer rounds corners by itself: where triangles are seen nearly edge-on, as on slopes beside the
// horizon, a pixel may show the next one.
constexpr double max_other_outline_share = 0.006;
// A depth buffer decides by rounding where textured ground and the land around it meet: it is compared with the picture
// painted in order.
constexpr double max_depth_outline_share = 0.0025;

ui::report::Picture last_picture(ui::flight::Session& session) {
    for (int frame = 0; frame < session.frames(); ++frame) { session.draw(frame); }
    const auto& picture = session.picture();
    const auto bytes = std::as_bytes(std::span(picture.rgba));
    return ui::report::picture_from_png("drawn", ui::report::png_bytes({picture.width, picture.height, 4, bytes}));
}

void check_same_pictures(
    const ui::report::Picture& actual, const ui::report::Picture& expected, const std::string& name, double max_share) {
    INFO(name);
    REQUIRE(expected.bytes.size() == actual.bytes.size());
    ui::report::Picture difference = actual;
    std::size_t wrong_pixels = 0;
    for (std::size_t pixel = 0; pixel < actual.bytes.size() / 3; ++pixel) {
        int worst = 0;
        for (std::size_t part = 3 * pixel; part < 3 * pixel + 3; ++part) {
            const int off =
                std::abs(std::to_integer<int>(actual.bytes[part]) - std::to_integer<int>(expected.bytes[part]));
            difference.bytes[part] = static_cast<std::byte>(std::min(255, 16 * off));
            worst = std::max(worst, off);
        }
        wrong_pixels += worst > max_part_difference ? 1 : 0;
    }
    const double share = static_cast<double>(wrong_pixels) / (static_cast<double>(actual.bytes.size()) / 3.0);
    CHECK(share <= max_share);
    if (share > max_share) {
        const std::filesystem::path folder = OCTANT_BUILD_DIR;
        ui::report::write_png(folder / (name + "-actual.png"), actual.view());
        ui::report::write_png(folder / (name + "-diff.png"), difference.view());
    }
}

/// Whether both renderers colour the ground by the same arithmetic: textures they light and filter each in its own way.
enum class Golden { OfBoth, OfEach };

/// Draws with one sample a pixel, by both renderers.
void check_against_golden(const std::string& name, RunSettings settings, Golden golden = Golden::OfBoth,
    double max_own_share = max_outline_share) {
    using ui::settings::RendererKind;
    settings.view.samples = 1;
    std::vector<std::unique_ptr<ui::flight::Session>> sessions; // on one ground
    for (const RendererKind kind : {RendererKind::Gl, RendererKind::Raster}) {
        settings.drawing.renderer = kind;
        sessions.push_back(std::make_unique<ui::flight::Session>(
            settings, ui::flight::PictureContent::World, nullptr, tests::kept_world(settings)));
        const ui::report::Picture actual = last_picture(*sessions.back());
        const std::string drawn_as = kind == RendererKind::Gl ? name : name + "-raster";
        const std::string approved_as = golden == Golden::OfEach ? drawn_as : name;
        const auto file = std::filesystem::path(OCTANT_SOURCE_DIR) / "tests/golden" / (approved_as + ".png");
        const bool own = approved_as == drawn_as;
        const bool by_depth = settings.surface.hidden_surface == visuals::scene::HiddenSurface::DepthBuffer;
        if (std::getenv("OCTANT_APPROVE") == nullptr) {
            const double max_share = own ? max_own_share : max_other_outline_share;
            check_same_pictures(actual, ui::report::read_png(file), drawn_as, max_share);
        } else if (own && !by_depth) {
            ui::report::write_png(file, actual.view());
        }
    }
}

RunSettings small(const std::string& path, const std::string& aircraft, const std::string& terrain, View view) {
    RunSettings settings = ui::settings::measurement_settings();
    settings.path.name = path;
    settings.path.aircraft = {aircraft};
    settings.path.terrain = terrain;
    settings.view.kind = view;
    settings.view.size_px = {240, 135};
    settings.ground.triangles = 6000;
    settings.time.rate_hz = 0.25;
    settings.time.frames = 4;
    return settings;
}

/// A ball of the study as a file that says its surface is smooth: without normals its steepest edges would be creases.
std::filesystem::path smooth_ball() {
    models::TriangleMesh ball = ui::studies::hybrid_shading::uneven_ball(24, 49);
    std::vector<glm::dvec3> sums(ball.vertices_m.size(), glm::dvec3(0.0));
    for (const models::Triangle& corners : ball.triangles) {
        const glm::dvec3& first_m = ball.vertices_m[corners[0]];
        const glm::dvec3 twice_area_m2 =
            glm::cross(ball.vertices_m[corners[1]] - first_m, ball.vertices_m[corners[2]] - first_m);
        for (const std::uint32_t corner : corners) { sums[corner] += twice_area_m2; }
    }
    for (const glm::dvec3& sum : sums) { ball.normals.emplace_back(glm::normalize(sum)); }
    ball.corner_normals = ball.triangles;
    const auto file = tests::scratch_folder() / "ball.ply";
    models::meshfile::write_mesh(file, ball);
    return file;
}

/// A checker of 8 x 8 fields with a red arrow that points north and a green corner in the north-east, as a file.
std::filesystem::path painted_drape() {
    constexpr int side = 256;
    const auto colour_at = [](int x, int y) -> std::array<int, 3> {
        const bool head = y >= 32 && y < 128 && std::abs(x - 128) <= (y - 32) / 2;
        const bool shaft = y >= 128 && y < 224 && std::abs(x - 128) <= 16;
        if (head || shaft) { return {210, 40, 30}; }
        if (x >= 224 && y < 32) { return {30, 180, 60}; }
        return (x / 32 + y / 32) % 2 == 0 ? std::array{225, 225, 215} : std::array{70, 80, 110};
    };
    std::vector<std::byte> bytes;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            for (const int part : colour_at(x, y)) { bytes.push_back(static_cast<std::byte>(part)); }
        }
    }
    const auto file = tests::scratch_folder() / "drape.png";
    ui::report::write_png(file, {side, side, 3, bytes});
    return file;
}

} // namespace

// OCTANT_APPROVE=1 writes new golden pictures: look at them before they are committed.
TEST_CASE("pictures are those that were approved") {
    check_against_golden("f15-jinking-canyon-chase", small("jinking", "f15", "canyon", View::Chase));
    check_against_golden("f15-pop-up-hills-cockpit", small("pop-up", "f15", "hills", View::Cockpit));
    check_against_golden("500md-turn-canyon-orbit", small("turn", "500md", "canyon", View::Orbit));
    check_against_golden("500md-straight-background60-chase", small("straight", "500md", "background60", View::Chase));
    RunSettings low = small("jinking", "500md", "hills", View::Cockpit);
    low.view.size_px = {480, 270}; // smaller pixels hold several triangles of the slope each
    check_against_golden("500md-jinking-hills-cockpit", low);
    check_against_golden("f15-straight-canyon-tower", small("straight", "f15", "canyon", View::Tower));
}

TEST_CASE("pictures of near ground with its detail and what stands there are those approved") {
    // The pattern's levels are chosen by each renderer in its own way.
    for (const char* const terrain : {"hills", "canyon"}) {
        RunSettings low = small("straight", "500md", terrain, View::Chase);
        low.ground.near_detail = true;
        low.ground.scenery = true;
        check_against_golden("500md-straight-" + std::string(terrain) + "-near-ground", low, Golden::OfEach);
    }
}

TEST_CASE("pictures of a runway are those that were approved") {
    RunSettings low = small("straight", "500md", "hills", View::Chase);
    low.path.place = "3178,3140"; // where the ground is gentle enough
    low.path.heading_deg = 70.0;
    low.ground.airfield = true;
    low.view.size_px = {320, 180};
    check_against_golden("500md-straight-hills-airfield", low);
    low.air.ground_shading = visuals::scene::GroundShading::Texture;
    check_against_golden("500md-straight-hills-airfield-textured", low, Golden::OfEach);
    low.surface.hidden_surface = visuals::scene::HiddenSurface::DepthBuffer;
    check_against_golden("500md-straight-hills-airfield-textured", low, Golden::OfEach);
}

TEST_CASE("pictures with a head-up display are those that were approved") {
    RunSettings banked = small("pop-up", "f15", "canyon", View::Cockpit);
    banked.view.size_px = {640, 360};
    banked.time.rate_hz = 1.0 / 7.0;
    check_against_golden("f15-pop-up-canyon-head-up", banked);
}

TEST_CASE("pictures of a refined mesh, three in ten smooth, are those that were approved") {
    using visuals::scene::ModelDisplay;
    const auto file = smooth_ball();
    RunSettings ball = small("turn", file.string(), "hills", View::Chase);
    ball.path.axes = "right,up,back";
    ball.shading.smooth_share = 0.3;
    ball.air.sun_azimuth_deg = 45.0; // on the side that is seen
    ball.surface.aircraft_error_px = 0.2;
    check_against_golden("ball-turn-hills-hybrid", ball);
    ball.shading.show_model = ModelDisplay::Shading;
    check_against_golden("ball-turn-hills-shading", ball);
    ball.shading.show_model = ModelDisplay::Levels;
    check_against_golden("ball-turn-hills-levels", ball);
}

TEST_CASE("pictures lit in each pixel are those that were approved") {
    RunSettings flown = small("turn", "f15", "hills", View::Orbit);
    flown.shading.kind = visuals::scene::AircraftShading::Phong;
    flown.view.zoom = 1.5;
    check_against_golden("f15-turn-hills-phong", flown);
    const auto file = smooth_ball();
    flown.path.aircraft = {file.string()};
    flown.path.axes = "right,up,back";
    flown.view.kind = View::Chase;
    flown.view.zoom = 1.0;
    flown.air.sun_azimuth_deg = 45.0; // so that a highlight is seen
    check_against_golden("ball-turn-hills-phong", flown);
}

TEST_CASE("pictures of textured ground are those that were approved") {
    RunSettings canyon = small("jinking", "f15", "canyon", View::Chase);
    canyon.view.size_px = {320, 240};
    canyon.air.ground_shading = visuals::scene::GroundShading::Texture;
    check_against_golden("f15-jinking-canyon-textured", canyon, Golden::OfEach);
    RunSettings draped = small("straight", "f15", "hills", View::Free);
    draped.view.size_px = {320, 240};
    draped.air.drape = painted_drape().string();
    draped.air.visibility_m = 0.0;
    draped.view.eye_m = glm::dvec3(0.0, -24000.0, 16000.0);
    draped.view.look_m = glm::dvec3(0.0, -2000.0, 0.0);
    check_against_golden("hills-draped-from-the-south", draped, Golden::OfEach);
    draped.surface.hidden_surface = visuals::scene::HiddenSurface::DepthBuffer;
    check_against_golden("hills-draped-from-the-south", draped, Golden::OfEach, max_depth_outline_share);
}
