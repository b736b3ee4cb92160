#include "models/heights/height_field.h"
#include "tests/visuals/terrain/pixel_errors.h"
#include "visuals/terrain/bisection_ground_builder.h"
#include "visuals/terrain/bisection_mesher.h"
#include "visuals/terrain/mesh_measurement.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace octant::visuals::terrain {

namespace {

constexpr int side = 193;
constexpr double spacing_m = 40.0;

double wave_sum(int column, int row, double roughness, unsigned seed) {
    double sum = 0.0;
    double amplitude = 1.0;
    double frequency = 2.0 / side;
    for (unsigned octave = 0; octave < 7; ++octave) {
        const double turn = 1.7 * octave + 0.9 * seed;
        const double along = column * std::cos(turn) + row * std::sin(turn);
        const double across = row * std::cos(turn) - column * std::sin(turn);
        sum += amplitude * std::sin(6.283 * frequency * along + turn) * std::cos(5.1 * frequency * across + 2.0 * turn);
        amplitude *= roughness;
        frequency *= 2.03;
    }
    return sum;
}

/// A field whose heights are a function of column and row.
template <typename Height>
models::heights::HeightField field_of(int columns, int rows, const Height& height_m) {
    std::vector<float> heights_m;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            heights_m.push_back(static_cast<float>(height_m(column, row)));
        }
    }
    return {columns, rows, spacing_m, heights_m};
}

/// Sums of waves: the lower the roughness, the faster fine ones fade.
models::heights::HeightField waves(double height_m, double roughness, unsigned seed) {
    return field_of(side, side, [=](int column, int row) { return height_m * wave_sum(column, row, roughness, seed); });
}

/// Mud flats and channels in whole metres, at most a few high.
models::heights::HeightField estuary() {
    return field_of(
        side, 150, [](int column, int row) { return std::round(3.0 * std::max(0.0, wave_sum(column, row, 0.6, 5))); });
}

/// Mesas: level ground at a few heights, with cliffs between.
models::heights::HeightField mesas() {
    return field_of(
        side, side, [](int column, int row) { return 150.0 * std::round(1.5 * wave_sum(column, row, 0.5, 6)); });
}

/// Steep slopes of all sizes, and needles of one sample.
models::heights::HeightField peaks() {
    return field_of(170, side, [](int column, int row) {
        const bool needle = (37 * column + 11 * row) % 211 == 0;
        return 400.0 * std::abs(wave_sum(column, row, 0.8, 7)) + (needle ? 120.0 : 0.0);
    });
}

const std::array<test::TestPicture, 8>& pictures() {
    static const std::array<test::TestPicture, 8> views = {
        {{{0.0, -3500.0, 900.0}, {300.0, 2000.0, 200.0}}, {{-3000.0, -3000.0, 700.0}, {0.0, 0.0, 0.0}},
            {{500.0, 200.0, 2500.0}, {900.0, 900.0, 0.0}}, {{2500.0, 100.0, 650.0}, {-3000.0, 300.0, 650.0}},
            {{0.0, 0.0, 1200.0}, {3000.0, -3000.0, 900.0}}, {{-3700.0, 3500.0, 1500.0}, {0.0, 0.0, -500.0}},
            {{1000.0, -6000.0, 800.0}, {1000.0, 0.0, 1600.0}}, {{100.0, 1500.0, 560.0}, {-2500.0, -1500.0, 300.0}}}};
    return views;
}

} // namespace

TEST_CASE("no sample in the picture is farther from the mesh than the error asked for, nor are "
          "there cracks") {
    const std::array<GroundTiles, 6> grounds = {make_ground_tiles(waves(60.0, 0.45, 1)),
        make_ground_tiles(waves(250.0, 0.6, 2)), make_ground_tiles(waves(180.0, 0.75, 3)), make_ground_tiles(estuary()),
        make_ground_tiles(mesas()), make_ground_tiles(peaks())};
    for (std::size_t g = 0; g < grounds.size(); ++g) {
        BisectionMesher mesher(grounds[g]);
        for (std::size_t v = 0; v < pictures().size(); ++v) {
            const test::TestPicture& picture = pictures()[v];
            const double earth_radius_m = v % 2 == 0 ? 0.0 : 1.0e6;
            bool geomorphs = (g + v / 2) % 2 == 0;
            for (const double error_px : {0.5, 1.0, 2.0}) {
                const MeshView view = picture.view(earth_radius_m);
                const GroundMesh mesh = mesher.mesh(view, {error_px, unlimited_triangles, geomorphs});
                const test::PixelErrors found = test::pixel_errors(mesh, grounds[g], picture, earth_radius_m);
                INFO("ground " << g << ", view " << v << ", " << error_px << " px, geomorphs " << geomorphs << ", "
                               << found.samples << " samples");
                CHECK(found.samples > 500);
                CHECK(check_conformity(GroundSamples(grounds[g]), mesh, view).is_conforming());
                CHECK(found.worst_px <= error_px);
                geomorphs = !geomorphs;
            }
        }
    }
}

TEST_CASE("a mesh within a budget is as near as it says, and hardly nearer") {
    const GroundTiles ground = make_ground_tiles(waves(250.0, 0.6, 2));
    BisectionMesher mesher(ground);
    double nearest = 1.0;
    for (const test::TestPicture& picture : pictures()) {
        const GroundMesh mesh = mesher.mesh(picture.view(), {0.01, 3000, true});
        const test::PixelErrors found = test::pixel_errors(mesh, ground, picture);
        CHECK(found.worst_px <= mesh.error_px);
        nearest = std::min(nearest, found.worst_px / mesh.error_px);
    }
    CHECK(nearest > 0.5);
}

TEST_CASE("the bound in a flat picture costs few triangles beside that on a sphere") {
    const GroundTiles ground = make_ground_tiles(waves(250.0, 0.6, 2));
    BisectionMesher mesher(ground);
    int flat = 0;
    int sphere = 0;
    for (const test::TestPicture& picture : pictures()) {
        MeshView view = picture.view();
        flat += mesher.mesh(view, {1.0, unlimited_triangles, false}).counters.triangles;
        view.ahead = glm::dvec3(0.0);
        sphere += mesher.mesh(view, {1.0, unlimited_triangles, false}).counters.triangles;
    }
    INFO(flat << " and " << sphere << " triangles");
    CHECK(flat <= 1.15 * sphere);
}

} // namespace octant::visuals::terrain
