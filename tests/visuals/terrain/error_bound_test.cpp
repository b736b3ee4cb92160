// Pixels of error by brute force: every sample in the picture against the triangle above or below
// it. Nothing here is the mesher's but the mesh and the numbers that it is asked for.
#include "models/heights/height_field.h"
#include "visuals/terrain/conformity.h"
#include "visuals/terrain/error_mesher.h"
#include "visuals/terrain/ground_builder.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace octant::visuals::terrain {

namespace {

constexpr int side = 193;
constexpr double spacing_m = 40.0;
/// While a vertex moves, the samples around it are not yet as near as with it.
constexpr double most_with_geomorphs = 1.4;
constexpr double half_m = 0.5 * (side - 1) * spacing_m;

/// Sums of waves: the lower the roughness, the faster fine ones fade.
models::heights::HeightField waves(double height_m, double roughness, unsigned seed) {
    std::vector<float> heights_m;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            double sum = 0.0;
            double amplitude = height_m;
            double frequency = 2.0 / side;
            for (unsigned octave = 0; octave < 7; ++octave) {
                const double turn = 1.7 * octave + 0.9 * seed;
                const double along = column * std::cos(turn) + row * std::sin(turn);
                const double across = row * std::cos(turn) - column * std::sin(turn);
                sum += amplitude * std::sin(6.283 * frequency * along + turn) *
                       std::cos(5.1 * frequency * across + 2.0 * turn);
                amplitude *= roughness;
                frequency *= 2.03;
            }
            heights_m.push_back(static_cast<float>(sum));
        }
    }
    return {side, side, spacing_m, heights_m};
}

/// A picture of 1280 x 720 pixels over 45 degrees.
struct Picture {
    static constexpr double focal_px = 869.117;
    static constexpr double half_width_px = 640.0;
    static constexpr double half_height_px = 360.0;

    glm::dvec3 eye_m;
    glm::dvec3 ahead;
    glm::dvec3 right;
    glm::dvec3 up;

    Picture(const glm::dvec3& eye, const glm::dvec3& look)
        : eye_m(eye)
        , ahead(glm::normalize(look - eye))
        , right(glm::normalize(glm::cross(ahead, glm::dvec3(0.0, 0.0, 1.0))))
        , up(glm::cross(right, ahead)) {}

    MeshView view() const {
        MeshView view;
        view.eye_m = eye_m;
        view.focal_px = focal_px;
        view.ahead = ahead;
        view.corner_cos = focal_px / std::hypot(focal_px, half_width_px, half_height_px);
        view.frustum_normals = {
            glm::normalize(focal_px * right + half_width_px * ahead),
            glm::normalize(-focal_px * right + half_width_px * ahead),
            glm::normalize(focal_px * up + half_height_px * ahead),
            glm::normalize(-focal_px * up + half_height_px * ahead)};
        return view;
    }

    /// Where a point relative to the eye is drawn, and how deep it lies.
    glm::dvec3 seen(const glm::dvec3& at_m) const {
        const double depth_m = glm::dot(at_m, ahead);
        return {
            focal_px * glm::dot(at_m, right) / depth_m,
            focal_px * glm::dot(at_m, up) / depth_m,
            depth_m};
    }

    bool shows(const glm::dvec3& seen_px) const {
        return seen_px.z > 10.0 && std::abs(seen_px.x) <= half_width_px &&
               std::abs(seen_px.y) <= half_height_px;
    }
};

double area2(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

struct Measured {
    double worst_px = 0.0;
    int samples = 0;
};

/// Over the samples that lie in one triangle, rim included.
void measure_triangle(
    const std::array<glm::dvec3, 3>& t,
    const GroundTiles& ground,
    const Picture& picture,
    Measured& found) {
    const auto column_of = [&](double x) { return (x + picture.eye_m.x + half_m) / spacing_m; };
    const auto row_of = [&](double y) { return (y + picture.eye_m.y + half_m) / spacing_m; };
    const double whole = area2(t[0], t[1], t[2]);
    const int west =
        static_cast<int>(std::ceil(column_of(std::min({t[0].x, t[1].x, t[2].x})) - 1e-4));
    const int east =
        static_cast<int>(std::floor(column_of(std::max({t[0].x, t[1].x, t[2].x})) + 1e-4));
    const int south =
        static_cast<int>(std::ceil(row_of(std::min({t[0].y, t[1].y, t[2].y})) - 1e-4));
    const int north =
        static_cast<int>(std::floor(row_of(std::max({t[0].y, t[1].y, t[2].y})) + 1e-4));
    for (int row = south; row <= north; ++row) {
        for (int column = west; column <= east; ++column) {
            const glm::dvec3 sample{
                column * spacing_m - half_m - picture.eye_m.x,
                row * spacing_m - half_m - picture.eye_m.y,
                static_cast<double>(ground.height_m(column, row)) - picture.eye_m.z};
            const double a = area2(sample, t[1], t[2]) / whole;
            const double b = area2(t[0], sample, t[2]) / whole;
            const double c = 1.0 - a - b;
            if (std::min({a, b, c}) < -1e-5) {
                continue;
            }
            const glm::dvec3 drawn{sample.x, sample.y, a * t[0].z + b * t[1].z + c * t[2].z};
            const glm::dvec3 there = picture.seen(sample);
            if (picture.shows(there)) {
                const glm::dvec3 here = picture.seen(drawn);
                ++found.samples;
                found.worst_px =
                    std::max(found.worst_px, std::hypot(here.x - there.x, here.y - there.y));
            }
        }
    }
}

Measured measured(const GroundMesh& mesh, const GroundTiles& ground, const Picture& picture) {
    Measured found;
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        measure_triangle(
            {glm::dvec3(mesh.vertices[mesh.indices[k]].position_m),
             glm::dvec3(mesh.vertices[mesh.indices[k + 1]].position_m),
             glm::dvec3(mesh.vertices[mesh.indices[k + 2]].position_m)},
            ground,
            picture,
            found);
    }
    return found;
}

const std::array<Picture, 8>& pictures() {
    static const std::array<Picture, 8> views = {
        {{{0.0, -3500.0, 900.0}, {300.0, 2000.0, 200.0}},
         {{-3000.0, -3000.0, 700.0}, {0.0, 0.0, 0.0}},
         {{500.0, 200.0, 2500.0}, {900.0, 900.0, 0.0}},
         {{2500.0, 100.0, 650.0}, {-3000.0, 300.0, 650.0}},
         {{0.0, 0.0, 1200.0}, {3000.0, -3000.0, 900.0}},
         {{-3700.0, 3500.0, 1500.0}, {0.0, 0.0, -500.0}},
         {{1000.0, -6000.0, 800.0}, {1000.0, 0.0, 1600.0}},
         {{100.0, 1500.0, 560.0}, {-2500.0, -1500.0, 300.0}}}};
    return views;
}

} // namespace

TEST_CASE("no sample in the picture is farther from the mesh than the error asked for, nor are "
          "there cracks") {
    const std::array<GroundTiles, 3> grounds = {
        ground_of(waves(60.0, 0.45, 1)),
        ground_of(waves(250.0, 0.6, 2)),
        ground_of(waves(180.0, 0.75, 3))};
    for (std::size_t g = 0; g < grounds.size(); ++g) {
        ErrorMesher mesher(grounds[g]);
        ConformityCheck conformity{GroundSamples(grounds[g])};
        for (std::size_t v = 0; v < pictures().size(); ++v) {
            const Picture& picture = pictures()[v];
            for (const double error_px : {0.5, 1.0, 2.0}) {
                for (const bool geomorphs : {false, true}) {
                    const GroundMesh mesh =
                        mesher.mesh(picture.view(), {error_px, any_triangles, geomorphs});
                    const Measured found = measured(mesh, grounds[g], picture);
                    INFO(
                        "ground " << g << ", view " << v << ", " << error_px << " px, geomorphs "
                                  << geomorphs << ", " << found.samples << " samples");
                    CHECK(found.samples > 500);
                    CHECK(conformity.check(mesh, picture.view()).is_whole());
                    CHECK(found.worst_px <= error_px * (geomorphs ? most_with_geomorphs : 1.0));
                }
            }
        }
    }
}

TEST_CASE("the bound in a flat picture costs few triangles beside that on a sphere") {
    const GroundTiles ground = ground_of(waves(250.0, 0.6, 2));
    ErrorMesher mesher(ground);
    int flat = 0;
    int sphere = 0;
    for (const Picture& picture : pictures()) {
        MeshView view = picture.view();
        flat += mesher.mesh(view, {1.0, any_triangles, false}).counters.triangles;
        view.ahead = glm::dvec3(0.0);
        sphere += mesher.mesh(view, {1.0, any_triangles, false}).counters.triangles;
    }
    INFO(flat << " and " << sphere << " triangles");
    CHECK(flat <= 1.15 * sphere);
}

} // namespace octant::visuals::terrain
