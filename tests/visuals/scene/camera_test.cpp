#include "visuals/scene/camera.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

using namespace octant::visuals::scene;

namespace {

constexpr double quarter_turn_rad = 1.5707963267948966;

void check_near(const glm::dvec3& got, const glm::dvec3& expected) {
    for (int axis = 0; axis < 3; ++axis) { CHECK(got[axis] == Approx(expected[axis]).margin(1e-12)); }
}

const glm::dvec3 right{1, 0, 0};
const glm::dvec3 up{0, 1, 0};
const glm::dvec3 ahead{0, 0, -1};

} // namespace

TEST_CASE("a camera looking north has east on its right and the sky above") {
    const Camera camera = camera_looking_at({10, 20, 30}, {10, 500, 30});
    check_near(camera.eye_m, {10, 20, 30});
    check_near(camera.view_to_world * ahead, {0, 1, 0});
    check_near(camera.view_to_world * right, {1, 0, 0});
    check_near(camera.view_to_world * up, {0, 0, 1});
}

TEST_CASE("a camera looking anywhere has its target in the middle and its right side level") {
    const glm::dvec3 eye(100, -200, 900);
    for (const glm::dvec3& target : {glm::dvec3(0, 0, 0), glm::dvec3(5000, -200, 900), glm::dvec3(99, -201, 2000)}) {
        const Camera camera = camera_looking_at(eye, target);
        check_near(camera.view_to_world * ahead, glm::normalize(target - eye));
        CHECK((camera.view_to_world * right).z == Approx(0.0).margin(1e-12));
        CHECK((camera.view_to_world * up).z > 0.0);
        const glm::vec4 seen = world_to_view(camera) * glm::vec4(glm::vec3(target - eye), 1.0F);
        CHECK(seen.x == Approx(0.0).margin(1e-2));
        CHECK(seen.y == Approx(0.0).margin(1e-2));
        CHECK(seen.z == Approx(-glm::length(target - eye)));
    }
}

TEST_CASE("looking straight down or up keeps north at the top of the picture") {
    const Camera down = camera_looking_at({0, 0, 100}, {0, 0, 0});
    check_near(down.view_to_world * ahead, {0, 0, -1});
    check_near(down.view_to_world * up, {0, 1, 0});
    check_near(down.view_to_world * right, {1, 0, 0});
    const Camera zenith = camera_looking_at({0, 0, 0}, {0, 0, 100});
    check_near(zenith.view_to_world * ahead, {0, 0, 1});
    check_near(zenith.view_to_world * up, {0, 1, 0});
    check_near(zenith.view_to_world * right, {-1, 0, 0});
}

TEST_CASE("depth is 1 at the near plane, half of it at twice the distance and 0 at infinity") {
    Camera camera;
    camera.near_m = 0.5;
    const glm::mat4 clip = view_to_clip(camera, 1.5);
    const auto depth = [&](float distance_m) {
        const glm::vec4 point = clip * glm::vec4(0.0F, 0.0F, -distance_m, 1.0F);
        CHECK(point.w == distance_m);
        return point.z / point.w;
    };
    CHECK(depth(0.5F) == 1.0F);
    CHECK(depth(1.0F) == 0.5F);
    CHECK(depth(5e6F) == Approx(1e-7));
    const glm::vec4 infinitely_far = clip * glm::vec4(0.0F, 0.0F, -1.0F, 0.0F);
    CHECK(infinitely_far.z == 0.0F);
    CHECK(infinitely_far.w == 1.0F);
}

TEST_CASE("the field of view is the height of the picture, its width follows the aspect") {
    Camera camera;
    camera.vertical_fov_rad = quarter_turn_rad;
    const glm::mat4 clip = view_to_clip(camera, 2.0);
    const glm::vec4 corner = clip * glm::vec4(20.0F, 10.0F, -10.0F, 1.0F);
    CHECK(corner.x / corner.w == Approx(1.0));
    CHECK(corner.y / corner.w == Approx(1.0));
}

TEST_CASE("a picture beside the middle shows that part of a larger one, in pixels of any shape") {
    Camera whole = camera_looking_at({0, 0, 0}, {300, -200, 50});
    whole.vertical_fov_rad = quarter_turn_rad; // 2 high and, at this aspect, 4 wide at distance 1
    Camera part = whole;
    part.vertical_fov_rad = 2.0 * std::atan(0.25);
    part.middle = {-1.5, 0.75};
    part.pixel_aspect = 0.5;
    const double aspect = 4.0;
    const glm::mat4 large = view_to_clip(whole, 2.0);
    const glm::mat4 small = view_to_clip(part, aspect);
    const auto normals = frustum_normals(part, aspect);
    for (const glm::vec2& at : {glm::vec2(-2, 1), {-1, 0.5}, {-2, 0.5}, {-1.5, 0.75}, {-1.1, 0.9}}) {
        const glm::vec4 point(5.0F * at, -5.0F, 1.0F);
        const glm::vec4 of_large = large * point;
        const glm::vec4 of_small = small * point;
        CHECK(of_large.x / of_large.w == Approx(at.x / 2.0F));
        CHECK(of_large.y / of_large.w == Approx(at.y));
        CHECK(of_small.x / of_small.w == Approx(2.0F * (at.x + 1.5F)).margin(1e-6));
        CHECK(of_small.y / of_small.w == Approx(4.0F * (at.y - 0.75F)).margin(1e-6));
    }
    const auto inside = [&](double x, double y) {
        return in_view(part.view_to_world * glm::dvec3(x, y, -1.0), 0.0, normals);
    };
    CHECK(inside(-1.999, 0.999));
    CHECK(inside(-1.001, 0.501));
    CHECK_FALSE(inside(-2.001, 0.9));
    CHECK_FALSE(inside(-0.999, 0.9));
    CHECK_FALSE(inside(-1.5, 1.001));
    CHECK_FALSE(inside(-1.5, 0.499));
    CHECK(corner_cos(part, aspect) == Approx(1.0 / std::sqrt(1.0 + 4.0 + 1.0)));
    CHECK(focal_px(part, 100) == Approx(400.0)); // across: pixels are half as wide as high
}

TEST_CASE("the frustum's planes hold what the picture shows and nothing else") {
    Camera camera = camera_looking_at({0, 0, 0}, {300, -200, 50});
    const double aspect = 16.0 / 9.0;
    const auto normals = frustum_normals(camera, aspect);
    const double half_height = std::tan(camera.vertical_fov_rad / 2);
    for (const glm::dvec3& normal : normals) {
        CHECK(glm::length(normal) == Approx(1.0));
        CHECK(glm::dot(normal, camera.view_to_world * ahead) > 0.0);
    }
    // Which plane a view direction just beyond one edge is outside of: left, right, bottom, top.
    const double beyond = 1.001;
    const std::array<glm::dvec3, 4> outside{glm::dvec3(-half_height * aspect * beyond, 0, -1),
        glm::dvec3(half_height * aspect * beyond, 0, -1), glm::dvec3(0, -half_height * beyond, -1),
        glm::dvec3(0, half_height * beyond, -1)};
    for (std::size_t edge = 0; edge < 4; ++edge) {
        for (std::size_t plane = 0; plane < 4; ++plane) {
            const double side = glm::dot(normals[plane], camera.view_to_world * outside[edge]);
            CHECK((side < 0.0) == (edge == plane));
            const glm::dvec3 inside = outside[edge] * glm::dvec3(0.998, 0.998, 1.0);
            CHECK(glm::dot(normals[plane], camera.view_to_world * inside) > 0.0);
        }
    }
}
