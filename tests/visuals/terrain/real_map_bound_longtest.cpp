#include "models/heights/height_source.h"
#include "tests/real_files.h"
#include "tests/visuals/terrain/pixel_errors.h"
#include "visuals/terrain/bisection_ground_builder.h"
#include "visuals/terrain/bisection_mesher.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <vector>

namespace octant::visuals::terrain {

namespace {

/// A view in shares of a map's half extent, with the eye and what it looks at above the ground.
struct ViewOnMap {
    glm::dvec2 eye;
    double eye_above_m;
    glm::dvec2 look;
    double look_above_m;
};

constexpr std::array<ViewOnMap, 8> views_on_map = {
    {{{0.0, -0.9}, 300.0, {0.1, 0.6}, 0.0}, {{-0.8, -0.8}, 100.0, {0.0, 0.0}, 100.0},
        {{0.1, 0.05}, 2500.0, {0.2, 0.2}, 0.0}, {{0.6, 0.03}, 30.0, {-0.8, 0.1}, 300.0},
        {{0.02, -0.01}, 800.0, {0.7, -0.9}, 0.0}, {{-0.9, 0.9}, 1500.0, {-0.7, 0.7}, 0.0},
        {{0.3, 0.4}, 60.0, {0.31, 0.5}, 500.0}, {{0.0, 0.3}, 10000.0, {0.3, -0.1}, 0.0}}};

test::TestPicture picture_on(const models::heights::HeightField& map, const ViewOnMap& view) {
    const auto above = [&map](const glm::dvec2& share, double above_m) {
        const glm::dvec2 at_m = share * map.half_extent_m();
        return glm::dvec3(at_m, map.height_at(at_m.x, at_m.y).value_or(0.0) + above_m);
    };
    return {above(view.eye, view.eye_above_m), above(view.look, view.look_above_m)};
}

/// Checks one map as seen in all views; says how many samples it compared.
void check_map(const models::heights::HeightField& map) {
    const GroundTiles ground = make_ground_tiles(map);
    BisectionMesher mesher(ground);
    long samples = 0;
    for (std::size_t v = 0; v < views_on_map.size(); ++v) {
        const test::TestPicture picture = picture_on(map, views_on_map[v]);
        const double earth_radius_m = v % 2 == 0 ? 0.0 : 6.371e6;
        for (const double error_px : {0.5, 1.0, 2.0}) {
            const MeshView view = picture.view(earth_radius_m);
            const GroundMesh mesh = mesher.mesh(view, {error_px, unlimited_triangles, true});
            const test::PixelErrors found = test::pixel_errors(mesh, ground, picture, earth_radius_m);
            INFO(map.name << ", view " << v << ", " << error_px << " px");
            CHECK(found.samples > 500);
            CHECK(found.worst_px <= error_px);
            samples += found.samples;
        }
    }
    CHECK(samples > 1'000'000);
}

} // namespace

TEST_CASE("over real maps no sample in the picture is farther off than the error asked for") {
    for (const char* const name : {"gcanyon_1025.tif", "gcanyon_1025_smooth.tif", "pugetsound_1025.tif",
             "vancouver_2049.tif", "N51E000.hgt", "srtm3_N49W123.tif"}) {
        const auto file = tests::real_file("terrain/" + std::string(name));
        if (!file) { return; }
        check_map(models::heights::read_height_field(*file, {30.0, 1.0}));
    }
}

} // namespace octant::visuals::terrain
