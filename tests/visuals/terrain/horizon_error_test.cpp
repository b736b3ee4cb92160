#include "tests/visuals/terrain/error_ground.h"
#include "tests/visuals/terrain/pixel_errors.h"
#include "visuals/terrain/horizon_error.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;

namespace {

/// A picture over the middle of a map's south side, to the north.
MeshView pitched(double pitch_deg, double roll_deg = 0.0) {
    const double pitch = glm::radians(pitch_deg);
    const glm::dvec3 eye_m(0.0, -120.0, 40.0);
    MeshView view =
        TestPicture(eye_m, eye_m + glm::dvec3(0.0, std::cos(pitch), std::sin(pitch))).view();
    for (glm::dvec3& normal : view.frustum_normals) {
        normal = glm::angleAxis(glm::radians(roll_deg), view.ahead) * normal;
    }
    return view;
}

/// How deep inside the frustum a direction is, in degrees; below zero outside.
double inside_deg(const MeshView& view, const glm::dvec3& direction) {
    double least = 1.0;
    for (const glm::dvec3& normal : view.frustum_normals) {
        least = std::min(least, glm::dot(normal, direction));
    }
    return glm::degrees(std::asin(least));
}

/// What happens to the mesh while a picture is turned up from a steep dive.
struct PullOut {
    double most_change_px = 0.0; ///< of the error from picture to picture
    double first_px = 0.0;
    double last_px = 0.0;
    int most_triangles = 0;
    int first_triangles = 0;
    int last_triangles = 0;
};

PullOut pull_out(ErrorMesher& mesher, bool geomorphs) {
    constexpr double step_deg = 0.2;
    PullOut found;
    double before_px = 0.0;
    for (double pitch_deg = -50.0; pitch_deg < -12.0; pitch_deg += step_deg) {
        const GroundMesh mesh = mesher.mesh(pitched(pitch_deg), {0.01, 3000, geomorphs});
        found.most_triangles = std::max(found.most_triangles, mesh.counters.triangles);
        found.last_triangles = mesh.counters.triangles;
        found.last_px = mesh.error_px;
        if (before_px == 0.0) {
            found.first_px = mesh.error_px;
            found.first_triangles = mesh.counters.triangles;
        } else {
            found.most_change_px =
                std::max(found.most_change_px, std::abs(mesh.error_px - before_px));
        }
        before_px = mesh.error_px;
    }
    return found;
}

} // namespace

TEST_CASE("a view is turned by as little as brings a line into the picture, however it is rolled") {
    for (const double roll_deg : {0.0, 30.0, 90.0, 147.0, 180.0}) {
        for (const double pitch_deg : {-80.0, -50.0, 42.0, 75.0}) {
            INFO("roll " << roll_deg << ", pitch " << pitch_deg);
            const MeshView view = pitched(pitch_deg, roll_deg);
            const auto there = turned_to(view, glm::radians(-3.0));
            REQUIRE(there);
            const glm::dvec3 line(0.0, std::cos(glm::radians(-3.0)), std::sin(glm::radians(-3.0)));
            CHECK(inside_deg(view, line) < 0.0);
            CHECK(inside_deg(there->view, line) > 0.7);
            CHECK(inside_deg(there->view, line) < 1.001);
            CHECK(glm::dot(there->view.ahead, view.ahead) == Approx(std::cos(there->turned_rad)));
            CHECK(
                inside_deg(there->view, there->view.ahead) == Approx(inside_deg(view, view.ahead)));
        }
    }
}

TEST_CASE("a view with the line in the picture is not turned, nor is one without a direction") {
    for (const double pitch_deg : {-21.0, -5.0, 12.0}) {
        CHECK_FALSE(turned_to(pitched(pitch_deg), 0.0));
    }
    CHECK(turned_to(pitched(-23.0), 0.0));
    CHECK_FALSE(turned_to(pitched(-90.0), 0.0));
    MeshView everywhere = pitched(-60.0);
    everywhere.frustum_normals.fill(glm::dvec3(0.0));
    CHECK_FALSE(turned_to(everywhere, 0.0));
    MeshView nowhere = pitched(-60.0);
    nowhere.ahead = glm::dvec3(0.0);
    CHECK_FALSE(turned_to(nowhere, 0.0));
}

TEST_CASE("while a view is pulled out of a dive, the error within a budget changes slowly") {
    ErrorGround ground(test::spiky_field(257, 257, 6));
    const PullOut exact = pull_out(ground.mesher, false);
    const PullOut eased = pull_out(ground.mesher, true);
    INFO(
        "exact: " << exact.first_px << " to " << exact.last_px << ", by at most "
                  << exact.most_change_px << "; eased: " << eased.first_px << " to "
                  << eased.last_px << ", by at most " << eased.most_change_px << ", "
                  << eased.first_triangles << " to " << eased.last_triangles << " triangles");
    CHECK(eased.most_change_px < 0.5 * exact.most_change_px);
    CHECK(eased.first_px > exact.first_px);
    CHECK(eased.most_triangles <= 3000);
    CHECK(eased.last_triangles >= 2970);
}

TEST_CASE("where the horizon is in the picture, or the error alone decides, nothing is eased") {
    ErrorGround ground(test::rough_field(129, 129, 3));
    HorizonError horizon(ground.tiles);
    const ErrorTarget budget{0.01, 2000, true};
    CHECK(horizon.eased(pitched(-10.0), budget) == budget);
    CHECK(horizon.eased(pitched(-60.0), budget).error_px > 0.01);
    const ErrorTarget alone{1.0, any_triangles, true};
    CHECK(horizon.eased(pitched(-60.0), alone) == alone);
    const ErrorTarget rigid{0.01, 2000, false};
    CHECK(horizon.eased(pitched(-60.0), rigid) == rigid);
}
