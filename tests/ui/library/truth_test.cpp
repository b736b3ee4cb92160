#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <octant/octant.h>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

using namespace octant;

namespace {

constexpr Output all_outputs =
    Output::Rgb | Output::Depth | Output::ClassId | Output::ObjectId | Output::Normal | Output::Flow | Output::Coverage;

Vec3 turned(const Quaternion& q, const Vec3& v) {
    const double tx = 2.0 * (q.y * v.z - q.z * v.y);
    const double ty = 2.0 * (q.z * v.x - q.x * v.z);
    const double tz = 2.0 * (q.x * v.y - q.y * v.x);
    return {v.x + q.w * tx + q.y * tz - q.z * ty, v.y + q.w * ty + q.z * tx - q.x * tz,
        v.z + q.w * tz + q.x * ty - q.y * tx};
}

Vec3 less(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

State at(const Vec3& position_m, double heading_deg = 0.0) {
    State state;
    state.position_m = position_m;
    state.attitude = attitude(heading_deg);
    return state;
}

std::vector<Pose> jumping_poses(const World& world, std::size_t count) {
    const std::vector<Vec3> places = world.random_positions(count, 20.0, 500.0, 11);
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < count; ++i) {
        const auto turn = static_cast<double>(i);
        Pose pose{.eye_m = places[i], .attitude = attitude(61.0 * turn, -15.0)};
        if (i % 3 != 0) {
            pose.previous_eye_m = Vec3{places[i].x - 1.0, places[i].y, places[i].z + 0.5};
            pose.previous_attitude = attitude(61.0 * turn + 0.4, -15.2);
        }
        poses.push_back(pose);
    }
    return poses;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)));
}

} // namespace

TEST_CASE("all outputs of a batch are the same for any number of threads, and alone") {
    const World world({.aircraft = {"f15", "500md"}, .triangles = 2000});
    const Camera camera{48, 40, 70.0};
    const std::vector<Pose> poses = jumping_poses(world, 12);
    const Frames one = world.render(camera, poses, all_outputs, {.threads = 1});
    const Frames three = world.render(camera, poses, all_outputs, {.threads = 3});
    CHECK(one.rgb == three.rgb);
    CHECK(one.class_id == three.class_id);
    CHECK(one.object_id == three.object_id);
    CHECK(same_bits(one.depth_m, three.depth_m));
    CHECK(same_bits(one.normal, three.normal));
    CHECK(same_bits(one.flow_px, three.flow_px));
    CHECK(same_bits(one.coverage, three.coverage));
    const Frames without_colours = world.render(camera, poses, Output::Depth, {.threads = 1});
    CHECK(without_colours.rgb.empty());
    CHECK(same_bits(one.depth_m, without_colours.depth_m));
    const std::size_t pixels = 48 * 40;
    const Frames ninth = world.render(camera, std::span(poses).subspan(9, 1), all_outputs, {.threads = 1});
    CHECK(std::ranges::equal(ninth.class_id, std::span(one.class_id).subspan(9 * pixels, pixels)));
    for (std::size_t picture = 0; picture < poses.size(); ++picture) {
        const std::span flow = std::span(one.flow_px).subspan(2 * picture * pixels, 2 * pixels);
        const auto known = std::ranges::count_if(flow, [](float value) { return std::isfinite(value); });
        CHECK((known > 0) == poses[picture].previous_eye_m.has_value());
    }
}

TEST_CASE("a pixel's depth, class, object and normal are those of the exported triangles") {
    const World world({.aircraft = {"f15", "500md"}, .triangles = 2000});
    const Camera camera{64, 48, 60.0};
    const Intrinsics matrix = camera.matrix();
    const std::string file = "exported-" + std::to_string(getpid()) + ".obj";
    int compared = 0;
    int on_aircraft = 0;
    for (int view = 0; view < 4; ++view) {
        World placed = world;
        const Vec3 eye = world.random_positions(4, 60.0, 200.0, 5)[static_cast<std::size_t>(view)];
        const double heading_deg = 80.0 * view;
        const Quaternion look = attitude(heading_deg, -12.0);
        const Vec3 ahead = turned(look, {50.0, 0.0, 0.0});
        placed.set_states(std::array{at({eye.x + ahead.x, eye.y + ahead.y, eye.z + ahead.z}, 30.0),
            at({eye.x + 0.5 * ahead.x + 6.0, eye.y + 0.5 * ahead.y, eye.z + 0.5 * ahead.z}, 200.0)});
        const Pose pose{.eye_m = eye, .attitude = look};
        const Frames truth = placed.render(
            camera, std::span(&pose, 1), Output::Depth | Output::ClassId | Output::ObjectId | Output::Normal);
        placed.export_scene(file, camera, pose);
        struct Triangle {
            std::array<Vec3, 3> corners;
            std::string group;
        };
        std::vector<Triangle> triangles;
        std::ifstream in(file);
        std::vector<Vec3> vertices;
        std::string group;
        for (std::string line; std::getline(in, line);) {
            std::istringstream words(line);
            std::string kind;
            words >> kind;
            if (kind == "g") { words >> group; }
            if (kind == "v") {
                Vec3& vertex = vertices.emplace_back();
                words >> vertex.x >> vertex.y >> vertex.z;
            }
            if (kind == "f") {
                std::array<std::size_t, 3> index{};
                words >> index[0] >> index[1] >> index[2];
                triangles.push_back({{vertices[index[0] - 1], vertices[index[1] - 1], vertices[index[2] - 1]}, group});
            }
        }
        REQUIRE(triangles.size() > 500);
        for (int row = 2; row < camera.height - 2; row += 3) {
            for (int column = 2; column < camera.width - 2; column += 3) {
                const auto pixel = [&](int dx, int dy) {
                    return static_cast<std::size_t>((row + dy) * camera.width + column + dx);
                };
                bool is_at_edge = false;
                const float depth = truth.depth_m[pixel(0, 0)];
                for (int dy = -2; dy <= 2; ++dy) {
                    for (int dx = -2; dx <= 2; ++dx) {
                        const std::size_t there = pixel(dx, dy);
                        is_at_edge = is_at_edge || truth.class_id[there] != truth.class_id[pixel(0, 0)] ||
                                     truth.object_id[there] != truth.object_id[pixel(0, 0)] ||
                                     (std::isfinite(depth) && !(std::abs(truth.depth_m[there] - depth) < 0.2F * depth));
                    }
                }
                if (is_at_edge) { continue; }
                const Vec3 ray = turned(look, {1.0, (column - matrix.cx) / matrix.fx, (row - matrix.cy) / matrix.fy});
                double nearest = std::numeric_limits<double>::infinity();
                const Triangle* hit = nullptr;
                Vec3 normal;
                for (const Triangle& triangle : triangles) {
                    const Vec3 ab = less(triangle.corners[1], triangle.corners[0]);
                    const Vec3 ac = less(triangle.corners[2], triangle.corners[0]);
                    const Vec3 p = cross(ray, ac);
                    const double det = dot(ab, p);
                    if (std::abs(det) < 1e-12) { continue; }
                    const Vec3 from = less(eye, triangle.corners[0]);
                    const double u = dot(from, p) / det;
                    const Vec3 q = cross(from, ab);
                    const double v = dot(ray, q) / det;
                    const double t = dot(ac, q) / det;
                    if (u < 0.0 || v < 0.0 || u + v > 1.0 || t <= 0.0 || t >= nearest) { continue; }
                    nearest = t;
                    hit = &triangle;
                    normal = cross(ab, ac);
                }
                ++compared;
                INFO("view " << view << ", column " << column << ", row " << row);
                if (hit == nullptr) {
                    CHECK(truth.class_id[pixel(0, 0)] == 0);
                    CHECK(std::isinf(depth));
                    continue;
                }
                CHECK(std::abs(static_cast<double>(depth) - nearest) < 2e-4 * nearest + 1e-3);
                const std::uint32_t object = truth.object_id[pixel(0, 0)];
                const auto surface = static_cast<SurfaceClass>(truth.class_id[pixel(0, 0)]);
                CHECK(hit->group == std::string(name_of(surface)) + (object == 0 ? "" : "-" + std::to_string(object)));
                on_aircraft += object != 0 ? 1 : 0;
                const double length = std::sqrt(dot(normal, normal));
                const double facing = dot(normal, ray) < 0.0 ? 1.0 : -1.0;
                const float* const shown = &truth.normal[3 * pixel(0, 0)];
                if (object == 0) { CHECK(facing * dot(normal, {shown[0], shown[1], shown[2]}) / length > 0.99); }
            }
        }
    }
    std::remove(file.c_str());
    CHECK(compared > 400);
    CHECK(on_aircraft > 5);
}

TEST_CASE("boxes of an aircraft in the open, partly outside, behind another one and out of view") {
    const World world({.terrain = "hills", .aircraft = {"f15", "f15"}, .triangles = 1000});
    const Camera camera{128, 96, 60.0};
    const Vec3 eye{0.0, 0.0, 1500.0};
    const Pose pose{.eye_m = eye, .attitude = attitude(0.0)};
    const auto boxes_with = [&](const State& first, const State& second) {
        const std::array states{first, second};
        return world.boxes(camera, std::span(&pose, 1), {.states = states}).front();
    };
    State absent;
    absent.is_present = false;

    const State ahead = at({0.0, 60.0, 1500.0}, 60.0);
    std::vector<Box> boxes = boxes_with(ahead, absent);
    REQUIRE(boxes.size() == 1);
    const Box open = boxes[0];
    CHECK(open.object_id == 1);
    CHECK(open.visible_share == 1.0);
    CHECK(open.truncation == 0.0);
    CHECK(open.distance_m == Approx(60.0).margin(2.0));
    const std::array states{ahead, absent};
    const Frames frames = world.render(camera, std::span(&pose, 1), Output::ObjectId, {.states = states});
    CHECK(open.pixels == std::ranges::count(frames.object_id, 1U));
    CHECK(open.pixels > 100);
    CHECK(open.whole_px[0] <= open.visible_px[0] + 0.5);
    CHECK(open.whole_px[1] <= open.visible_px[1] + 0.5);
    CHECK(open.whole_px[2] >= open.visible_px[2] - 0.5);
    CHECK(open.whole_px[3] >= open.visible_px[3] - 0.5);
    for (const Vec3& corner : open.corners_m) { CHECK(std::abs(corner.y - 60.0) < 25.0); }

    boxes = boxes_with(at({34.6, 60.0, 1500.0}, 0.0), absent); // the picture ends at 46 m to the right
    REQUIRE(boxes.size() == 1);
    const double half = boxes_with(at({46.2, 60.0, 1500.0}, 0.0), absent)[0].truncation;
    CHECK((half > 0.3 && half < 0.7));
    CHECK(boxes_with(at({46.2, 60.0, 1500.0}, 0.0), absent)[0].visible_share == Approx(1.0 - half).margin(0.01));

    boxes = boxes_with(at({0.0, 120.0, 1500.0}, 90.0), at({0.0, 50.0, 1500.0}, 90.0));
    REQUIRE(boxes.size() == 2);
    CHECK(boxes[0].visible_share < 0.3); // the nearer one covers most of it
    CHECK(boxes[0].truncation == 0.0);
    CHECK(boxes[1].visible_share == 1.0);

    CHECK(boxes_with(at({0.0, -60.0, 1500.0}), absent).empty());
    CHECK(boxes_with(at({500.0, 60.0, 1500.0}), absent).empty());
    boxes = boxes_with(at({0.0, 60.0, -500.0}), absent);
    CHECK(boxes.empty()); // far below the picture
    // Around the eye: no fault, and nothing that is not finite.
    for (const Box& box : boxes_with(at({0.0, 2.0, 1500.0}), absent)) {
        for (const double edge : box.whole_px) { CHECK(std::isfinite(edge)); }
        CHECK((box.truncation >= 0.0 && box.truncation <= 1.0));
    }
}
