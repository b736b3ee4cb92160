#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/dataset/camera_rigs.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::ui::dataset;
using Catch::Contains;

namespace {

std::vector<CameraRig> rigs_from(const std::string& text) {
    const auto file = tests::scratch_file("ring.toml");
    write_file(file, text);
    return read_camera_rigs(file, Camera());
}

/// Ground at a height of 100 m within 5 km of the middle.
RigGround flat_ground() {
    return {[](double x_m, double y_m) {
                return std::abs(x_m) <= 5000.0 && std::abs(y_m) <= 5000.0 ? std::optional(100.0) : std::nullopt;
            },
        {5000.0, 5000.0}};
}

/// An aircraft in flight on a heading, 1 km above the datum.
sim::AircraftState flying(double heading_deg, double bank_deg = 0.0) {
    sim::AircraftState state;
    state.position_m = {200.0, -300.0, 1000.0};
    state.body_to_world = body_to_world_from_euler({glm::radians(heading_deg), 0.0, glm::radians(bank_deg)});
    return state;
}

glm::dvec3 vector(const Vec3& v) { return {v.x, v.y, v.z}; }

glm::dquat rotation(const Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

Pose placed(
    const CameraRig& rig, const sim::AircraftState& now, const sim::AircraftState& before, std::uint64_t index = 0) {
    return pose_of(rig, {1, index}, std::span(&now, 1), std::span(&before, 1), 0.5, flat_ground());
}

/// The point in the camera's axes: x ahead, y right, z down.
glm::dvec3 in_camera(const Pose& pose, const glm::dvec3& point_m) {
    return glm::conjugate(rotation(pose.attitude)) * (point_m - vector(pose.eye_m));
}

} // namespace

TEST_CASE("a file of cameras gives lenses, mounts and rings") {
    const auto rigs = rigs_from(R"(
[[camera]]
name = "nose"
mount = "aircraft"
at = [8.0, 0.0, 0.5]
pitch = -20
size = "320x240"
matrix = [300, 310, 159.5, 119.5]
distortion = "brown-conrady"
coefficients = [-0.1, 0.01]
[[camera]]
name = "around"
mount = "ring"
count = 3
distance = [30, 50]
elevation = 15
fov = 40
samples = 4
[[camera]]
mount = "ground"
)");
    REQUIRE(rigs.size() == 5);
    CHECK(rigs[0].camera.width == 320);
    REQUIRE(rigs[0].camera.intrinsics);
    CHECK(rigs[0].camera.intrinsics->fy == 310.0);
    CHECK(rigs[0].camera.coefficients == std::vector{-0.1, 0.01});
    CHECK(rigs[1].name == "around-1");
    CHECK(rigs[3].name == "around-3");
    CHECK(rigs[3].azimuth_deg.low == 240.0);
    CHECK(rigs[3].distance_m.high == 50.0);
    CHECK(rigs[2].camera.fov_deg == 40.0);
    CHECK(rigs[2].camera.samples == 4);
    CHECK(rigs[4].name == "camera-3");
    CHECK(rigs[4].height_m.high == 300.0);
}

TEST_CASE("a wrong file of cameras is refused with its line") {
    const auto refused = [](const std::string& text, const std::string& expected) {
        INFO(text);
        CHECK_THROWS_WITH(rigs_from(text), Contains("ring.toml:") && Contains(expected));
    };
    refused("", ":1: expected [[camera]] tables, got none");
    refused("a = 1", ":1: expected [[camera]] tables, got 'a'");
    refused("[[camera]]\nmount = 'chase'\ncolour = 1", ":3: expected a key of a chase camera");
    refused("[[camera]]\nname = 'x'", ":1: expected a mount");
    refused(
        "[[camera]]\nmount = 'tail'", ":2: mount: expected aircraft, chase, ring, orbit, random, ground, got 'tail'");
    refused("[[camera]]\nmount = 'chase'\ndistance = [50, 30]", ":3: distance: expected the low end first");
    refused("[[camera]]\nmount = 'chase'\ndistance = 'far'", ":3: distance: expected a number from 1 to");
    refused("[[camera]]\nmount = 'chase'\nfov = 40\nmatrix = [1, 1, 0, 0]", ":4: expected fov or matrix, got both");
    refused("[[camera]]\nmount = 'chase'\nmatrix = [0, 1, 0, 0]", ":3: matrix: expected");
    refused("[[camera]]\nmount = 'chase'\nsize = '640'", ":3: size: expected WIDTHxHEIGHT");
    refused("[[camera]]\nmount = 'chase'\nsize = '0x9'", ":3: size: expected");
    refused("[[camera]]\nmount = 'chase'\nsamples = 3", ":3: samples: expected 1, 4, 16, got 3");
    refused("[[camera]]\nmount = 'chase'\ncoefficients = [0.1]", ":3: expected distortion");
    refused("[[camera]]\nmount = 'chase'\nname = 'a/b'", ":3: name: expected letters");
    refused("[[camera]]\nmount = 'chase'\nname = 'a'\n[[camera]]\nmount = 'chase'\nname = 'a'",
        ":4: expected a name for each camera, got 'a' again");
    refused("[[camera]\nmount", ":1: expected TOML");
}

TEST_CASE("a camera fixed to an aircraft turns with it") {
    CameraRig rig;
    rig.mount = Mount::Aircraft;
    rig.at_m = {8.0, 0.0, -1.0};
    rig.heading_deg = {90.0, 90.0};
    const sim::AircraftState state = flying(90.0, 90.0); // flies east, right wing down
    const Pose pose = placed(rig, state, state);
    CHECK(glm::distance(vector(pose.eye_m), state.position_m + glm::dvec3(8.0, -1.0, 0.0)) < 1e-9);
    CHECK(glm::distance(rotation(pose.attitude) * glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, -1.0)) < 1e-9);
}

TEST_CASE("cameras around an aircraft see it where their aim says, at their distance") {
    for (const Mount mount : {Mount::Chase, Mount::Orbit, Mount::Random}) {
        CameraRig rig;
        rig.mount = mount;
        rig.distance_m = {30.0, 60.0};
        rig.azimuth_deg = {0.0, 360.0};
        rig.elevation_deg = {-20.0, 60.0};
        rig.camera.fov_deg = 40.0;
        const sim::AircraftState state = flying(30.0);
        for (std::uint64_t index = 0; index < 50; ++index) {
            const glm::dvec3 middle = in_camera(placed(rig, state, state, index), state.position_m);
            CHECK(std::hypot(middle.y, middle.z) < 1e-9);
            CHECK(middle.x >= 30.0);
            CHECK(middle.x <= 60.0);
        }
        rig.aim = 0.5;
        double farthest = 0.0;
        for (std::uint64_t index = 0; index < 200; ++index) {
            const Pose pose = placed(rig, state, state, index);
            const glm::dvec3 off = in_camera(pose, state.position_m);
            farthest = std::max(farthest, std::hypot(off.y, off.z) / off.x);
            CHECK(std::abs((rotation(pose.attitude) * glm::dvec3(0.0, 1.0, 0.0)).z) < 1e-9); // a level horizon
        }
        const double half = std::tan(glm::radians(20.0));
        CHECK(farthest < 0.75 * half); // at most half to the right and half upwards
        CHECK(farthest > 0.5 * half);
    }
}

TEST_CASE("a chase camera is behind the aircraft, also when that turns; an orbiting one stays where it is") {
    CameraRig rig;
    rig.distance_m = {40.0, 40.0};
    const Pose behind = placed(rig, flying(90.0), flying(90.0));
    CHECK(glm::distance(vector(behind.eye_m), flying(90.0).position_m - glm::dvec3(40.0, 0.0, 0.0)) < 1e-9);
    rig.mount = Mount::Orbit;
    const Pose north = placed(rig, flying(90.0), flying(90.0));
    CHECK(glm::distance(vector(north.eye_m), flying(90.0).position_m + glm::dvec3(0.0, 40.0, 0.0)) < 1e-9);
}

TEST_CASE("no eye is below 2 m above the ground, and ground cameras are where their file says") {
    CameraRig rig;
    rig.distance_m = {40.0, 40.0};
    rig.elevation_deg = {-80.0, -80.0};
    sim::AircraftState low = flying(0.0);
    low.position_m.z = 110.0;
    CHECK(placed(rig, low, low).eye_m.z == 102.0);
    rig.mount = Mount::Ground;
    rig.height_m = {30.0, 300.0};
    rig.pitch_deg = {-30.0, 5.0};
    for (std::uint64_t index = 0; index < 100; ++index) {
        const Pose pose = placed(rig, low, low, index);
        CHECK(std::abs(pose.eye_m.x) <= 4000.0);
        CHECK(pose.eye_m.z >= 130.0);
        CHECK(pose.eye_m.z <= 400.0);
        CHECK((rotation(pose.attitude) * glm::dvec3(1.0, 0.0, 0.0)).z <= std::sin(glm::radians(5.0)) + 1e-12);
    }
}

TEST_CASE("a pose knows the previous one, its velocity and its turn") {
    CameraRig rig;
    rig.mount = Mount::Aircraft;
    sim::AircraftState now = flying(31.0);
    const sim::AircraftState before = flying(30.0);
    now.position_m += glm::dvec3(50.0, 0.0, 0.0);
    const Pose pose = placed(rig, now, before);
    REQUIRE(pose.previous_eye_m);
    CHECK(glm::distance(vector(*pose.previous_eye_m), before.position_m) < 1e-9);
    CHECK(glm::distance(vector(pose.velocity_mps), glm::dvec3(100.0, 0.0, 0.0)) < 1e-9);
    CHECK(glm::distance(vector(pose.turn_rate_degps), glm::dvec3(0.0, 0.0, 2.0)) < 1e-6);
}

TEST_CASE("cameras of one name draw the same numbers whatever else a file has") {
    const auto one = rigs_from("[[camera]]\nname = 'a'\nmount = 'random'\n");
    const auto two = rigs_from("[[camera]]\nname = 'b'\nmount = 'random'\n[[camera]]\nname = 'a'\nmount = 'random'\n");
    const sim::AircraftState state = flying(0.0);
    CHECK(vector(placed(one[0], state, state).eye_m) == vector(placed(two[1], state, state).eye_m));
    CHECK(vector(placed(two[0], state, state).eye_m) != vector(placed(two[1], state, state).eye_m));
}
