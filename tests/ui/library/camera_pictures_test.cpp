#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <octant/octant.h>
#include <set>
#include <string>
#include <vector>

using namespace octant;

namespace {

constexpr Output every_output =
    Output::Rgb | Output::Depth | Output::ClassId | Output::ObjectId | Output::Normal | Output::Flow | Output::Coverage;

glm::dvec3 as_glm(const Vec3& v) { return {v.x, v.y, v.z}; }

glm::dquat as_glm(const Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

Vec3 moved(const Vec3& from, const Vec3& velocity, double by_s) {
    return {from.x + velocity.x * by_s, from.y + velocity.y * by_s, from.z + velocity.z * by_s};
}

/// A pose at another time, by its velocity and turn rate.
Pose at_time(const Pose& pose, double by_s) {
    Pose later = pose;
    later.eye_m = moved(pose.eye_m, pose.velocity_mps, by_s);
    const glm::dvec3 turn = as_glm(pose.turn_rate_degps) * (by_s * 3.14159265358979323846 / 180.0);
    if (glm::length(turn) > 0.0) {
        const glm::dquat q = as_glm(pose.attitude) * glm::angleAxis(glm::length(turn), glm::normalize(turn));
        later.attitude = {q.w, q.x, q.y, q.z};
    }
    return later;
}

Camera barrel(int width, int height) {
    Camera camera{width, height};
    camera.intrinsics = Intrinsics{0.8 * width, 0.82 * width, 0.49 * width, 0.52 * height};
    camera.distortion = Distortion::BrownConrady;
    camera.coefficients = {-0.2, 0.03, 0.002, -0.001};
    return camera;
}

Camera fisheye(int side) {
    Camera camera{side, side};
    camera.intrinsics = Intrinsics{0.3 * side, 0.3 * side, 0.5 * side, 0.5 * side};
    camera.distortion = Distortion::Fisheye;
    camera.coefficients = {0.02, -0.004};
    return camera;
}

struct Scene {
    World world;
    Pose pose;
    std::vector<State> states;
};

/// An F-15 aside of the middle, over hills.
Scene f15_over_hills(bool is_moving) {
    Scene scene{World({.terrain = "hills", .aircraft = {"f15"}, .triangles = 2000}), {}, {}};
    const double ground_m = scene.world.height_m(100.0, 200.0);
    State state;
    state.position_m = {100.0, 200.0, ground_m + 150.0};
    state.attitude = attitude(60.0, 5.0, 25.0);
    scene.pose.eye_m = {70.0, 130.0, ground_m + 190.0};
    const glm::dquat aside = as_glm(look_at(scene.pose.eye_m, state.position_m)) *
                             glm::angleAxis(0.2, glm::normalize(glm::dvec3(0.0, 0.6, 1.0)));
    scene.pose.attitude = {aside.w, aside.x, aside.y, aside.z};
    scene.pose.previous_eye_m = {69.0, 128.0, ground_m + 190.5};
    if (is_moving) {
        state.velocity_mps = {80.0, 40.0, 5.0};
        scene.pose.velocity_mps = {70.0, 45.0, 0.0};
        scene.pose.turn_rate_degps = {60.0, -40.0, 90.0};
    }
    scene.states = {state};
    scene.world.set_states(scene.states);
    return scene;
}

std::string refusal_of(const auto& function) {
    try {
        function();
    } catch (const Error& fault) { return fault.what(); }
    return "no error";
}

struct Extent {
    double min_x = 1e9;
    double min_y = 1e9;
    double max_x = -1e9;
    double max_y = -1e9;

    void add(double x, double y) {
        min_x = std::min(min_x, x);
        min_y = std::min(min_y, y);
        max_x = std::max(max_x, x);
        max_y = std::max(max_y, y);
    }
};

double light_of(double value) { return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4); }

double value_of(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

} // namespace

TEST_CASE("a camera projects its pixels' rays to these pixels") {
    for (const Camera& camera : {Camera{64, 48, 70.0}, barrel(64, 48), fisheye(64)}) {
        for (const double column : {0.0, 20.5, 63.0}) {
            for (const double row : {0.0, 30.25, 47.0}) {
                const Vec3 ray = camera.ray(column, row);
                const auto back = camera.project({5.0 * ray.x, 5.0 * ray.y, 5.0 * ray.z});
                REQUIRE(back);
                CHECK(std::abs(back->first - column) < 1e-9);
                CHECK(std::abs(back->second - row) < 1e-9);
            }
        }
    }
    CHECK_FALSE(Camera{64, 48, 70.0}.project({0.0, 0.0, -1.0}));
    CHECK(Camera{64, 48, 70.0}.ray(31.5, 23.5).x == 0.0);
}

TEST_CASE("a camera that cannot be is refused in one line") {
    const World world({.terrain = "hills"});
    const auto failure = [&](Camera camera) { return refusal_of([&] { world.render(camera, std::vector<Pose>(1)); }); };
    Camera camera = barrel(64, 48);
    camera.coefficients[0] = -0.9;
    CHECK(failure(camera).find("camera: expected a distortion that is one to one "
                               "over the picture") == 0);
    camera.coefficients.assign(6, 0.0);
    CHECK(failure(camera) == "camera: coefficients: expected at most 5, as many as the distortion has, got 6");
    camera = Camera{};
    camera.coefficients = {0.1};
    CHECK(failure(camera) == "camera: coefficients: expected at most 0, as many as the distortion has, got 1");
    camera = Camera{};
    camera.noise = -0.1;
    CHECK(failure(camera) == "camera: noise: expected 0 to 1, got -0.1");
    camera = Camera{};
    camera.blur_frames = 0;
    CHECK(failure(camera) == "camera: blur_frames: expected 1 to 256, got 0");
    camera = Camera{};
    camera.exposure = std::numeric_limits<double>::quiet_NaN();
    CHECK(failure(camera) == "camera: exposure: expected 0 to 1000000, got nan");
}

TEST_CASE("an aircraft lies in a distorted picture where its points are "
          "projected to") {
    const Scene scene = f15_over_hills(false);
    // The aircraft's surface from a fine picture without distortion.
    const Camera plain{1200, 900, 75.0};
    const Frames points = scene.world.render(plain, {&scene.pose, 1}, Output::Depth | Output::ObjectId);
    for (const Camera& camera : {barrel(320, 240), fisheye(400)}) {
        Extent expected;
        for (int row = 0; row < plain.height; ++row) {
            for (int column = 0; column < plain.width; ++column) {
                const auto i = static_cast<std::size_t>(row * plain.width + column);
                if (points.object_id[i] == 0) { continue; }
                const Vec3 ray = plain.ray(column, row);
                const double depth_m = points.depth_m[i];
                const auto at = camera.project({ray.x * depth_m, ray.y * depth_m, depth_m});
                REQUIRE(at);
                expected.add(at->first, at->second);
            }
        }
        REQUIRE(expected.max_x - expected.min_x > 20.0);
        const Frames seen = scene.world.render(camera, {&scene.pose, 1}, every_output);
        Extent found;
        int wrong_depths = 0;
        int aircraft_pixels = 0;
        const glm::dquat to_world = as_glm(to_opencv(scene.pose.attitude));
        for (int row = 0; row < camera.height; ++row) {
            for (int column = 0; column < camera.width; ++column) {
                const auto i = static_cast<std::size_t>(row * camera.width + column);
                if (seen.object_id[i] == 0) { continue; }
                ++aircraft_pixels;
                found.add(column, row);
                CHECK(seen.class_id[i] == 7);
                CHECK((seen.coverage[i] > 0.0F && seen.coverage[i] <= 1.0F));
                // The point lies in the aircraft's box.
                const Vec3 ray = camera.ray(column, row);
                const glm::dvec3 point = as_glm(scene.pose.eye_m) + to_world * (as_glm(ray) * double{seen.depth_m[i]});
                const glm::dvec3 in_body =
                    glm::conjugate(as_glm(scene.states[0].attitude)) * (point - as_glm(scene.states[0].position_m));
                const Object& object = scene.world.objects()[0];
                const glm::dvec3 off = glm::abs(in_body - as_glm(object.box_centre_m)) - 0.5 * as_glm(object.size_m);
                wrong_depths += std::max({off.x, off.y, off.z}) > 0.02 ? 1 : 0;
            }
        }
        CAPTURE(expected.min_x, found.min_x, expected.max_x, found.max_x, expected.min_y, found.min_y, expected.max_y,
            found.max_y);
        CHECK(std::abs(expected.min_x - found.min_x) < 1.0);
        CHECK(std::abs(expected.max_x - found.max_x) < 1.0);
        CHECK(std::abs(expected.min_y - found.min_y) < 1.0);
        CHECK(std::abs(expected.max_y - found.max_y) < 1.0);
        CHECK(aircraft_pixels > 100);
        CHECK(wrong_depths == 0);
    }
}

TEST_CASE("the flow of a distorted picture is that of the projected surface") {
    const Scene scene = f15_over_hills(false);
    RenderOptions options;
    options.states = scene.states;
    for (const Camera& camera : {barrel(160, 120), fisheye(160)}) {
        const Frames seen = scene.world.render(camera, {&scene.pose, 1}, Output::Depth | Output::Flow, options);
        const glm::dquat to_world = as_glm(to_opencv(scene.pose.attitude));
        int wrong = 0;
        int compared = 0;
        for (int row = 0; row < camera.height; ++row) {
            for (int column = 0; column < camera.width; ++column) {
                const auto i = static_cast<std::size_t>(row * camera.width + column);
                const Vec3 ray = camera.ray(column, row);
                if (!std::isfinite(seen.depth_m[i])) { continue; }
                const glm::dvec3 point = as_glm(scene.pose.eye_m) + to_world * (as_glm(ray) * double{seen.depth_m[i]});
                const glm::dvec3 before = glm::conjugate(to_world) * (point - as_glm(*scene.pose.previous_eye_m));
                const auto at = camera.project({before.x, before.y, before.z});
                if (!at || std::isnan(seen.flow_px[2 * i])) { continue; }
                const double off_px = std::hypot(column - at->first - double{seen.flow_px[2 * i]},
                    row - at->second - double{seen.flow_px[2 * i + 1]});
                wrong += off_px > 0.01 ? 1 : 0;
                ++compared;
            }
        }
        CHECK(compared > 5000);
        CHECK(wrong * 3000 < compared); // planes that are seen from the side, at their edges
    }
}

TEST_CASE("each row of a rolling shutter's picture is that of its own pose") {
    const Scene scene = f15_over_hills(true);
    Camera camera{160, 120, 60.0};
    camera.row_time_s = 5e-4;
    RenderOptions options;
    options.states = scene.states;
    const Frames rolling = scene.world.render(camera, {&scene.pose, 1}, Output::Rgb | Output::ObjectId, options);
    Camera instant = camera;
    instant.row_time_s = 0.0;
    const Frames still = scene.world.render(instant, {&scene.pose, 1}, Output::Rgb | Output::ObjectId, options);
    double difference = 0.0;
    double still_difference = 0.0;
    int wrong_objects = 0;
    int still_wrong_objects = 0;
    for (int row = 0; row < camera.height; ++row) {
        const double time_s = (row - 0.5 * (camera.height - 1)) * camera.row_time_s;
        std::vector<State> states = scene.states;
        states[0].position_m = moved(states[0].position_m, states[0].velocity_mps, time_s);
        RenderOptions then;
        then.states = states;
        const Pose pose = at_time(scene.pose, time_s);
        const Frames own = scene.world.render(instant, {&pose, 1}, Output::Rgb | Output::ObjectId, then);
        for (int column = 0; column < camera.width; ++column) {
            const auto i = static_cast<std::size_t>(row * camera.width + column);
            wrong_objects += own.object_id[i] != rolling.object_id[i] ? 1 : 0;
            still_wrong_objects += own.object_id[i] != still.object_id[i] ? 1 : 0;
            for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
                difference += std::abs(own.rgb[k] - rolling.rgb[k]);
                still_difference += std::abs(own.rgb[k] - still.rgb[k]);
            }
        }
    }
    CAPTURE(difference, still_difference, wrong_objects, still_wrong_objects);
    CHECK(still_wrong_objects > 20);
    CHECK(wrong_objects * 6 < still_wrong_objects);
    CHECK(difference * 4 < still_difference);
}

TEST_CASE("a blurred picture is the mean light of pictures in the shutter's time") {
    const Scene scene = f15_over_hills(true);
    Camera camera{80, 60, 60.0};
    camera.shutter_s = 0.04;
    camera.blur_frames = 4;
    camera.exposure = 0.7;
    RenderOptions options;
    options.states = scene.states;
    const Frames blurred = scene.world.render(camera, {&scene.pose, 1}, Output::Rgb | Output::ObjectId, options);
    std::vector<double> light(blurred.rgb.size(), 0.0);
    for (int frame = 0; frame < 4; ++frame) {
        const double time_s = ((frame + 0.5) / 4.0 - 0.5) * camera.shutter_s;
        std::vector<State> states = scene.states;
        states[0].position_m = moved(states[0].position_m, states[0].velocity_mps, time_s);
        states[0].time_s += time_s;
        RenderOptions then;
        then.states = states;
        const Pose pose = at_time(scene.pose, time_s);
        const Frames own = scene.world.render(Camera{80, 60, 60.0}, {&pose, 1}, Output::Rgb, then);
        for (std::size_t i = 0; i < light.size(); ++i) { light[i] += 0.7 * light_of(own.rgb[i] / 255.0) / 4.0; }
    }
    int worst = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        worst = std::max(worst, std::abs(blurred.rgb[i] - static_cast<int>(std::lround(255.0 * value_of(light[i])))));
    }
    CHECK(worst <= 1);
    // The truth is that of the middle of the time.
    const Frames still = scene.world.render(Camera{80, 60, 60.0}, {&scene.pose, 1}, Output::ObjectId, options);
    CHECK(blurred.object_id == still.object_id);
}

TEST_CASE("a picture with 16 bits is that with 8 bits with levels between") {
    const Scene scene = f15_over_hills(false);
    for (Camera camera : {Camera{80, 60, 60.0}, barrel(80, 60)}) {
        const Frames bytes = scene.world.render(camera, {&scene.pose, 1});
        camera.bits = 16;
        const Frames deep = scene.world.render(camera, {&scene.pose, 1});
        CHECK(deep.rgb.empty());
        REQUIRE(deep.rgb16.size() == bytes.rgb.size());
        int worst = 0;
        std::set<std::uint16_t> levels;
        for (std::size_t i = 0; i < bytes.rgb.size(); ++i) {
            worst = std::max(worst, std::abs(deep.rgb16[i] - bytes.rgb[i] * 257));
            levels.insert(deep.rgb16[i]);
        }
        CHECK(worst <= 257);
        CHECK(levels.size() > 1000);
    }
}

TEST_CASE("the noise of a picture is that of its seed and number, in all "
          "batches and on all threads") {
    const Scene scene = f15_over_hills(true);
    Camera camera = barrel(60, 45);
    camera.noise = 0.02;
    camera.exposure = 1.5;
    camera.row_time_s = 1e-4;
    camera.shutter_s = 0.01;
    camera.blur_frames = 2;
    const std::vector<Pose> poses(5, scene.pose);
    RenderOptions options;
    options.noise_seed = 4;
    options.states = scene.states;
    options.threads = 1;
    const Frames together = scene.world.render(camera, poses, every_output, options);
    options.threads = 3;
    CHECK(scene.world.render(camera, poses, every_output, options).rgb == together.rgb);
    const std::size_t values = together.rgb.size() / 5;
    std::set<std::vector<std::uint8_t>> different;
    for (std::size_t i = 0; i < 5; ++i) {
        options.first_index = i;
        const Frames alone = scene.world.render(camera, {&poses[i], 1}, every_output, options);
        const auto first = together.rgb.begin() + static_cast<std::ptrdiff_t>(i * values);
        CHECK(std::equal(alone.rgb.begin(), alone.rgb.end(), first));
        different.insert(alone.rgb);
        CHECK(std::equal(alone.depth_m.begin(), alone.depth_m.end(), together.depth_m.begin()));
    }
    CHECK(different.size() == 5);
    options.first_index = 0;
    options.noise_seed = 5;
    CHECK(different.count(scene.world.render(camera, {&poses[0], 1}, Output::Rgb, options).rgb) == 0);
}

TEST_CASE("a distorted picture with 16 bits has the levels of its faces, not of 256 steps") {
    const Scene scene = f15_over_hills(false);
    Camera plain{160, 120, 60.0};
    plain.bits = 16;
    Camera lens = plain;
    lens.distortion = Distortion::BrownConrady; // without coefficients: the same picture, but by a face
    const Frames expected = scene.world.render(plain, {&scene.pose, 1}, Output::Rgb | Output::ClassId);
    const Frames found = scene.world.render(lens, {&scene.pose, 1});
    std::vector<int> differences;
    for (std::size_t i = 0; i < expected.class_id.size(); ++i) {
        if (expected.class_id[i] != 0) { continue; } // the sky changes slowly
        for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
            differences.push_back(std::abs(expected.rgb16[k] - found.rgb16[k]));
        }
    }
    REQUIRE(differences.size() > 1000);
    std::ranges::nth_element(differences, differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2));
    CHECK(differences[differences.size() / 2] < 16); // steps of 257 would be off by 64
}

namespace {

/// The rectangle of an object's pixels, as Box::visible_px.
Extent shown_extent(const Frames& frames, int& pixels) {
    Extent extent;
    pixels = 0;
    for (int row = 0; row < frames.height; ++row) {
        for (int column = 0; column < frames.width; ++column) {
            if (frames.object_id[static_cast<std::size_t>(row * frames.width + column)] == 0) { continue; }
            extent.add(column, row);
            extent.add(column + 1, row + 1);
            ++pixels;
        }
    }
    return extent;
}

/// The rectangle of a box's edges in a picture.
Extent edge_extent(const Box& box, const Camera& camera, const Pose& pose) {
    const glm::dquat to_camera = glm::conjugate(as_glm(to_opencv(pose.attitude)));
    Extent extent;
    for (unsigned a = 0; a < 8; ++a) {
        for (const unsigned bit : {1U, 2U, 4U}) {
            for (int i = 0; i <= 1000; ++i) {
                const glm::dvec3 at =
                    glm::mix(as_glm(box.corners_m[a]), as_glm(box.corners_m[a ^ bit]), static_cast<double>(i) / 1000.0);
                const glm::dvec3 seen = to_camera * (at - as_glm(pose.eye_m));
                if (const auto px = camera.project({seen.x, seen.y, seen.z})) {
                    extent.add(px->first + 0.5, px->second + 0.5);
                }
            }
        }
    }
    return extent;
}

} // namespace

TEST_CASE("boxes of distorted and rolling pictures are those of their object ids and of the projected box") {
    const Scene scene = f15_over_hills(true);
    Camera rolling{320, 240, 60.0};
    rolling.row_time_s = 3e-4;
    Camera both = barrel(320, 240);
    both.row_time_s = -2e-4;
    for (const Camera& camera : {barrel(320, 240), fisheye(400), rolling, both}) {
        const std::vector<Box> boxes = scene.world.boxes(camera, {&scene.pose, 1}).front();
        REQUIRE(boxes.size() == 1);
        const Box& box = boxes[0];
        int pixels = 0;
        const Extent seen = shown_extent(scene.world.render(camera, {&scene.pose, 1}, Output::ObjectId), pixels);
        CHECK(box.pixels == pixels);
        CHECK(pixels > 100);
        CHECK((box.visible_px[0] == seen.min_x && box.visible_px[1] == seen.min_y));
        CHECK((box.visible_px[2] == seen.max_x && box.visible_px[3] == seen.max_y));
        CHECK(box.visible_share == 1.0);
        CHECK(box.truncation == 0.0);
        const Extent whole = edge_extent(box, camera, scene.pose);
        CHECK(box.whole_px[0] == Approx(whole.min_x).margin(0.02));
        CHECK(box.whole_px[1] == Approx(whole.min_y).margin(0.02));
        CHECK(box.whole_px[2] == Approx(whole.max_x).margin(0.02));
        CHECK(box.whole_px[3] == Approx(whole.max_y).margin(0.02));
    }
}

TEST_CASE("the share of an aircraft outside a distorted picture is that of a larger picture by the same lens") {
    Scene scene = f15_over_hills(false);
    for (const Camera& large : {barrel(640, 480), fisheye(600)}) {
        const Box whole = scene.world.boxes(large, {&scene.pose, 1}).front().at(0);
        REQUIRE(whole.truncation == 0.0);
        Camera small = large; // ends in the middle of the aircraft
        small.width = static_cast<int>(0.5 * (whole.visible_px[0] + whole.visible_px[2]));
        const Box part = scene.world.boxes(small, {&scene.pose, 1}).front().at(0);
        const double inside = static_cast<double>(part.pixels) / whole.pixels;
        REQUIRE((inside > 0.2 && inside < 0.8));
        CHECK(part.visible_px[2] == small.width);
        CHECK(part.truncation == Approx(1.0 - inside).margin(0.02));
        CHECK(part.visible_share == Approx(inside).margin(0.02));
        for (int i = 0; i < 4; ++i) { CHECK(part.whole_px[i] == Approx(whole.whole_px[i]).margin(0.02)); }
    }
    // All around the eye, behind a lens that sees all around, too; and behind a camera.
    scene.states[0].position_m = scene.pose.eye_m;
    for (const Camera& camera : {barrel(160, 120), fisheye(200)}) {
        const auto boxes = scene.world.boxes(camera, {&scene.pose, 1}, {.states = scene.states});
        for (const Box& box : boxes.front()) {
            for (const double edge : box.whole_px) { CHECK(std::isfinite(edge)); }
            CHECK((box.truncation >= 0.0 && box.truncation <= 1.0));
            CHECK((box.visible_share >= 0.0 && box.visible_share <= 1.0));
        }
    }
    const glm::dvec3 behind =
        as_glm(scene.pose.eye_m) - as_glm(to_opencv(scene.pose.attitude)) * glm::dvec3(0.0, 0.0, 80.0);
    scene.states[0].position_m = {behind.x, behind.y, behind.z};
    CHECK(scene.world.boxes(barrel(160, 120), {&scene.pose, 1}, {.states = scene.states}).front().empty());
}
