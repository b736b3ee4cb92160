#include "tests/rough_heights.h"
#include "tests/visuals/terrain/ground_check.h"
#include "tests/visuals/terrain/pixel_errors.h"
#include "visuals/terrain/bisection_mesher.h"
#include "visuals/terrain/mesh_measurement.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace octant;
using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;

namespace {

/// A picture over the middle of a map's south side, to the north.
MeshView pitched(double pitch_deg, double roll_deg = 0.0) {
    const double pitch = glm::radians(pitch_deg);
    const glm::dvec3 eye_m(0.0, -120.0, 40.0);
    MeshView view = TestPicture(eye_m, eye_m + glm::dvec3(0.0, std::cos(pitch), std::sin(pitch))).view();
    for (glm::dvec3& normal : view.frustum_normals) {
        normal = glm::angleAxis(glm::radians(roll_deg), view.ahead) * normal;
    }
    return view;
}

/// How deep inside the frustum a direction is, in degrees; below zero outside.
double inside_deg(const MeshView& view, const glm::dvec3& direction) {
    double least = 1.0;
    for (const glm::dvec3& normal : view.frustum_normals) { least = std::min(least, glm::dot(normal, direction)); }
    return glm::degrees(std::asin(least));
}

/// The direction to the north at an elevation.
glm::dvec3 direction(double elevation_deg) {
    const double elevation = glm::radians(elevation_deg);
    return {0.0, std::cos(elevation), std::sin(elevation)};
}

/// Upwards in a picture to the north that is not rolled.
glm::dvec3 up_of(const MeshView& view) { return {0.0, -view.ahead.z, view.ahead.y}; }

/// Ground as real ground is, rougher the larger the step, with one mountain in its south-west that no view to the north
/// shows.
models::heights::HeightField field_with_mountain(int size) {
    std::vector<double> heights_m(static_cast<std::size_t>(size * size), 0.0);
    for (int step = 1; step < size; step *= 2) {
        const int across = (size - 1) / step + 2;
        const auto noise_m = tests::rough_heights(across, across, static_cast<unsigned>(step), 1000);
        const auto at = [&](int column, int row) {
            return static_cast<double>(noise_m[static_cast<std::size_t>(row * across + column)]);
        };
        for (int k = 0; k < size * size; ++k) {
            const glm::dvec2 place = glm::dvec2(k % size, k / size) / static_cast<double>(step);
            const glm::ivec2 low(place);
            const glm::dvec2 share = place - glm::dvec2(low);
            const double south = glm::mix(at(low.x, low.y), at(low.x + 1, low.y), share.x);
            const double north = glm::mix(at(low.x, low.y + 1), at(low.x + 1, low.y + 1), share.x);
            heights_m[static_cast<std::size_t>(k)] += 0.002 * step * glm::mix(south, north, share.y);
        }
    }
    std::vector<float> whole_m;
    for (int k = 0; k < size * size; ++k) {
        const int off = std::max(std::abs(k % size - size / 5), std::abs(k / size - size / 5));
        const double mountain_m = 300.0 * std::max(5 - off, 0);
        whole_m.push_back(static_cast<float>(std::round(heights_m[static_cast<std::size_t>(k)]) + mountain_m));
    }
    return {size, size, 30.0, whole_m};
}

/// What happens to the mesh while a picture is turned up from a steep dive.
struct PullOut {
    double max_change_px = 0.0; ///< of the error from picture to picture
    double first_px = 0.0;
    double last_px = 0.0;
    int max_triangles = 0;
    int first_triangles = 0;
    int last_triangles = 0;
};

PullOut pull_out(BisectionMesher& mesher, bool geomorphs) {
    constexpr double step_deg = 0.2;
    PullOut found;
    double before_px = 0.0;
    for (double pitch_deg = -50.0; pitch_deg < -12.0; pitch_deg += step_deg) {
        const GroundMesh mesh = mesher.mesh(pitched(pitch_deg), {0.01, 3000, geomorphs});
        found.max_triangles = std::max(found.max_triangles, mesh.counters.triangles);
        found.last_triangles = mesh.counters.triangles;
        found.last_px = mesh.error_px;
        if (before_px == 0.0) {
            found.first_px = mesh.error_px;
            found.first_triangles = mesh.counters.triangles;
        } else {
            found.max_change_px = std::max(found.max_change_px, std::abs(mesh.error_px - before_px));
        }
        before_px = mesh.error_px;
    }
    return found;
}

} // namespace

constexpr ElevationBand far_band{glm::radians(-3.0), glm::radians(1.0)};

TEST_CASE("a view is turned until its border reaches a band and widened until it contains the band") {
    for (const double roll_deg : {0.0, 30.0, 90.0, 147.0, 180.0}) {
        for (const double pitch_deg : {-80.0, -50.0, 42.0, 75.0}) {
            INFO("roll " << roll_deg << ", pitch " << pitch_deg);
            const MeshView view = pitched(pitch_deg, roll_deg);
            const auto there = turned_to_band(view, far_band);
            REQUIRE(there);
            CHECK(glm::dot(there->view.ahead, view.ahead) == Approx(std::cos(there->turned_rad)));
            // Looking above the band, 4 degrees below it belong to it.
            const double near_deg = pitch_deg < 0.0 ? -3.0 : 1.0;
            const double end_deg = pitch_deg < 0.0 ? 1.0 : -7.0;
            const double turned_deg = pitch_deg + std::copysign(glm::degrees(there->turned_rad), near_deg - pitch_deg);
            const MeshView own = pitched(turned_deg, roll_deg);
            CHECK(inside_deg(own, direction(near_deg)) == Approx(0.0).margin(0.01));
            for (double up_deg = turned_deg; up_deg != end_deg; up_deg += std::clamp(end_deg - up_deg, -1.0, 1.0)) {
                CHECK(inside_deg(there->view, direction(up_deg)) > 0.0);
            }
            CHECK(inside_deg(there->view, direction(end_deg)) > 0.7);
        }
    }
}

TEST_CASE("a view whose border is in the band is widened and not turned") {
    for (const double pitch_deg : {-25.4, -24.0, -22.0, 23.0, 17.0}) {
        INFO("pitch " << pitch_deg);
        const MeshView view = pitched(pitch_deg);
        const auto there = turned_to_band(view, far_band);
        REQUIRE(there);
        CHECK(there->turned_rad == 0.0);
        CHECK(there->view.ahead == view.ahead);
        for (const double across_deg : {-36.0, 36.0}) {
            for (const double up_deg : {-22.4, 22.4}) {
                const glm::dvec3 corner = view.ahead + std::tan(glm::radians(up_deg)) * up_of(view) +
                                          std::tan(glm::radians(across_deg)) * glm::dvec3(1, 0, 0);
                CHECK(inside_deg(there->view, glm::normalize(corner)) > 0.0);
            }
        }
    }
}

TEST_CASE("a view with the band in the picture is not turned, nor is one without a direction") {
    for (const double pitch_deg : {-20.0, -5.0, 12.0}) { CHECK_FALSE(turned_to_band(pitched(pitch_deg), far_band)); }
    CHECK(turned_to_band(pitched(-23.0), far_band));
    CHECK_FALSE(turned_to_band(pitched(-90.0), far_band));
    MeshView everywhere = pitched(-60.0);
    everywhere.frustum_normals.fill(glm::dvec3(0.0));
    CHECK_FALSE(turned_to_band(everywhere, far_band));
    MeshView nowhere = pitched(-60.0);
    nowhere.ahead = glm::dvec3(0.0);
    CHECK_FALSE(turned_to_band(nowhere, far_band));
}

TEST_CASE("while a view is pulled out of a dive, the error within a budget changes slowly") {
    ErrorGround ground(test::spiky_field(257, 257, 6));
    const PullOut exact = pull_out(ground.mesher, false);
    const PullOut raised = pull_out(ground.mesher, true);
    INFO("exact: " << exact.first_px << " to " << exact.last_px << ", by at most " << exact.max_change_px
                   << "; raised: " << raised.first_px << " to " << raised.last_px << ", by at most "
                   << raised.max_change_px << ", " << raised.first_triangles << " to " << raised.last_triangles
                   << " triangles");
    CHECK(raised.max_change_px < 0.5 * exact.max_change_px);
    CHECK(raised.first_px > exact.first_px);
    CHECK(raised.max_triangles <= 3000);
    CHECK(raised.last_triangles >= 2970);
}

TEST_CASE("where the horizon is in the picture, or the error alone decides, nothing is raised") {
    ErrorGround ground(test::rough_field(129, 129, 3));
    HorizonError horizon(ground.tiles);
    const ErrorTarget budget{0.01, 2000, true};
    CHECK(horizon.raise_to_horizon_error(pitched(-10.0), budget) == budget);
    CHECK(horizon.raise_to_horizon_error(pitched(-60.0), budget).error_px > 0.01);
    const ErrorTarget alone{1.0, unlimited_triangles, true};
    CHECK(horizon.raise_to_horizon_error(pitched(-60.0), alone) == alone);
    const ErrorTarget rigid{0.01, 2000, false};
    CHECK(horizon.raise_to_horizon_error(pitched(-60.0), rigid) == rigid);
}

TEST_CASE("no vertex jumps by 0.25 pixels when the horizon leaves the picture below a mountain's "
          "height") {
    const ErrorGround ground(field_with_mountain(257));
    BisectionMesher mesher(ground.tiles);
    PoppingMeter meter;
    double max_px = 0.0;
    double max_change = 0.0;
    double before_px = 0.0;
    for (double pitch_deg = -26.0; pitch_deg < -17.0; pitch_deg += 0.2) {
        PerspectiveView picture;
        picture.eye_m = {0.0, -200.0, 400.0};
        picture.ahead = direction(pitch_deg);
        picture.up = {0.0, -picture.ahead.z, picture.ahead.y};
        MeshView view = pitched(pitch_deg);
        view.eye_m = picture.eye_m;
        const GroundMesh mesh = mesher.mesh(view, {0.1, 5000, true});
        if (const auto jump = meter.next(mesh, picture)) {
            max_px = std::max(max_px, jump->popping_px);
            max_change = std::max(max_change, std::abs(mesh.error_px - before_px));
        }
        before_px = mesh.error_px;
    }
    INFO("the error changes by " << max_change << " px a picture");
    CHECK(max_px < 0.1);
}
