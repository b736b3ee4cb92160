#include "models/polygons/obj_writer.h"
#include "models/procedural/procedural_models.h"
#include "tests/scratch.h"
#include "tests/ui/flight/kept_world.h"
#include "ui/flight/id_comparison.h"
#include "ui/studies/draw_order/study_hidden_surface.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

using namespace octant;

namespace {

visuals::scene::Picture picture_of(int width, int height, const std::vector<std::uint32_t>& ids) {
    visuals::scene::Picture picture;
    picture.width = width;
    picture.height = height;
    picture.rgba.resize(4 * ids.size());
    std::memcpy(picture.rgba.data(), ids.data(), picture.rgba.size());
    return picture;
}

ui::settings::RunSettings canyon_flight(const char* path, const char* aircraft, visuals::scene::View view) {
    ui::settings::RunSettings settings = ui::settings::measurement_settings();
    settings.path.name = path;
    settings.path.aircraft = {aircraft};
    settings.view.kind = view;
    settings.path.terrain = "canyon";
    settings.view.size_px = {320, 240};
    settings.ground.triangles = 8000;
    return settings;
}

ui::flight::ComparisonWorlds worlds_of(const ui::settings::RunSettings& settings) {
    const auto [painted, depth_buffered] = ui::flight::comparison_settings(settings);
    return {tests::kept_world(painted), tests::kept_world(depth_buffered)};
}

ui::flight::IdComparison compare(const ui::settings::RunSettings& settings, int every) {
    return ui::flight::compare_with_depth_buffer(settings, worlds_of(settings), every, [](int, int) {});
}

ui::studies::draw_order::RayComparison with_rays(const ui::settings::RunSettings& settings, int every) {
    return ui::studies::draw_order::compare_with_rays(settings, worlds_of(settings), every, [](int, int) {});
}

/// Compares more frames than `fewest`, each of which must show what the depth buffer shows.
void check_as_by_depth(const ui::settings::RunSettings& settings, int every, int fewest) {
    const ui::flight::IdComparison result = compare(settings, every);
    CHECK(result.frames > fewest);
    CHECK(result.unordered == 0);
    CHECK(result.wrong == 0);
}

} // namespace

TEST_CASE("a polygon number is apart only when no neighbour in the reference has it") {
    const auto reference = picture_of(4, 3, {1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 3, 3});
    CHECK(ui::flight::difference_of(reference, reference).differing == 0);
    const auto shifted = picture_of(4, 3, {1, 2, 2, 2, 1, 1, 2, 2, 3, 3, 3, 3});
    CHECK(ui::flight::difference_of(shifted, reference).differing == 1);
    CHECK(ui::flight::difference_of(shifted, reference).unmatched.empty());
    const auto far_off = picture_of(4, 3, {1, 1, 2, 1, 1, 1, 2, 2, 3, 3, 3, 3});
    const std::vector<glm::ivec2> unmatched = ui::flight::difference_of(far_off, reference).unmatched;
    REQUIRE(unmatched.size() == 1);
    CHECK(unmatched[0] == glm::ivec2(3, 0));
}

TEST_CASE("a polygon number is wrong when a larger reference does not have it there either") {
    const auto picture = picture_of(2, 1, {5, 7});
    const std::vector<glm::ivec2> pixels = {{0, 0}, {1, 0}};
    std::vector<std::uint32_t> large(18, 5);
    CHECK(ui::flight::count_wrong_ids(pixels, picture, picture_of(6, 3, large), 3) == 1);
    large[17] = 7;
    CHECK(ui::flight::count_wrong_ids(pixels, picture, picture_of(6, 3, large), 3) == 0);
}

TEST_CASE("detail between samples, trees and houses are painted as the depth buffer shows them") {
    using visuals::scene::View;
    for (const char* const terrain : {"hills", "canyon"}) {
        for (const View view : {View::Chase, View::Tower}) {
            for (const auto& [detail, scenery] :
                {std::pair{true, true}, std::pair{true, false}, std::pair{false, true}}) {
                if (view == View::Tower && !(detail && scenery)) {
                    continue; // The tower looks at the same ground through the same steps.
                }
                INFO(terrain << " view " << static_cast<int>(view) << " " << detail << scenery);
                ui::settings::RunSettings settings = canyon_flight("pop-up", "500md", view);
                settings.path.terrain = terrain;
                settings.ground.near_detail = detail;
                settings.ground.scenery = scenery;
                check_as_by_depth(settings, 240, 5);
            }
        }
    }
}

TEST_CASE("cockpits, with detail beyond them, are painted as the depth buffer shows them") {
    for (const auto& [aircraft, terrain] : {std::pair{"f15", "canyon"}, {"500md", "hills"}}) {
        for (const double azimuth_deg : {0.0, -70.0, 70.0}) {
            INFO(aircraft << " turned by " << azimuth_deg);
            ui::settings::RunSettings settings = canyon_flight("pop-up", aircraft, visuals::scene::View::Cockpit);
            settings.path.terrain = terrain;
            settings.view.azimuth_deg = azimuth_deg;
            settings.ground.near_detail = true;
            settings.ground.scenery = true;
            check_as_by_depth(settings, 480, 3);
        }
    }
}

TEST_CASE("with clouds, a ribbon and effects the polygons are those that the depth buffer shows") {
    using visuals::scene::View;
    for (const auto& [aircraft, terrain] : {std::pair{"f15", "canyon"}, {"500md", "hills"}}) {
        for (const View view : {View::Chase, View::Tower, View::Orbit}) {
            INFO(aircraft << " view " << static_cast<int>(view));
            ui::settings::RunSettings settings = canyon_flight("pop-up", aircraft, view);
            settings.path.terrain = terrain;
            settings.air.clouds = 0.5;
            settings.surface.effects = true;
            settings.view.path_ribbon = true;
            check_as_by_depth(settings, 240, 5);
        }
    }
}

TEST_CASE("painting in order shows the polygons that the depth buffer shows, over rugged ground") {
    using visuals::scene::View;
    constexpr int every = 240;
    for (const View view : {View::Chase, View::Tower, View::Orbit}) {
        for (const char* aircraft : {"f15", "500md"}) {
            INFO(aircraft << " view " << static_cast<int>(view));
            ui::settings::RunSettings settings = canyon_flight("pop-up", aircraft, view);
            settings.surface.effects = false; // with the blades of rotors
            check_as_by_depth(settings, every, 5);
        }
    }
}

TEST_CASE("painting in order shows the polygons that the depth buffer shows, with discs in place of blades") {
    ui::settings::RunSettings settings = canyon_flight("pop-up", "500md", visuals::scene::View::Chase);
    REQUIRE_FALSE(settings.surface.effects.has_value());
    check_as_by_depth(settings, 240, 5);
}

TEST_CASE("models of hundreds of polygons are painted as rays see them") {
    // A torus and two that pass through it, the second of which repeats the first polygon by polygon: rings, cuts and
    // polygons in one plane. Where polygons cross, a depth buffer rounds.
    auto model = models::procedural::torus();
    const std::string file = (tests::scratch_folder() / "rings.obj").string();
    const models::polygons::PolygonModel once = model;
    const glm::dvec3 aside{0.7 * models::polygons::radius_m(once), 0.0, 0.0};
    for (const glm::dvec3& move : {aside, aside}) {
        const auto first = static_cast<std::uint32_t>(model.vertices_m.size());
        for (const glm::dvec3& vertex_m : once.vertices_m) { model.vertices_m.push_back(vertex_m + move); }
        for (models::polygons::Polygon polygon : once.polygons) {
            polygon.first_corner += static_cast<std::uint32_t>(model.corner_vertices.size());
            model.polygons.push_back(polygon);
        }
        for (const std::uint32_t vertex : once.corner_vertices) { model.corner_vertices.push_back(first + vertex); }
    }
    REQUIRE(model.polygons.size() > 1000);
    models::polygons::write_obj(file, model);
    for (const auto& [path, view] :
        {std::pair{"pop-up", visuals::scene::View::Chase}, std::pair{"jinking", visuals::scene::View::Tower}}) {
        ui::settings::RunSettings settings = canyon_flight(path, file.c_str(), view);
        settings.ground.near_detail = true;
        settings.ground.scenery = true;
        if (view == visuals::scene::View::Tower) {
            settings.view.eye_m = ui::studies::draw_order::ridge_tower(tests::kept_world(settings));
        }
        settings.surface.order_seconds = 0.2;
        constexpr int every = 200;
        const auto result = with_rays(settings, every);
        INFO(path << ": " << result.renderers[0].first_wrong);
        CHECK(result.frames > 2);
        CHECK(result.wrong() == 0);
        CHECK(compare(settings, every).unordered == 0);
    }
}

TEST_CASE("an aircraft that goes behind ridges is painted as the depth buffer shows it") {
    ui::settings::RunSettings settings = canyon_flight("jinking", "500md", visuals::scene::View::Tower);
    settings.view.eye_m = ui::studies::draw_order::ridge_tower(tests::kept_world(settings));
    constexpr int every = 30;
    const ui::flight::IdComparison result = compare(settings, every);
    CHECK(result.frames_with_cuts > 0);
    CHECK(result.unordered == 0);
    CHECK(result.wrong == 0);
}

TEST_CASE("both renderers show the polygons that rays find, but for rounding") {
    using visuals::scene::View;
    for (const View view : {View::Chase, View::Cockpit}) {
        const auto result = with_rays(canyon_flight("pop-up", "f15", view), 200);
        REQUIRE(result.frames > 5);
        CHECK(result.wrong() == 0);
        for (const auto& renderer : result.renderers) { CHECK(renderer.differing < result.pixels / 500); }
    }
}

TEST_CASE("a picture in file order has pixels that no rounding explains") {
    ui::settings::RunSettings settings = canyon_flight("turn", "f15", visuals::scene::View::Orbit);
    settings.surface.hidden_surface = visuals::scene::HiddenSurface::BackFace;
    const auto result = with_rays(settings, 100);
    for (const auto& renderer : result.renderers) {
        CHECK(renderer.wrong > 0);
        CHECK_FALSE(renderer.first_wrong.empty());
    }
}
