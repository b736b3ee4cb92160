#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numeric>
#include <octant/octant.h>
#include <optional>
#include <span>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

using namespace octant;

namespace {

using Pictures = std::vector<std::vector<std::uint8_t>>;

/// A picture to be drawn: where its camera is, and the states of all aircraft.
struct Shot {
    Pose pose;
    std::vector<State> states;
};

/// Shots that jump all over the map: from just above the ground, from far up, beside an aircraft and far from all.
std::vector<Shot> jumping_shots(const World& world, std::size_t count) {
    std::vector<Shot> shots;
    const std::vector<Vec3> places = world.random_positions(2 * count, 5.0, 900.0, 3);
    for (std::size_t i = 0; i < count; ++i) {
        Shot shot;
        const auto turn = static_cast<double>(i);
        for (std::size_t k = 0; k < world.objects().size(); ++k) {
            State state;
            state.position_m = places[count + (i + k) % count];
            state.attitude = attitude(47.0 * turn, 10.0 * std::sin(turn), 60.0 * std::cos(turn));
            state.time_s = 0.37 * turn;
            state.is_present = i % 7 != 6;
            shot.states.push_back(state);
        }
        shot.pose.eye_m = places[i];
        shot.pose.attitude =
            attitude(73.0 * turn, -20.0 + static_cast<double>(3 * (i % 9)), static_cast<double>(5 * (i % 3)));
        if (i % 2 == 0 && !shot.states.empty()) {
            const Vec3 at = shot.states.front().position_m;
            const double away_m = std::array{20.0, 60.0, 400.0, 3000.0}[i / 2 % 4];
            shot.pose.eye_m = {at.x - away_m, at.y + 0.3 * away_m, at.z + 0.2 * away_m};
            shot.pose.attitude = look_at(shot.pose.eye_m, at);
        }
        shots.push_back(shot);
    }
    return shots;
}

/// The pictures of these shots, in this order, by one call.
Pictures drawn(const World& world, const Camera& camera, const std::vector<Shot>& shots,
    const std::vector<std::size_t>& order, int threads) {
    std::vector<Pose> poses;
    std::vector<State> states;
    for (const std::size_t i : order) {
        poses.push_back(shots[i].pose);
        states.insert(states.end(), shots[i].states.begin(), shots[i].states.end());
    }
    RenderOptions options;
    options.threads = threads;
    options.states = states;
    const Frames frames = world.render(camera, poses, Output::Rgb, options);
    Pictures pictures;
    const auto bytes = static_cast<std::ptrdiff_t>(3 * camera.width * camera.height);
    for (std::size_t i = 0; i < frames.count; ++i) {
        const auto first = frames.rgb.begin() + static_cast<std::ptrdiff_t>(i) * bytes;
        pictures.emplace_back(first, first + bytes);
    }
    return pictures;
}

std::vector<std::size_t> in_order(std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    return order;
}

std::string failure_of(const auto& function) {
    try {
        function();
    } catch (const Error& fault) { return fault.what(); }
    return "no error";
}

void check_independence(const WorldSettings& settings, std::size_t count) {
    const World world(settings);
    const Camera camera{64, 48, 60.0};
    const std::vector<Shot> shots = jumping_shots(world, count);
    // Each picture as the first one of a world.
    Pictures expected;
    for (std::size_t i = 0; i < count; i += 4) {
        expected.push_back(drawn(World(settings, world), camera, shots, {i}, 1).front());
    }
    const Pictures together = drawn(world, camera, shots, in_order(count), 1);
    for (std::size_t i = 0; i < count; i += 4) {
        INFO("picture " << i);
        CHECK(together[i] == expected[i / 4]);
    }
    for (const int threads : {2, 3}) { CHECK(drawn(world, camera, shots, in_order(count), threads) == together); }
    std::vector<std::size_t> mixed = in_order(count);
    for (std::size_t i = 0; i < count; ++i) { std::swap(mixed[i], mixed[(i * 7 + 3) % count]); }
    const Pictures in_mixed_order = drawn(world, camera, shots, mixed, 1);
    drawn(world, Camera{33, 70, 25.0, {}, {}, {}, 4}, shots, in_order(count), 1);
    for (std::size_t i = 0; i < count; ++i) {
        INFO("picture " << mixed[i]);
        CHECK(in_mixed_order[i] == together[mixed[i]]);
        CHECK(drawn(world, camera, shots, {i}, 1).front() == together[i]);
    }
}

} // namespace

TEST_CASE("pictures do not depend on those before them, on threads, batches or order") {
    check_independence({.terrain = "hills", .aircraft = {"f15-detailed", "500md-detailed"}, .triangles = 3000}, 40);
}

TEST_CASE("nor over a canyon with clouds, effects and chosen smooth polygons") {
    check_independence({.terrain = "canyon",
                           .aircraft = {"f15", "500md", "f15"},
                           .triangles = 2000,
                           .settings = {{"clouds", "0.5"}, {"effects", "true"}, {"smooth-share", "0.4"}}},
        24);
}

TEST_CASE("nor over the paper's quadtree, whose detail is controlled from frame to frame") {
    check_independence({.terrain = "hills",
                           .aircraft = {"f15"},
                           .triangles = 2000,
                           .settings = {{"terrain-lod", "paper"}, {"shading-rule", "paper"}}},
        16);
}

TEST_CASE("nor over polygons and without aircraft") {
    check_independence({.terrain = "background60"}, 8);
    check_independence({.terrain = "hills", .settings = {{"roads", "false"}, {"hidden-surface", "depth-buffer"}}}, 8);
}

TEST_CASE("several threads call one world at once") {
    const World world({.aircraft = {"f15"}, .triangles = 1000});
    const Camera camera{48, 48, 60.0};
    const std::vector<Shot> shots = jumping_shots(world, 12);
    const Pictures expected = drawn(world, camera, shots, in_order(12), 1);
    std::array<Pictures, 3> got;
    {
        std::vector<std::jthread> callers;
        for (Pictures& pictures : got) {
            callers.emplace_back([&] { pictures = drawn(world, camera, shots, in_order(12), 2); });
        }
    }
    for (const Pictures& pictures : got) { CHECK(pictures == expected); }
}

TEST_CASE("copies share all but their states") {
    const World world({.aircraft = {"f15"}, .triangles = 1000});
    World copy = world;
    State away;
    away.position_m = {0.0, 0.0, 9000.0};
    copy.set_states(std::array{away});
    CHECK(copy.states()[0].position_m.z == 9000.0);
    CHECK(world.states()[0].position_m.z < 2000.0);
    const Vec3 at = world.states()[0].position_m;
    const Pose pose{.eye_m = {at.x, at.y - 40.0, at.z}, .attitude = attitude(0.0)};
    const Camera camera{32, 32, 60.0};
    CHECK(world.render(camera, std::span(&pose, 1)).rgb != copy.render(camera, std::span(&pose, 1)).rgb);
    copy.set_states(world.states());
    CHECK(world.render(camera, std::span(&pose, 1)).rgb == copy.render(camera, std::span(&pose, 1)).rgb);
    World moved = std::move(copy);
    CHECK(copy.render(camera, std::span(&pose, 1)).rgb == moved.render(camera, std::span(&pose, 1)).rgb); // NOLINT
    copy.set_states({});                                                                                  // NOLINT
    CHECK_FALSE(copy.states()[0].is_present);
}

TEST_CASE("a further world under another sun draws what one of its own draws") {
    const auto settings_of = [](double sun_elevation_deg) {
        WorldSettings settings{.aircraft = {"f15-detailed"}, .triangles = 2000};
        settings.sun_elevation_deg = sun_elevation_deg;
        return settings;
    };
    const World noon(settings_of(60.0));
    const Camera camera{64, 48, 60.0};
    const std::vector<Shot> shots = jumping_shots(noon, 6);
    const Pictures at_noon = drawn(noon, camera, shots, in_order(6), 1);
    const Pictures expected = drawn(World(settings_of(12.0)), camera, shots, in_order(6), 1);
    CHECK(drawn(World(settings_of(12.0), noon), camera, shots, in_order(6), 2) == expected);
    CHECK(at_noon != expected);
    CHECK(drawn(noon, camera, shots, in_order(6), 1) == at_noon);
}

TEST_CASE("a child of fork() goes on drawing") {
    const World world({.aircraft = {"f15"}, .triangles = 1000});
    const Camera camera{32, 32, 60.0};
    const std::vector<Shot> shots = jumping_shots(world, 6);
    const Pictures expected = drawn(world, camera, shots, in_order(6), 2);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) { _exit(drawn(world, camera, shots, in_order(6), 2) == expected ? 0 : 1); }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 0));
}

namespace {

std::size_t resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    std::size_t all = 0;
    std::size_t resident = 0;
    statm >> all >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

} // namespace

TEST_CASE("memory stays as it is over thousands of pictures, and copies are small") {
    const World world({.aircraft = {"f15"}, .triangles = 1000});
    const Camera camera{32, 32, 60.0};
    const std::vector<Shot> shots = jumping_shots(world, 400);
    drawn(world, camera, shots, in_order(400), 1);
    const std::size_t before = resident_bytes();
    for (int round = 0; round < 5; ++round) { drawn(world, camera, shots, in_order(400), 1); }
    CHECK(resident_bytes() < before + (std::size_t{4} << 20U));
    const std::size_t alone = resident_bytes();
    std::vector<World> copies(20, world);
    for (World& copy : copies) { copy.set_states(shots[3].states); }
    for (const World& copy : copies) { drawn(copy, camera, shots, {0, 1}, 1); }
    CHECK(resident_bytes() < alone + 20 * (std::size_t{5} << 20U));
}

TEST_CASE("a camera by its matrix sees what one by its field of view sees") {
    const World world({.aircraft = {"f15"}, .triangles = 1000});
    const Vec3 at = world.states()[0].position_m;
    const Pose pose{.eye_m = {at.x, at.y - 40.0, at.z + 5.0}, .attitude = attitude(0.0, -5.0)};
    const Camera by_fov{80, 60, 50.0};
    Camera by_matrix = by_fov;
    by_matrix.intrinsics = by_fov.matrix();
    const Frames expected = world.render(by_fov, std::span(&pose, 1));
    CHECK(world.render(by_matrix, std::span(&pose, 1)).rgb == expected.rgb);
    // A part of the picture: the same pixels.
    Camera part{40, 30, 50.0};
    part.intrinsics = by_fov.matrix();
    part.intrinsics->cx -= 20.0;
    part.intrinsics->cy -= 10.0;
    const Frames cut = world.render(part, std::span(&pose, 1));
    int off = 0;
    for (int row = 0; row < 30; ++row) {
        for (int value = 0; value < 3 * 40; ++value) {
            const auto a = static_cast<std::size_t>(row * 3 * 40 + value);
            const auto b = static_cast<std::size_t>((row + 10) * 3 * 80 + 3 * 20 + value);
            off += std::abs(int{cut.rgb[a]} - int{expected.rgb[b]}) > 24 ? 1 : 0;
        }
    }
    CHECK(off < 3 * 40 * 30 / 20); // the ground has another mesh, as its budget is that of the part
}

TEST_CASE("a stopped call says so, and the world goes on") {
    const World world({.triangles = 1000});
    const std::vector<Shot> shots = jumping_shots(world, 20);
    std::vector<Pose> poses;
    for (const Shot& shot : shots) { poses.push_back(shot.pose); }
    int asked = 0;
    RenderOptions options;
    options.threads = 2;
    options.is_stopped = [&] { return ++asked > 3; };
    CHECK_THROWS_AS(world.render(Camera{16, 16, 60.0}, poses, Output::Rgb, options), Interrupted);
    CHECK(world.render(Camera{16, 16, 60.0}, poses).count == 20);
}

TEST_CASE("wrong arguments are refused in one line") {
    const World world({.aircraft = {"f15"}, .triangles = 1000});
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const Pose pose{.eye_m = {0.0, 0.0, 500.0}, .attitude = {}};
    const auto with_camera = [&](const Camera& camera) {
        return failure_of([&] { world.render(camera, std::span(&pose, 1)); });
    };
    CHECK(with_camera({0, 128}) == "camera: expected a width and a height of 1 to 8192 pixels, got 0 x 128");
    CHECK(with_camera({-3, 128}) == "camera: expected a width and a height of 1 to 8192 pixels, got -3 x 128");
    CHECK(with_camera({128, 100000}) == "camera: expected a width and a height of 1 to 8192 pixels, got 128 x 100000");
    CHECK(with_camera({128, 128, nan}) == "camera: fov_deg: expected 0.01 to 170, got nan");
    CHECK(with_camera({128, 128, 60.0, {}, {}, {}, 3}) == "camera: samples: expected 1, 4 or 16, got 3");
    CHECK(with_camera({128, 128, 60.0, Intrinsics{0.0, 1.0, 0.0, 0.0}}) ==
          "camera: fx: expected 0.001 to 100000000, got 0");
    const auto with_pose = [&](const Pose& wrong) {
        return failure_of([&] { world.render({16, 16}, std::span(&wrong, 1)); });
    };
    CHECK(with_pose({.eye_m = {nan, 0.0, 0.0}, .attitude = {}}) ==
          "pose: eye_m: expected three finite numbers, got nan, 0, 0");
    CHECK(with_pose({.eye_m = {1e9, 0.0, 0.0}, .attitude = {}}) ==
          "pose: eye_m: expected at most 10000000 m from the middle of the map, got 1000000000, 0, 0");
    CHECK(with_pose({.eye_m = {}, .attitude = {0.0, 0.0, 0.0, 0.0}}) ==
          "pose: attitude: expected a quaternion w, x, y, z that is finite and not zero, got 0, 0, 0, 0");
    const auto with_states = [&](std::size_t count) {
        const std::vector<State> states(count);
        const std::vector<Pose> poses(4, pose);
        return failure_of([&] { world.render({16, 16}, poses, Output::Rgb, {.states = states}); });
    };
    CHECK(with_states(1) == "no error");
    CHECK(with_states(4) == "no error");
    CHECK(with_states(3) == "states: expected 1, one for each aircraft, or 4 for 4 pictures, got 3");
    World changed = world;
    CHECK(failure_of([&] { changed.set_states(std::vector<State>(2)); }) ==
          "states: expected at most 1, one for each aircraft, got 2");
    CHECK(failure_of([&] {
        world.render({16, 16}, {}, Output{});
    }) == "outputs: expected some of those of Output, got 0");
    CHECK(failure_of([&] {
        world.render({16, 16}, std::span(&pose, 1), Output::Rgb, {.threads = -1});
    }) == "threads: expected 0 to 1024, got -1");
    CHECK(failure_of([] { attitude(nan); }) == "attitude: expected finite angles, got nan");
    CHECK(failure_of([] {
        look_at({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0});
    }) == "look_at: expected a target away from the eye, got the same point");
}

TEST_CASE("wrong settings of a world are refused in one line") {
    const auto with = [](const WorldSettings& settings) { return failure_of([&] { const World world(settings); }); };
    CHECK(with({.settings = {{"terain", "hills"}}}) ==
          "terain: expected the name of a setting, got 'terain'; perhaps terrain is meant");
    CHECK(with({.settings = {{"size", "64x64"}}}) == "size: expected a setting of a world, got one of views or frames");
    CHECK(with({.aircraft = {"f15"}, .settings = {{"aircraft", "f15"}}}) ==
          "aircraft: expected it once, got it among the settings, too");
    CHECK(with({.settings = {{"clouds", "2"}}}).starts_with("clouds: expected"));
    CHECK(with({.triangles = 3}).starts_with("triangles: expected"));
    CHECK(with({.sun_elevation_deg = 95.0}).starts_with("sun_elevation_deg: expected"));
    CHECK(with({.settings = {{"sun-elevation", "95"}}}).starts_with("sun-elevation: expected"));
    // As settings, not as options.
    CHECK(with({.settings = {{"shading", "flat"}, {"smooth-share", "0.5"}}}) ==
          "shading: expected hybrid beside adapt shading, smooth-share, device-ratio or shading-rule paper, got flat");
    CHECK(with({.settings = {{"path-ribbon", "true"}}}) ==
          "path-ribbon: expected a path or a track, got what others fly");
    CHECK(with({.terrain = "none", .settings = {{"ground-shading", "texture"}}}) ==
          "ground-shading=texture: expected ground with heights (hills, canyon or a file), got terrain none");
    CHECK(with({.aircraft = {"f16"}}).starts_with("aircraft: expected f15"));
    CHECK(with({.terrain = "no-such-file.tif"}).find("no-such-file.tif") != std::string::npos);
}

TEST_CASE("heights, positions and notes of a world") {
    const World world({.triangles = 1000});
    const auto [east_m, north_m] = world.half_extent_m();
    CHECK(east_m > 1000.0);
    CHECK(std::isnan(world.height_m(east_m + 1.0, 0.0)));
    const std::vector<Vec3> few = world.random_positions(5, 30.0, 300.0, 7);
    const std::vector<Vec3> many = world.random_positions(500, 30.0, 300.0, 7);
    CHECK(world.random_positions(1, 30.0, 300.0, 8)[0].x != few[0].x);
    for (std::size_t i = 0; i < 5; ++i) { CHECK((few[i].x == many[i].x && few[i].z == many[i].z)); }
    for (const Vec3& at : many) {
        CHECK(std::abs(at.x) <= 0.8 * east_m);
        CHECK(std::abs(at.y) <= 0.8 * north_m);
        const double above_m = at.z - world.height_m(at.x, at.y);
        CHECK((above_m >= 29.999 && above_m <= 300.001));
    }
    CHECK(
        failure_of([&] { world.local(47.0, 8.0, 500.0); }).starts_with("local: expected a map that lies on the earth"));
    CHECK(world.objects().empty());
    const World two({.aircraft = {"f15", "500md", "f15"}, .triangles = 1000});
    REQUIRE(two.objects().size() == 3);
    CHECK(two.objects()[0].name == "f15");
    CHECK(two.objects()[2].name == "f15-2");
    CHECK(two.objects()[2].kind == "f15");
    CHECK((two.objects()[0].size_m.x > 15.0 && two.objects()[0].size_m.x < 25.0));
}

TEST_CASE("attitudes turn body axes into world axes, and those of other cameras") {
    const auto turned = [](const Quaternion& q, const Vec3& v) {
        const double tx = 2.0 * (q.y * v.z - q.z * v.y);
        const double ty = 2.0 * (q.z * v.x - q.x * v.z);
        const double tz = 2.0 * (q.x * v.y - q.y * v.x);
        return Vec3{v.x + q.w * tx + q.y * tz - q.z * ty, v.y + q.w * ty + q.z * tx - q.x * tz,
            v.z + q.w * tz + q.x * ty - q.y * tx};
    };
    const auto is_near = [](const Vec3& a, const Vec3& b) {
        return std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z) < 1e-12;
    };
    CHECK(is_near(turned(attitude(90.0), {1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}));
    CHECK(is_near(turned(attitude(0.0), {1.0, 0.0, 0.0}), {0.0, 1.0, 0.0}));
    CHECK(is_near(turned(attitude(0.0), {0.0, 0.0, 1.0}), {0.0, 0.0, -1.0}));
    CHECK(is_near(turned(attitude(0.0, 90.0), {1.0, 0.0, 0.0}), {0.0, 0.0, 1.0}));
    const Quaternion level = attitude(0.0); // looks north
    CHECK(is_near(turned(to_opencv(level), {0.0, 0.0, 1.0}), {0.0, 1.0, 0.0}));
    CHECK(is_near(turned(to_opencv(level), {1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}));
    CHECK(is_near(turned(to_opengl(level), {0.0, 0.0, -1.0}), {0.0, 1.0, 0.0}));
    CHECK(is_near(turned(to_opengl(level), {0.0, 1.0, 0.0}), {0.0, 0.0, 1.0}));
    const Quaternion any = attitude(33.0, -12.0, 150.0);
    for (const Vec3 axis : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}) {
        CHECK(is_near(turned(from_opencv(to_opencv(any)), axis), turned(any, axis)));
        CHECK(is_near(turned(from_opengl(to_opengl(any)), axis), turned(any, axis)));
    }
    const Quaternion down = look_at({0.0, 0.0, 100.0}, {0.0, 0.0, 0.0});
    CHECK(is_near(turned(down, {0.0, 0.0, -1.0}), {0.0, 1.0, 0.0})); // north is up
}

namespace {

/// A picture of 8 x 8 texels in red and green columns, as an uncompressed TGA file.
std::string striped_tga() {
    std::string bytes("\0\0\2\0\0\0\0\0\0\0\0\0\x08\0\x08\0\x18\0", 18);
    for (int texel = 0; texel < 64; ++texel) {
        bytes += texel % 2 == 0 ? std::string("\x10\x10\xe0", 3) : std::string("\x10\xe0\x10", 3);
    }
    return bytes;
}

} // namespace

TEST_CASE("aircraft have the pictures that their files name, at the place of each texel") {
    const std::string name = "striped-" + std::to_string(getpid());
    std::ofstream(name + ".tga", std::ios::binary) << striped_tga();
    std::ofstream(name + ".mtl") << "newmtl skin\nKd 1 1 1\nmap_Kd " << name << ".tga\n";
    std::ofstream(name + ".obj") << "mtllib " << name << ".mtl\nusemtl skin\nv -8 0 -8\nv 8 0 -8\nv 8 0 8\nv -8 0 8\n"
                                 << "v 0 -1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 4/4 3/3 2/2 1/1\n"
                                 << "f 1/1 2/2 5/3\nf 2/1 3/2 5/3\nf 3/1 4/2 5/3\nf 4/1 1/2 5/3\n";
    const auto stripes = [&](const std::string& textures) { // of red and green along the row in the middle
        const World world({.terrain = "none",
            .aircraft = {name + ".obj"},
            .settings = {{"axes", "right,up,back"}, {"textures", textures}, {"shading", "flat"}}});
        State state;
        state.position_m = {0.0, 0.0, 100.0};
        state.attitude = attitude(0.0, 0.0, 0.0);
        Pose pose;
        pose.eye_m = {0.0, 0.0, 114.0};
        pose.attitude = attitude(0.0, -90.0, 0.0);
        RenderOptions options;
        const std::array states{state};
        options.states = states;
        const Frames frames = world.render(Camera{64, 64, 40.0}, std::array{pose}, Output::Rgb, options);
        int found = 1;
        for (std::size_t i = 3 * 64 * 32 + 3; i < std::size_t{3} * 64 * 33; i += 3) {
            const bool is_red = frames.rgb[i] > frames.rgb[i + 1];
            found += is_red != (frames.rgb[i - 3] > frames.rgb[i - 2]) ? 1 : 0;
        }
        return found;
    };
    CHECK(stripes("true") >= 5);
    CHECK(stripes("false") <= 2); // colours of corners, which run into one another
    for (const char* const ending : {".tga", ".mtl", ".obj"}) { std::remove((name + ending).c_str()); }
}
